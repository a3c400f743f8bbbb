// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <thread>

#include "gpu/gpu_device.h"
#include "gpu/program.h"
#include "gpu/timer.h"

namespace skysweep::gpu {
namespace {

constexpr const char* kDouble = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer In { int given[]; };
layout(std430, binding = 1) writeonly buffer Out { int doubled[]; };
uniform int count;
void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint i = group * 64 + gl_LocalInvocationID.x;
  if (i < uint(count)) doubled[i] = FACTOR * given[i];
}
)";

std::vector<int> doubled_by(Device& device, const std::vector<int>& values) {
  Program program(device, "double", {{"FACTOR", "2"}}, kDouble);
  program.set("count", static_cast<int>(values.size()));
  const Buffer in(device, values);
  Buffer out(device, in.bytes());
  program.run((static_cast<std::int64_t>(values.size()) + 63) / 64, {&in, &out});
  std::vector<int> result(values.size());
  out.read(result.data(), out.bytes());
  return result;
}

std::vector<int> numbers(int count, int first = 0) {
  std::vector<int> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

std::vector<int> doubled(std::vector<int> values) {
  for (int& value : values) value *= 2;
  return values;
}

TEST(Gpu, device_has_a_name_and_limits) {
  SKY_OPEN_GPU_OR_SKIP(device);
  EXPECT_FALSE(device->name().empty());
  EXPECT_EQ(device->is_software(), device->name().find("llvmpipe") != std::string::npos ||
                                       device->name().find("softpipe") != std::string::npos);
  EXPECT_GE(device->limits().storage_block_bytes, 1 << 24);
  EXPECT_GE(device->limits().shared_memory_bytes, 32 << 10);
  EXPECT_GE(device->limits().texture_size, 16384);
}

TEST(Gpu, computes_more_groups_than_one_dimension_holds) {
  SKY_OPEN_GPU_OR_SKIP(device);
  const std::vector<int> values = numbers(70000 * 64 - 5);
  EXPECT_EQ(doubled_by(*device, values), doubled(values));
}

TEST(Gpu, serves_several_threads) {
  SKY_OPEN_GPU_OR_SKIP(device);
  std::vector<std::vector<int>> results(4);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] { results[t] = doubled_by(*device, numbers(1000, 100 * t)); });
  for (std::thread& thread : threads) thread.join();
  for (int t = 0; t < 4; ++t) EXPECT_EQ(results[t], doubled(numbers(1000, 100 * t)));
}

TEST(Gpu, compile_error_tells_the_log) {
  SKY_OPEN_GPU_OR_SKIP(device);
  try {
    Program(*device, "broken", {}, "void main() { undeclared = 1; }");
    FAIL() << "compiled";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("broken"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("undeclared"), std::string::npos) << error.what();
  }
}

TEST(Gpu, what_does_not_fit_is_out_of_memory_and_the_device_goes_on) {
  SKY_OPEN_GPU_OR_SKIP(device);
  const auto trouble_of = [](const auto& make) {
    try {
      make();
    } catch (const DeviceError& error) {
      return error.trouble();
    }
    return Trouble::refused;
  };
  EXPECT_EQ(trouble_of([&] { Buffer(*device, std::size_t{1} << 45); }), Trouble::out_of_memory);
  EXPECT_EQ(trouble_of([&] { TextureArray(*device, 1 << 20, 16, 1); }), Trouble::out_of_memory);
  EXPECT_EQ(doubled_by(*device, numbers(10)), doubled(numbers(10)));
}

TEST(Gpu, lost_device_throws_from_every_call_and_a_new_one_works) {
  SKY_OPEN_GPU_OR_SKIP(device);
  Buffer buffer(*device, numbers(10));
  device->give_up();
  int word = 0;
  try {
    buffer.read(&word, 4);
    FAIL() << "read from a lost device";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.trouble(), Trouble::lost);
  }
  EXPECT_THROW(device->finish(), DeviceError);
  const std::unique_ptr<Device> next = Device::open();
  EXPECT_EQ(doubled_by(*next, numbers(10)), doubled(numbers(10)));
}

TEST(Gpu, buffer_is_filled_and_written_in_parts) {
  SKY_OPEN_GPU_OR_SKIP(device);
  Buffer buffer(*device, 16);
  buffer.fill(7);
  const int word = 9;
  buffer.write(&word, 4, 8);
  std::vector<int> read(4);
  buffer.read(read.data(), 16);
  EXPECT_EQ(read, (std::vector<int>{7, 7, 9, 7}));
}

constexpr const char* kSample = R"(
layout(local_size_x = 1) in;
layout(std430, binding = 0) writeonly buffer Out { float values[]; };
layout(binding = 0) uniform sampler2DArray pictures;
uniform float x;
uniform float level;
void main() {
  values[0] = 65535 * textureLod(pictures, vec3(x, 0.5, 1), level).r;
  values[1] = 65535 * texelFetch(pictures, ivec3(1, 0, 1), 0).r;
  vec4 four = 65535 * textureGather(pictures, vec3(0.25, 0.5, 1));
  values[2] = four.w; values[3] = four.z; values[4] = four.x; values[5] = four.y;
}
)";

// Two layers of 4 x 2, the second written, with its own second level of 2 x 1.
std::vector<float> sampled(Device& device, Filter filter, float x, float level) {
  TextureArray texture(device, 4, 2, 2, 2, filter);
  const std::vector<std::uint16_t> fine = {100, 200, 300, 400, 0, 500, 600, 700, 800, 0};
  const std::vector<std::uint16_t> coarse = {1000, 65535};
  texture.write(1, 0, 0, 0, 4, 2, fine.data(), 5);
  texture.write(1, 1, 0, 0, 2, 1, coarse.data(), 2);
  TextureArray copy(device, 4, 2, 3, 2, filter);
  copy.copy_layers(texture, 2);
  Program program(device, "sample", {}, kSample);
  program.set("x", x);
  program.set("level", level);
  Buffer out(device, 6 * sizeof(float));
  program.run(1, {&out}, &copy);
  std::vector<float> values(6);
  out.read(values.data(), out.bytes());
  return values;
}

TEST(Gpu, texture_gives_pixels_levels_and_what_lies_between) {
  SKY_OPEN_GPU_OR_SKIP(device);
  const std::vector<float> nearest = sampled(*device, Filter::nearest, 0.3f, 0);
  EXPECT_NEAR(nearest[1], 200, 0.01);
  // What the exact sampling of the sweep rests on: the four pixels around a corner, upper row first.
  EXPECT_NEAR(nearest[2], 100, 0.01);
  EXPECT_NEAR(nearest[3], 200, 0.01);
  EXPECT_NEAR(nearest[4], 500, 0.01);
  EXPECT_NEAR(nearest[5], 600, 0.01);
  // x = 0.375 is the centre of the second column; half way between the rows.
  EXPECT_NEAR(sampled(*device, Filter::linear, 0.375f, 0)[0], 400, 0.5);
  EXPECT_NEAR(sampled(*device, Filter::linear, 0.5f, 0)[0], 450, 0.5);
  EXPECT_NEAR(sampled(*device, Filter::linear, 0.25f, 1)[0], 1000, 0.5);
  EXPECT_NEAR(sampled(*device, Filter::linear, 0.75f, 1)[0], 65535, 0.5);
}

TEST(Gpu, timer_counts_what_ran) {
  SKY_OPEN_GPU_OR_SKIP(device);
  Timer timer(*device);
  doubled_by(*device, numbers(100000));
  const double seconds = timer.stop_s();
  EXPECT_GT(seconds, 0);
  EXPECT_LT(seconds, 60);
}

}  // namespace
}  // namespace skysweep::gpu
