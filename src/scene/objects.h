// SPDX-License-Identifier: Apache-2.0
// What can stand on the ground of a synthetic scene. Plain values; positions in the scene's frame, metres.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/box.h"
#include "core/vec.h"

namespace skysweep::scene {

enum class RoofKind {
  flat,
  gable,      // two planes that meet in a ridge along the longer side; around a courtyard the ridge runs around it
  hip,        // four planes of one slope
  shed,       // one plane, rising along the second side of the building
  saw_tooth,  // north lights: a row of sheds along the second side, each with a steep glazed face behind its ridge
};

// A single building, for scenes whose truth can be told by hand.
struct Building {
  Vec2d center;
  Vec2d size_m;            // sides; x before turning by the heading
  double heading_deg = 0;  // turned clockwise
  double roof_z_m = 0;     // highest place of the roof, in the scene's frame, not above ground
  RoofKind roof = RoofKind::flat;
  double eaves_z_m = 0;                // lowest place of a roof that is not flat
  std::optional<Vec2d> courtyard_m{};  // sides of a hole in the middle; flat and gable only
  int teeth = 4;                       // of a saw-tooth roof
  double steep_deg = 90;               // of its glazed faces, from level
};

// Blocks of buildings between streets, everywhere on the ground. The lower half of the keys is off at 0: a town that
// leaves one out does not change.
struct Town {
  double block_m = 34;      // side of a block between streets
  double street_m = 11;     // width of a street, pavements included
  double heading_deg = 0;   // streets turned clockwise from north
  double min_height_m = 4;  // of a building above the ground at its centre; of its eaves, if the roof is not flat
  double max_height_m = 20;
  double roof_units = 1.5;   // mean number of small boxes (lift houses, chimneys) on a roof
  double cars_per_100m = 5;  // parked along each side of a street

  double block_depth_m = 0;     // other side of a block; 0: as block_m
  double alley_m = 0;           // between the buildings of a block, which then fill their lots; 0: free setbacks
  double gable_share = 0;       // of the buildings whose eaves are not above pitched_up_to_m
  double hip_share = 0;         // likewise
  double shed_share = 0;        // likewise
  double pitched_up_to_m = 12;  // highest eaves of roofs that are not flat
  double courtyard_share = 0;   // of the buildings large enough for one
  double trees_per_block = 0;   // mean number, wherever a block has room for them
};

enum class CrownShape { ellipsoid, cone, column };

struct Tree {
  Vec2d position;
  double height_m = 8;
  double crown_m = 5;  // diameter of the crown
  CrownShape shape = CrownShape::ellipsoid;
};

// Trees at random places. In a town: on the blocks whose centre lies in the area, which are left unbuilt.
struct Forest {
  double trees_per_ha = 300;
  double min_height_m = 8;
  double max_height_m = 18;
  std::vector<CrownShape> shapes{CrownShape::ellipsoid, CrownShape::cone, CrownShape::column};  // equally often
  std::optional<Box2d> area{};                                                                  // absent: everywhere
};

// A free-standing wall whose top follows the ground.
struct FreeWall {
  Vec2d from, to;
  double height_m = 2;
  double thickness_m = 0.3;
};

// A level deck with free space below it, and a ramp at each end.
struct Bridge {
  Vec2d from, to;  // ends of the deck, on its middle line
  double width_m = 8;
  double deck_z_m = 0;  // upper side, in the scene's frame
  double thickness_m = 1;
  double ramp_m = 0;  // length of each ramp, from deck to ground; 0: none
};

struct Mast {
  Vec2d position;
  double height_m = 15;
  double width_m = 0.3;  // side of its square section
};

// Pylons with a cross arm, and sagging wires between them.
struct PowerLine {
  std::vector<Vec2d> pylons;
  double height_m = 15;  // of pylons and wires' ends, above the ground at the pylon
  double sag_m = 1;      // of a wire halfway between two pylons, below the straight line
  int wires = 3;
  double wire_spacing_m = 1.5;
  double wire_diameter_m = 0.03;
  double pylon_width_m = 0.4;
};

// Everything but the town and the buildings.
struct Things {
  std::vector<Tree> trees{};
  std::optional<Forest> forest{};
  std::vector<FreeWall> walls{};
  std::vector<Bridge> bridges{};
  std::vector<Mast> masts{};
  std::vector<PowerLine> power_lines{};
};

}  // namespace skysweep::scene
