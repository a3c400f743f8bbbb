// SPDX-License-Identifier: Apache-2.0
#include "watch/arrivals.h"

#include <algorithm>

#include "watch/file_kind.h"

namespace skysweep::watch {

void Arrivals::complete(const std::string& name, File& file, const std::string& stamp) {
  file = {true, stamp};
  changed_[name] = true;
}

void Arrivals::written(const std::string& name) { files_[name] = {}; }

void Arrivals::closed(const std::string& name, const std::string& stamp) {
  File& file = files_[name];
  if (!file.complete || file.stamp != stamp) complete(name, file, stamp);
}

void Arrivals::gone(const std::string& name) {
  if (files_.erase(name) > 0) changed_[name] = false;
}

void Arrivals::look(const FolderLook& look) {
  for (auto it = files_.begin(); it != files_.end();) {
    const bool is_there = look.contains(it->first);
    if (!is_there) changed_[it->first] = false;
    it = is_there ? std::next(it) : files_.erase(it);
  }
  for (const auto& [name, stamp] : look) {
    File& file = files_[name];
    if (file.stamp != stamp)
      file = {false, stamp};
    else if (!file.complete)
      complete(name, file, stamp);
  }
}

Arrivals::Changes Arrivals::take_changes() {
  Changes changes;
  for (const auto& [name, is_there] : changed_) (is_there ? changes.complete : changes.gone).push_back(name);
  changed_.clear();
  return changes;
}

bool Arrivals::is_arriving(const std::string& name) const {
  const auto found = files_.find(name);
  return found != files_.end() && !found->second.complete;
}

bool Arrivals::knows_photographs() const {
  return std::any_of(files_.begin(), files_.end(),
                     [](const auto& entry) { return file_kind(entry.first) == FileKind::photograph; });
}

int Arrivals::unsettled() const {
  return static_cast<int>(
      std::count_if(files_.begin(), files_.end(), [](const auto& entry) { return !entry.second.complete; }));
}

}  // namespace skysweep::watch
