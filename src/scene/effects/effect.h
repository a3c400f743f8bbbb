// SPDX-License-Identifier: Apache-2.0
// What an effect is: a thing with a name, a stage and a meter. Each stage has its interface below; an effect implements
// that of its stage and nothing else.
//
//   metadata  what the files say about a pose
//   rays      where, when and through which part of the lens a sample looks
//   light     sun and sky, where they meet a surface
//   surface   what a surface throws back by the direction from which it is seen
//   air       between surface and camera
//   image     linear light of a row of pixels
//   sensor    the same, after exposure
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "camera/pose.h"
#include "formats/pose_set.h"
#include "scene/render/photograph_effects.h"

namespace skysweep::scene {

class World;

enum class Stage { metadata, rays, light, surface, air, image, sensor };
const char* to_string(Stage stage);

// In the order in which they act.
enum class EffectId {
  pose_error,
  time_jitter,
  rolling_shutter,
  motion_blur,
  defocus,
  chromatic_aberration,
  sky,
  sun_movement,
  cloud_shadows,
  moving_cars,
  specular_water,
  haze,
  vignetting,
  exposure_drift,
  sensor_noise,
  count
};
constexpr int kEffects = static_cast<int>(EffectId::count);

// Calls of an effect since the program started, whoever made them: how a test proves that nothing ran.
long long calls_since_start(EffectId id);

// Calls (of rows or photographs) and time of one effect. Safe to use from several threads.
class Meter {
 public:
  explicit Meter(EffectId id) : id_(id) {}
  void add(long long calls, std::chrono::steady_clock::duration time) const;
  long long calls() const { return calls_; }
  double seconds() const { return 1e-9 * static_cast<double>(nanoseconds_); }

 private:
  EffectId id_;
  mutable std::atomic<long long> calls_ = 0, nanoseconds_ = 0;
};

// Adds its own lifetime to a sum, or to a meter as one call.
class Stopwatch {
 public:
  explicit Stopwatch(std::chrono::steady_clock::duration& sum) : sum_(&sum) {}
  Stopwatch(const Meter& meter, long long calls) : meter_(&meter), calls_(calls) {}
  ~Stopwatch();
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::duration* sum_ = nullptr;
  const Meter* meter_ = nullptr;
  long long calls_ = 0;
};

// A photograph of the flight.
struct Shot {
  int index = 0;
  double time_s = 0;  // since the first photograph
  camera::Pose pose;  // scene's frame
  Vec3d velocity_mps;
};

class Effect {
 public:
  explicit Effect(EffectId id) : meter_(id), id_(id) {}
  virtual ~Effect() = default;
  Effect(const Effect&) = delete;
  Effect& operator=(const Effect&) = delete;
  EffectId id() const { return id_; }
  const Meter& meter() const { return meter_; }

 private:
  Meter meter_;
  EffectId id_;
};

class MetadataEffect : public Effect {
 public:
  using Effect::Effect;
  // Spoils the poses of `images`, which belong to `shots` in their order.
  virtual void spoil(const std::vector<Shot>& shots, std::vector<formats::PosedImage>& images) const = 0;
};

class RayEffect : public Effect {
 public:
  using Effect::Effect;
  virtual int rounds() const { return 1; }  // groups of four samples a pixel needs
  virtual bool channels_apart() const { return false; }
  virtual void bend(SampleBatch& batch) const = 0;
};

class LightEffect : public Effect {
 public:
  using Effect::Effect;
  // What it does to the truth too; most do nothing.
  virtual void change_always(Moment&) const {}
  // What it does at the moment of a photograph.
  virtual void change(const Shot&, const World&, Moment&) const {}
};

class SurfaceEffect : public Effect {
 public:
  using Effect::Effect;
  // Adds to light[i], which comes from hits[i] against rays[i], what depends on that direction. count <= kBatch.
  virtual void shine(const Shot& shot, const World& world, const Moment& moment, const Ray* rays,
                     const SurfacePoint* hits, int count, LinearRgb* light) const = 0;
};

class AirEffect : public Effect {
 public:
  using Effect::Effect;
  virtual void dim(const Ray* rays, const SurfacePoint* hits, int count, LinearRgb* light) const = 0;
};

// Of the image or of the sensor.
class ImageEffect : public Effect {
 public:
  using Effect::Effect;
  virtual void develop(const Shot& shot, int row, LinearRgb* pixels, int width) const = 0;
};

}  // namespace skysweep::scene
