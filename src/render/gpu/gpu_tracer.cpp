// SPDX-License-Identifier: Apache-2.0
// The ray caster on the device: the field and its hierarchy are put there once, rays go and hits come in batches.
#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "gpu/program.h"
#include "render/gpu/shaders.h"
#include "render/tracer.h"

namespace skysweep::render {
namespace {

constexpr int kThreads = 64;
constexpr std::size_t kRaysABatch = 1 << 18;
constexpr double kNever = 1e300;  // the shader's

std::string text_of(Face face) { return std::to_string(static_cast<int>(face)); }

gpu::Program compiled(gpu::Device& device, SurfaceForm form) {
  const auto source = on_gpu::embedded_file("first_hits.comp");
  SKY_CHECK(source.has_value());
  return {device,
          "first_hits.comp",
          {{"THREADS", std::to_string(kThreads)},
           {"BOXES", form == SurfaceForm::boxes ? "1" : "0"},
           {"UNKNOWN_SIDE", "0"},
           {"ABOVE", "1"},
           {"BELOW", "2"},
           {"FACE_TOP", text_of(Face::top)},
           {"FACE_WALL_X", text_of(Face::wall_x)},
           {"FACE_WALL_Y", text_of(Face::wall_y)},
           {"FACE_SQUARE", text_of(Face::square)},
           {"MOST_STEPS", "10000000"}},
          std::string(*source)};
}

// Where each level's squares begin in the array of all, its size, nothing.
std::vector<std::int32_t> level_table(const HeightHierarchy& hierarchy) {
  std::vector<std::int32_t> table;
  std::int32_t begin = 0;
  for (int level = 0; level < hierarchy.levels(); ++level) {
    const Array2d<HeightRange>& squares = hierarchy.level(level);
    table.insert(table.end(), {begin, squares.width(), squares.height(), 0});
    begin += static_cast<std::int32_t>(squares.size());
  }
  return table;
}

// Infinite bounds of empty ranges as numbers: what drivers do with infinities is their own affair.
std::vector<float> all_ranges(const HeightHierarchy& hierarchy) {
  std::vector<float> ranges;
  for (int level = 0; level < hierarchy.levels(); ++level)
    for (const HeightRange& range : hierarchy.level(level)) {
      ranges.push_back(range.empty() ? 1e30f : range.min);
      ranges.push_back(range.empty() ? -1e30f : range.max);
    }
  return ranges;
}

std::vector<float> all_heights(const Array2d<float>& height_m) {
  std::vector<float> heights(height_m.begin(), height_m.end());
  for (float& h : heights)
    if (std::isnan(h)) h = 0;  // no patch that is there has such a corner
  return heights;
}

class GpuTracer final : public Tracer {
 public:
  GpuTracer(const RayCaster& caster, gpu::Device& device)
      : caster_(caster),
        device_(device),
        program_(compiled(device, caster.form())),
        levels_(device, level_table(caster.hierarchy())),
        ranges_(device, all_ranges(caster.hierarchy())),
        heights_(device, all_heights(caster.field().height_m)) {
    program_.set("level_count", caster.hierarchy().levels());
    program_.set("heights_across", caster.field().height_m.width());
  }

  std::vector<Hit> first_hits(const std::vector<Ray>& rays, const TraceOptions& options) override {
    std::vector<Hit> hits(rays.size());
    const gpu::Buffer numbers(
        device_, std::vector<double>{options.pixel.fixed_m, options.pixel.per_metre, caster_.field().cell_m});
    program_.set("use_hierarchy", options.use_hierarchy ? 1 : 0);
    for (std::size_t begin = 0; begin < rays.size(); begin += kRaysABatch)
      trace_batch(rays, begin, std::min(rays.size(), begin + kRaysABatch), numbers, hits);
    return hits;
  }
  std::int64_t steps() const override { return steps_; }

 private:
  std::vector<double> numbers_of(const std::vector<Ray>& rays, std::size_t begin, std::size_t end) const {
    const HeightField& field = caster_.field();
    const double offset = caster_.form() == SurfaceForm::boxes ? 0 : 0.5;
    std::vector<double> numbers;
    numbers.reserve(6 * (end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3d o = field.cells_from_map(rays[i].origin), d = rays[i].direction;
      numbers.insert(numbers.end(), {o.x - offset, o.y - offset, o.z, d.x / field.cell_m, -d.y / field.cell_m, d.z});
    }
    return numbers;
  }

  void trace_batch(const std::vector<Ray>& rays, std::size_t begin, std::size_t end, const gpu::Buffer& numbers,
                   std::vector<Hit>& hits) {
    const std::size_t count = end - begin;
    const gpu::Buffer from(device_, numbers_of(rays, begin, end));
    gpu::Buffer distances(device_, count * sizeof(double)), found(device_, count * 2 * sizeof(std::int32_t));
    program_.set("ray_count", static_cast<int>(count));
    program_.run(static_cast<std::int64_t>((count + kThreads - 1) / kThreads),
                 {&from, &levels_, &ranges_, &heights_, &distances, &found, &numbers});
    std::vector<double> metres(count);
    std::vector<std::int32_t> words(2 * count);
    distances.read(metres.data(), metres.size() * sizeof(double));
    found.read(words.data(), words.size() * sizeof(std::int32_t));
    for (std::size_t i = 0; i < count; ++i) {
      steps_ += words[2 * i + 1];
      if (metres[i] >= kNever) continue;
      const std::int32_t word = words[2 * i];
      hits[begin + i] = {metres[i], word & 255, static_cast<Face>(word >> 8 & 255), (word >> 16 & 1) != 0};
    }
  }

  const RayCaster& caster_;
  gpu::Device& device_;
  gpu::Program program_;
  gpu::Buffer levels_, ranges_, heights_;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Tracer> make_gpu_tracer(const RayCaster& caster, gpu::Device& device) {
  return std::make_unique<GpuTracer>(caster, device);
}

}  // namespace skysweep::render
