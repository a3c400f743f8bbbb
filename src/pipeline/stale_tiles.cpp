// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stale_tiles.h"

#include <algorithm>

namespace skysweep::pipeline {

using tiles::TileKey;

WorkList find_work(const Coverage& coverage, const TileChecker& checker, const MapRecords* records,
                   const tiles::TileStore& store, const std::optional<Box2d>& area, Executor& executor) {
  const std::vector<TileKey> possible = coverage.tiles(std::nullopt);
  const std::set<TileKey> touched(possible.begin(), possible.end());
  const std::vector<TileKey> on_disk = store.list_remains(0);
  const auto row_of = [&](TileKey key) { return records ? records->find(key) : nullptr; };

  std::vector<TileKey> asked;
  for (const TileKey key : possible) {
    const bool in_area = !area || area->intersects(store.lattice().extent(key));
    const bool without_row = !row_of(key) && std::binary_search(on_disk.begin(), on_disk.end(), key);
    const bool unreadable = row_of(key) && row_of(key)->candidates_digest.empty();
    if (in_area || without_row || unreadable) asked.push_back(key);
  }
  std::vector<StaleTile> tiles(asked.size());
  std::vector<TileCheck> checks(asked.size());
  executor.parallel_for(static_cast<int>(asked.size()), [&](int i) {
    tiles[i].key = asked[i];
    tiles[i].candidates = coverage.candidates(asked[i]);
    checks[i] = checker.check(asked[i], tiles[i].candidates, row_of(asked[i]));
  });

  WorkList work;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const index::TileRecord* row = row_of(asked[i]);
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
  std::set<TileKey> gone;
  if (records)
    for (const auto& [key, row] : records->rows())
      if (key.level == 0 && !touched.contains(key)) gone.insert(key);
  for (const TileKey key : on_disk)
    if (!touched.contains(key)) gone.insert(key);
  work.gone.assign(gone.begin(), gone.end());
  return work;
}

}  // namespace skysweep::pipeline
