// SPDX-License-Identifier: Apache-2.0
// Every effect there is: its name in scene files, stage, settings and how it is made. To add one: its settings
// (scene/effect_settings.h), its pair of files here, and one line in for_each_effect.
#pragma once

#include "scene/effects/chromatic_aberration.h"
#include "scene/effects/cloud_shadows.h"
#include "scene/effects/defocus.h"
#include "scene/effects/exposure_drift.h"
#include "scene/effects/haze.h"
#include "scene/effects/motion_blur.h"
#include "scene/effects/moving_cars.h"
#include "scene/effects/pose_error.h"
#include "scene/effects/rolling_shutter.h"
#include "scene/effects/sensor_noise.h"
#include "scene/effects/sky_light.h"
#include "scene/effects/specular_water.h"
#include "scene/effects/sun_movement.h"
#include "scene/effects/time_jitter.h"
#include "scene/effects/vignetting.h"

namespace skysweep::scene {

struct EffectInfo {
  EffectId id;
  const char* name;  // of its table: [effects.NAME]
  Stage stage;
  const char* what;
};

template <typename EffectClass>
struct Makes {
  using type = EffectClass;
};

// Calls visit(info, settings, Makes<class>) for each effect in the order in which they act; `settings` is the
// std::optional in `effects` (const if that is).
template <typename AnyEffects, typename Visitor>
void for_each_effect(AnyEffects& effects, Visitor&& visit) {
  using enum Stage;
  using Id = EffectId;
  visit(EffectInfo{Id::pose_error, "pose_error", metadata, "wrong positions and angles in the files"},
        effects.pose_error, Makes<PoseErrorEffect>{});
  visit(EffectInfo{Id::time_jitter, "time_jitter", metadata, "positions of another moment in the files"},
        effects.time_jitter, Makes<TimeJitterEffect>{});
  visit(EffectInfo{Id::rolling_shutter, "rolling_shutter", rays, "rows are read one after the other"},
        effects.rolling_shutter, Makes<RollingShutterEffect>{});
  visit(EffectInfo{Id::motion_blur, "motion_blur", rays, "the camera moves while the shutter is open"},
        effects.motion_blur, Makes<MotionBlurEffect>{});
  visit(EffectInfo{Id::defocus, "defocus", rays, "a lens focused elsewhere"}, effects.defocus, Makes<DefocusEffect>{});
  visit(EffectInfo{Id::chromatic_aberration, "chromatic_aberration", rays, "red and blue images of another size"},
        effects.chromatic_aberration, Makes<ChromaticAberrationEffect>{});
  visit(EffectInfo{Id::sky, "sky", light, "strength and colour of the sky's light"}, effects.sky,
        Makes<SkyLightEffect>{});
  visit(EffectInfo{Id::sun_movement, "sun_movement", light, "the sun goes on during the flight"}, effects.sun_movement,
        Makes<SunMovementEffect>{});
  visit(EffectInfo{Id::cloud_shadows, "cloud_shadows", light, "shadows of clouds in the wind"}, effects.cloud_shadows,
        Makes<CloudShadowsEffect>{});
  visit(EffectInfo{Id::moving_cars, "moving_cars", light, "cars that drive between exposures"}, effects.moving_cars,
        Makes<MovingCarsEffect>{});
  visit(EffectInfo{Id::specular_water, "specular_water", surface, "mirror image and sun glitter on water"},
        effects.specular_water, Makes<SpecularWaterEffect>{});
  visit(EffectInfo{Id::haze, "haze", air, "air takes light and adds its own"}, effects.haze, Makes<HazeEffect>{});
  visit(EffectInfo{Id::vignetting, "vignetting", image, "darker corners"}, effects.vignetting,
        Makes<VignettingEffect>{});
  visit(EffectInfo{Id::exposure_drift, "exposure_drift", image, "exposure and white balance wander"},
        effects.exposure_drift, Makes<ExposureDriftEffect>{});
  visit(EffectInfo{Id::sensor_noise, "sensor_noise", sensor, "shot and read noise at an ISO"}, effects.sensor_noise,
        Makes<SensorNoiseEffect>{});
}

}  // namespace skysweep::scene
