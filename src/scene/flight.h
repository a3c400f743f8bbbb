// SPDX-License-Identifier: Apache-2.0
// Flights over a scene: where photographs are taken from and where they look. Plain values; scene/flight_plan.h makes
// poses of them. Heights are in the scene's frame, i.e. above mean ground height.
#pragma once

#include <vector>

#include "camera/pose.h"
#include "core/vec.h"

namespace skysweep::scene {

enum class FlightPattern {
  strips,  // parallel strips, flown to and fro, with the top of the photographs in the direction of flight
  orbit,   // circles around a target, all photographs looking at it
  given,   // poses from a file
};

// Strips and views are spread evenly, at least as dense as the overlaps ask for.
struct Flight {
  FlightPattern pattern = FlightPattern::strips;
  double gsd_m = 0.05;              // strips: at mean ground height; altitude = gsd x focal length in pixels
  std::vector<double> altitudes_m;  // the whole pattern once at each of them; empty: the one that gives gsd_m

  // Strips.
  double along_overlap = 0.8;           // of consecutive photographs of a strip, 0 to below 1
  double across_overlap = 0.7;          // of neighbouring strips
  double heading_deg = 0;               // of the strips, clockwise from north
  double beyond_area_m = 0;             // how far the outermost positions lie outside the mapped area; negative: inside
  bool cross_strips = false;            // a second set of strips across the first
  bool terrain_following = false;       // altitudes are above the ground under the camera
  double off_nadir_deg = 0;             // all photographs look away from nadir by this angle
  std::vector<double> looks_deg = {0};  // directions of look, clockwise from that of flight: a photograph for each

  // Orbit.
  Vec3d target;          // what it looks at
  double radius_m = 0;   // of the circle, horizontally from the target
  int photographs = 36;  // of each circle

  // Given.
  std::vector<camera::Pose> poses;  // in the scene's frame

  // Seeded deviations of strips and orbits from the plan. Scatter is white; drift is a first-order Gauss-Markov process
  // that forgets within drift_photographs positions (to 1 / e).
  double tilt_sigma_deg = 0;        // scatter of roll and pitch; of yaw: twice that
  double position_sigma_m = 0;      // scatter of each coordinate
  double tilt_drift_sigma_deg = 0;  // drift of roll and pitch; of yaw: twice that
  double drift_sigma_m = 0;         // drift of each coordinate
  double drift_photographs = 20;

  // The altitudes flown by a camera of this focal length; of given poses: their median.
  std::vector<double> resolved_altitudes_m(double focal_px) const;
  // At mean ground height straight below, of an orbit: at its target; the finest of all altitudes.
  double resolved_gsd_m(double focal_px) const;
};

}  // namespace skysweep::scene
