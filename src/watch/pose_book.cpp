// SPDX-License-Identifier: Apache-2.0
#include "watch/pose_book.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "formats/arriving_poses.h"
#include "formats/match_images.h"
#include "raster/file_stamp.h"
#include "watch/file_kind.h"

namespace skysweep::watch {
namespace {

namespace fs = std::filesystem;

// A line without end is believed after so long: nobody is writing it.
constexpr double kStandsStill_s = 10;
// Files that are not tables are read when they have stood still for so long.
constexpr double kSettles_s = 1;

bool same(const formats::PosedImage& a, const formats::PosedImage& b) { return a.model == b.model && a.pose == b.pose; }

// Of a pose file and of the cameras beside it.
std::string stamp_of(const fs::path& path) {
  const auto own = raster::file_stamp(path);
  return own ? *own + " " + raster::file_stamp(path.parent_path() / "cameras.csv").value_or("") : std::string();
}

}  // namespace

PoseBook::PoseBook(fs::path folder, std::optional<fs::path> pose_file)
    : folder_(std::move(folder)), only_one_(pose_file.has_value()) {
  if (pose_file) files_[pose_file->string()].path = *pose_file;
}

void PoseBook::arrived(const std::string& name) {
  const fs::path path(name);
  if (file_kind(name) == FileKind::sidecar) {
    sidecars_.insert(name);
    sidecars_changed_ = true;
    const std::string stem = (path.parent_path() / path.stem()).generic_string();
    // Read again for the photographs STEM.* and STEM.
    std::erase_if(read_, [&](const auto& entry) {
      return entry.first == stem || fs::path(entry.first).replace_extension() == fs::path(stem);
    });
  } else if (!only_one_ && path.filename() == "poses.csv") {
    PoseFile& file = files_[name];
    file.path = folder_ / path;
    file.prefix = path.has_parent_path() ? path.parent_path().generic_string() + "/" : "";
  }
}

void PoseBook::gone(const std::string& name) { sidecars_.erase(name); }

bool PoseBook::read(PoseFile& file, bool with_last_line) {
  formats::PoseSet set;
  file.read_all = with_last_line;
  try {
    set = with_last_line ? formats::read_poses(file.path.string()) : formats::read_growing_poses(file.path.string());
    file.problem.clear();
  } catch (const Error& error) {
    const bool is_new = file.problem != error.what();
    file.problem = error.what();
    return is_new;
  }
  bool changed = false;
  for (formats::PosedImage& image : set.images) {
    const std::string name = file.prefix + image.name;
    const auto known = file.images.find(name);
    if (file.refused.erase(name) == 0 && known != file.images.end() && same(known->second, image)) continue;
    file.images[name] = std::move(image);
    changed = true;
  }
  for (const formats::RefusedImage& image : set.refused) {
    std::string& reason = file.refused[file.prefix + image.name];
    changed = file.images.erase(file.prefix + image.name) > 0 || reason != image.reason || changed;
    reason = image.reason;
  }
  return changed;
}

bool PoseBook::refresh(double now_s, bool believe_all) {
  bool changed = std::exchange(sidecars_changed_, false);
  for (auto& [name, file] : files_) {
    const std::string stamp = stamp_of(file.path);
    if (stamp.empty()) continue;
    const bool is_table = file.path.extension() == ".csv";
    if (stamp != file.stamp) {
      file.stamp = stamp;
      file.since_s = now_s;
      file.read_all = false;
      if (is_table) changed = read(file, false) || changed;
    }
    const double patience_s = is_table ? kStandsStill_s : kSettles_s;
    if (!file.read_all && (believe_all || now_s - file.since_s >= patience_s)) changed = read(file, true) || changed;
  }
  return changed;
}

const PoseBook::Sidecar* PoseBook::sidecar_of(const std::string& photograph) {
  if (const auto known = read_.find(photograph); known != read_.end()) return &known->second;
  const std::string stem = fs::path(photograph).replace_extension().generic_string();
  for (const std::string& name : {stem + ".json", stem + ".csv", photograph + ".json", photograph + ".csv"}) {
    if (!sidecars_.contains(name)) continue;
    Sidecar& sidecar = read_[photograph];
    try {
      sidecar.image = formats::read_pose_sidecar((folder_ / name).string(), photograph);
    } catch (const Error& error) {
      sidecar.problem = error.what();
    }
    return &sidecar;
  }
  return nullptr;
}

Pairing PoseBook::pair(const std::vector<std::string>& photographs) {
  // A name that several files know has its pose from the nearest: they come from the folder downwards.
  std::map<std::string, formats::PosedImage> images;
  std::map<std::string, std::string> refused;
  std::vector<const PoseFile*> from_above;
  for (const auto& [name, file] : files_) from_above.push_back(&file);
  std::stable_sort(from_above.begin(), from_above.end(),
                   [](const auto* a, const auto* b) { return a->prefix.size() < b->prefix.size(); });
  for (const PoseFile* file : from_above) {
    for (const auto& [name, image] : file->images) {
      images[name] = image;
      images[name].name = name;
      refused.erase(name);
    }
    for (const auto& [name, reason] : file->refused) {
      refused[name] = reason;
      images.erase(name);
    }
  }
  formats::PoseSet set;
  for (auto& [name, image] : images) set.images.push_back(std::move(image));
  for (auto& [name, reason] : refused) set.refused.push_back({name, std::move(reason)});

  Pairing pairing;
  const formats::ImageMatches matches = formats::match_images(photographs, set);
  for (const formats::ImageMatch& match : matches.matches) pairing.posed[match.photo] = set.images[match.pose];
  for (const formats::Unmatched& photo : matches.photos_without_pose)
    if (!photo.is_absent) pairing.refused[photo.name] = photo.reason;
  pairing.poses_waiting = matches.poses_without_photo.size();
  for (const std::string& photograph : photographs) {
    if (const Sidecar* sidecar = sidecar_of(photograph)) {
      pairing.posed.erase(photograph);
      pairing.refused.erase(photograph);
      if (sidecar->image)
        pairing.posed[photograph] = *sidecar->image;
      else
        pairing.refused[photograph] = sidecar->problem;
    }
    if (!pairing.posed.contains(photograph) && !pairing.refused.contains(photograph))
      pairing.waiting.push_back(photograph);
  }
  for (auto& [photograph, image] : pairing.posed) image.name = photograph;
  return pairing;
}

std::vector<std::string> PoseBook::problems() const {
  std::vector<std::string> sentences;
  for (const auto& [name, file] : files_)
    if (!file.problem.empty()) sentences.push_back(file.problem);
  return sentences;
}

}  // namespace skysweep::watch
