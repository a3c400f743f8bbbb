// SPDX-License-Identifier: Apache-2.0
#include "scene/world/surface_class.h"

namespace skysweep::scene {
namespace {

bool is_thin(BodyKind kind) { return kind == BodyKind::wall || kind == BodyKind::mast || kind == BodyKind::wire; }

}  // namespace

SurfaceClass class_of(const SurfacePoint& point, const Solids& solids) {
  if (point.face == Face::none) return SurfaceClass::none;
  if (point.face == Face::ground) return SurfaceClass::ground;
  if (point.face == Face::water) return SurfaceClass::water;
  if (point.face == Face::leaf) return SurfaceClass::tree;
  if (point.facet >= 0) {
    const Facet& facet = solids.facets.all[static_cast<std::size_t>(point.facet)];
    if (is_thin(solids.facets.bodies[static_cast<std::size_t>(facet.body)].kind)) return SurfaceClass::thin;
  } else if (solids.boxes[static_cast<std::size_t>(point.box)].kind == BoxKind::car) {
    return SurfaceClass::ground;
  }
  return point.face == Face::top ? SurfaceClass::roof : SurfaceClass::facade_edge;
}

}  // namespace skysweep::scene
