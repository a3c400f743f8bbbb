// SPDX-License-Identifier: Apache-2.0
// The faults of real photographs that a scene can ask for, one struct each. An effect that the scene file does not name
// (no table [effects.NAME]) is absent here, is never constructed and executes nothing. What each does, with formulas:
// docs/scenes.md, "Light and effects". Dials without a sensible default have to be given.
#pragma once

#include <optional>
#include <string>

#include "core/vec.h"

namespace skysweep::scene {

struct NamedEffect {
  std::string named_at;  // which line of which file asks for it: "town.toml:12: effects.haze"
};

// --- metadata: poses.csv and sparse/ get them, truth/poses.csv has the right poses ---

struct PoseError : NamedEffect {
  double position_sigma_m = 0;         // white error of each coordinate
  double position_drift_m = 0;         // standard deviation of an error that neighbours in the flight share
  double angle_sigma_deg = 0;          // white error about each axis of the camera
  double angle_drift_deg = 0;          // shared by neighbours
  double correlation_photographs = 8;  // over how many photographs a drift falls to 1/e
};

struct TimeJitter : NamedEffect {
  double sigma_s = 0;   // white error of each time stamp
  double offset_s = 0;  // the clock is late by this much
};

// --- rays, before they leave the camera ---

struct RollingShutter : NamedEffect {
  double readout_s = 0;  // from the first to the last row; the pose is that of the middle
};

struct MotionBlur : NamedEffect {
  double exposure_s = 0;  // how long the shutter is open, the pose being that of the middle
};

struct Defocus : NamedEffect {
  double aperture_mm = 0;       // diameter of the lens opening
  double focus_distance_m = 0;  // where the lens is focused; what lies elsewhere is blurred
};

struct ChromaticAberration : NamedEffect {
  double red_px = 0;   // how far red lies outside green in the farthest corner; negative: inside
  double blue_px = 0;  // the same of blue
};

// --- light where it meets a surface ---

struct SkyLight : NamedEffect {
  double strength = 1;   // factor on the light of the sky
  Vec3d color{1, 1, 1};  // factors on its red, green and blue
};

struct SunMovement : NamedEffect {
  double hours = 0;          // from the first to the last photograph; [light] is the middle
  double latitude_deg = 45;  // of the place
};

struct CloudShadows : NamedEffect {
  double cover = 0;            // part of the ground that lies in shadow
  double density = 0.8;        // part of the sun's light that a cloud takes
  double size_m = 80;          // of the clouds
  double wind_mps = 6;         // how fast they travel over the ground
  double wind_from_deg = 270;  // where they come from, clockwise from north
  double base_m = 1000;        // their height above z = 0
};

struct MovingCars : NamedEffect {
  double per_100m = 0;   // of street
  double speed_mps = 9;  // fastest; the slowest drive half as fast
};

// --- what a surface throws back by the direction from which it is seen ---

struct SpecularWater : NamedEffect {
  double wind_mps = 0;         // roughens the water; 0: a mirror, nearly
  double wind_from_deg = 270;  // from where the waves come, clockwise from north
};

// --- along the ray ---

struct Haze : NamedEffect {
  double visibility_m = 0;        // meteorological range: contrast falls to 2 %
  Vec3d color{0.60, 0.68, 0.78};  // of the air, linear light
};

// --- the linear image ---

struct Vignetting : NamedEffect {
  double strength = 0;  // 1: the natural law cos^4 of the field angle; s: cos^(4 s)
};

struct ExposureDrift : NamedEffect {
  double stops = 0;                    // standard deviation of the exposure over a long flight, powers of two
  double white_balance = 0;            // of the logarithm of red's gain; blue's is the opposite
  double correlation_photographs = 8;  // over how many photographs a deviation falls to 1/e
};

// --- the sensor ---

struct SensorNoise : NamedEffect {
  double iso = 0;              // 100: white fills the well
  double full_well_e = 20000;  // electrons of white at ISO 100
  double read_noise_e = 3;     // standard deviation, electrons
};

struct Effects {
  double speed_mps = 8;  // of the aircraft: what depends on time follows from it and the path
  std::optional<PoseError> pose_error;
  std::optional<TimeJitter> time_jitter;
  std::optional<RollingShutter> rolling_shutter;
  std::optional<MotionBlur> motion_blur;
  std::optional<Defocus> defocus;
  std::optional<ChromaticAberration> chromatic_aberration;
  std::optional<SkyLight> sky;
  std::optional<SunMovement> sun_movement;
  std::optional<CloudShadows> cloud_shadows;
  std::optional<MovingCars> moving_cars;
  std::optional<SpecularWater> specular_water;
  std::optional<Haze> haze;
  std::optional<Vignetting> vignetting;
  std::optional<ExposureDrift> exposure_drift;
  std::optional<SensorNoise> sensor_noise;
};

// One line of `simulate --explain`.
struct EffectReport {
  std::string name, stage, what;
  std::string named_at;  // empty: the scene does not name it, nothing of it ran
  long long calls = 0;   // for rows or for photographs, as the stage works
  double seconds = 0;    // inside the effect, added up over all threads
};

}  // namespace skysweep::scene
