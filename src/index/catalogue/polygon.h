// SPDX-License-Identifier: Apache-2.0
// Polygons of the catalogue: corners in order, without the first one again at the end.
#pragma once

#include <memory>
#include <vector>

#include "core/vec.h"
#include "index/catalogue/geopackage.h"

namespace skysweep::index {

inline std::unique_ptr<OGRPolygon> polygon_from(const std::vector<Vec2d>& corners) {
  auto ring = std::make_unique<OGRLinearRing>();
  for (const Vec2d p : corners) ring->addPoint(p.x, p.y);
  ring->closeRings();
  auto polygon = std::make_unique<OGRPolygon>();
  polygon->addRingDirectly(ring.release());
  return polygon;
}

// None for a missing geometry or one that is no polygon.
inline std::vector<Vec2d> corners_of(const OGRGeometry* geometry) {
  if (!geometry || wkbFlatten(geometry->getGeometryType()) != wkbPolygon) return {};
  const OGRLinearRing* ring = geometry->toPolygon()->getExteriorRing();
  std::vector<Vec2d> corners;
  for (int i = 0; ring && i + 1 < ring->getNumPoints(); ++i) corners.push_back({ring->getX(i), ring->getY(i)});
  return corners;
}

}  // namespace skysweep::index
