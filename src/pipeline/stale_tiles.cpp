// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stale_tiles.h"

#include <algorithm>

namespace skysweep::pipeline {

using tiles::TileKey;

namespace {

const index::TileRecord* row_of(TileKey key, const MapRecords* records) {
  return records ? records->find(key) : nullptr;
}

// The order of the keys is kept.
WorkList check_all(const std::vector<TileKey>& keys, const Coverage& coverage, const TileChecker& checker,
                   const MapRecords* records, Executor& executor) {
  std::vector<StaleTile> tiles(keys.size());
  std::vector<TileCheck> checks(keys.size());
  executor.parallel_for(static_cast<int>(keys.size()), [&](int i) {
    checks[i] = checker.check(keys[i], coverage, row_of(keys[i], records));
    if (checks[i].fresh) return;
    tiles[i].key = keys[i];
    tiles[i].candidates = coverage.candidates(keys[i]);
    tiles[i].candidates_digest = coverage.candidates_digest(keys[i], checker.settings());
  });
  WorkList work;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const index::TileRecord* row = row_of(keys[i], records);
    if (checks[i].fresh) {
      ++work.fresh;
      if (!row || !(*row == checks[i].row)) work.told.push_back(std::move(checks[i].row));
      continue;
    }
    tiles[i].why = std::move(checks[i].why);
    tiles[i].damaged = checks[i].damaged;
    tiles[i].known = row != nullptr;
    work.stale.push_back(std::move(tiles[i]));
  }
  return work;
}

bool meets(const std::optional<Box2d>& area, TileKey key, const tiles::Lattice& lattice) {
  return !area || area->intersects(lattice.extent(key));
}

}  // namespace

WorkList find_work(const Coverage& coverage, const TileChecker& checker, const MapRecords* records,
                   const tiles::TileStore& store, const std::optional<Box2d>& area, Executor& executor) {
  const std::vector<TileKey> possible = coverage.tiles(std::nullopt);
  const std::set<TileKey> touched(possible.begin(), possible.end());
  const std::vector<TileKey> on_disk = store.list_remains(0);

  std::vector<TileKey> asked;
  for (const TileKey key : possible) {
    const index::TileRecord* row = row_of(key, records);
    const bool without_row = !row && std::binary_search(on_disk.begin(), on_disk.end(), key);
    const bool unreadable = row && row->candidates_digest.empty();
    if (meets(area, key, store.lattice()) || without_row || unreadable) asked.push_back(key);
  }
  WorkList work = check_all(asked, coverage, checker, records, executor);

  std::set<TileKey> gone;
  if (records)
    for (const auto& [key, row] : records->rows())
      if (key.level == 0 && !touched.contains(key)) gone.insert(key);
  for (const TileKey key : on_disk)
    if (!touched.contains(key)) gone.insert(key);
  work.gone.assign(gone.begin(), gone.end());
  return work;
}

WorkList find_work_among(std::vector<TileKey> keys, const Coverage& coverage, const TileChecker& checker,
                         const MapRecords& records, const tiles::TileStore& store, const std::optional<Box2d>& area,
                         Executor& executor) {
  sort_along_curve(keys);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<TileKey> asked, gone;
  for (const TileKey key : keys) {
    if (coverage.is_mapped(key)) {
      if (meets(area, key, store.lattice())) asked.push_back(key);
    } else if (records.find(key)) {
      gone.push_back(key);
    }
  }
  WorkList work = check_all(asked, coverage, checker, &records, executor);
  work.gone = std::move(gone);
  return work;
}

}  // namespace skysweep::pipeline
