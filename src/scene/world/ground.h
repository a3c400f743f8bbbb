// SPDX-License-Identifier: Apache-2.0
// The height of the bare ground, in closed form, and the level of the water that stands on it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/vec.h"
#include "scene/scene.h"
#include "scene/world/terrain/height_grid.h"
#include "scene/world/terrain/surface.h"
#include "scene/world/terrain/waves.h"

namespace skysweep::scene {

// Immutable and cheap to copy.
class Ground {
 public:
  // Reads the file of a DEM. Throws Error as read_dem does.
  explicit Ground(const Scene& scene);
  // Ground that comes from no file.
  Ground(const Terrain& terrain, std::uint64_t seed);

  using Sample = HeightSample;
  Sample at(Vec2d p) const;

  std::optional<double> water_level_m() const { return water_level_m_; }
  // Of the ground, or of the water above it.
  double surface_m(Vec2d p) const;
  // Between which ground and water lie on `box`.
  HeightRange heights(const Box2d& box) const;

  // The plain rolling ground, without shape, modification or water: its mesh needs none of the bounds below.
  bool plain() const { return !shape_ && modifications_.empty() && !water_level_m_; }
  bool level() const { return plain() && !rolls_; }
  // Null if it does not roll.
  const Waves* rolling() const { return rolls_ ? &rolling_ : nullptr; }
  double shortest_wave_m() const { return rolling_.shortest_wave_m(); }

  // How a mesh has to lie, and how much it may deviate: see TerrainSurface.
  MeshPlan mesh_plan() const;
  double curvature(const Box2d& box) const;
  struct Change {
    HeightGrid grid;
    Box2d uv;  // of the mesh plan, around it
  };
  const std::vector<Change>& modifications() const { return modifications_; }

 private:
  Ground(const Terrain& terrain, std::uint64_t seed, const Scene* scene);

  Waves rolling_;
  bool rolls_;
  double rolling_reach_m_;
  std::shared_ptr<const TerrainSurface> shape_;
  Vec2d mesh_axis_u_{1, 0};
  std::vector<Change> modifications_;
  std::optional<double> water_level_m_;
};

}  // namespace skysweep::scene
