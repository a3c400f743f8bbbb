// SPDX-License-Identifier: Apache-2.0
// What one more photograph costs before any pixel is looked at: into the index, and which tiles it makes stale. Flat:
// at 10,000 photographs at most 1.1 times what it is at 100. The photographs are records of a flight in strips, in
// random order; the one that comes lies in the middle, always in the same place of its tile.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "camera/pose.h"
#include "core/check.h"
#include "core/random.h"
#include "pipeline/coverage.h"
#include "pipeline/project.h"
#include "pipeline/tile_digest.h"

namespace skysweep::pipeline {
namespace {

// 20 megapixels, 100 m above the ground, 70 and 60 % overlap. The photographs that may show the tiles of the one in the
// middle fit into the smallest of the blocks, so that all of them do the same work.
constexpr double kHeightM = 100, kAlongM = 30, kAcrossM = 60;

ProjectSettings settings() {
  ProjectSettings s;
  s.lattice = {512, 0.1, 0.05};
  s.configuration.tiles.cells = 512;
  s.search = {kHeightM, kHeightM, 0.5 * kHeightM, 1.5 * kHeightM, {}};
  s.crs_wkt = "a field";
  return s;
}

index::ImageRecord photograph(const std::string& name, Vec2d at, Random& random) {
  index::ImageRecord record;
  record.name = name;
  record.model = {5472, 3648, 3600, 3600, 2736, 1824, {}};
  const double heading = 90 + random.uniform(-3, 3), pitch = -90 + random.uniform(0, 2);
  record.pose = {camera::rotation_from_yaw_pitch_roll(heading, pitch, random.uniform(-2, 2)),
                 camera::snap_position({at.x, at.y, kHeightM + random.uniform(-2, 2)})};
  record.content_digest = name;
  return record;
}

std::vector<index::ImageRecord> flight(int count) {
  Random random(3);
  std::vector<index::ImageRecord> records;
  const int along = static_cast<int>(std::lround(std::sqrt(count * kAcrossM / kAlongM)));
  const int strips = count / along;
  for (int i = 0; i < count; ++i) {
    const Vec2d at{(i % along - along / 2) * kAlongM, (i / along - strips / 2) * kAcrossM};
    records.push_back(photograph("DJI_" + std::to_string(100000 + i), at, random));
  }
  for (std::size_t i = records.size(); i > 1; --i)
    std::swap(records[i - 1], records[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return records;
}

void one_more_photograph(benchmark::State& state) {
  const ProjectSettings project = settings();
  const std::string of_settings = settings_digest(project);
  const std::vector<index::ImageRecord> records = flight(static_cast<int>(state.range(0)));
  Coverage coverage(records, project);
  std::map<tiles::TileKey, std::string> known;
  for (const tiles::TileKey key : coverage.tiles(std::nullopt))
    known[key] = coverage.candidates_digest(key, of_settings);

  Random random(4);
  const index::ImageRecord one_more = photograph("one more", {7, 9}, random);
  std::size_t stale = 0, candidates = 0;
  for (auto _ : state) {
    coverage.add(one_more);
    std::vector<tiles::TileKey> work;
    for (const tiles::TileKey key : coverage.touched(one_more)) {
      const auto found = known.find(key);
      if (found == known.end() || coverage.candidates_digest(key, of_settings) != found->second) work.push_back(key);
    }
    sort_along_curve(work);
    stale = work.size();
    benchmark::DoNotOptimize(work.data());
    state.PauseTiming();
    coverage.remove(one_more.name);
    state.ResumeTiming();
  }
  coverage.add(one_more);
  for (const tiles::TileKey key : coverage.touched(one_more)) candidates += coverage.candidates(key).size();
  SKY_CHECK_GE(stale, std::size_t{6});
  state.counters["candidates"] = static_cast<double>(candidates);
  state.counters["stale_tiles"] = static_cast<double>(stale);
}

BENCHMARK(one_more_photograph)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace skysweep::pipeline

BENCHMARK_MAIN();
