// SPDX-License-Identifier: Apache-2.0
#include "formats/match_images.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>

namespace skysweep::formats {
namespace {

// A photograph or a pose on its way to a partner.
struct Side {
  std::string name;  // as given
  std::string path;  // with '/' and without a leading "./"
  std::optional<std::size_t> partner;
  std::string ambiguity;  // a sentence if it has several possible partners

  bool is_free() const { return !partner && ambiguity.empty(); }
};

using Key = std::function<std::string(const std::string& path)>;
using Members = std::vector<std::size_t>;

std::string normalised(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  while (path.starts_with("./")) path.erase(0, 2);
  return path;
}

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string lower_case_file_name(const std::string& path) {
  std::string name = file_name(path);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return name;
}

std::vector<Side> sides(const std::vector<std::string>& names) {
  std::vector<Side> all;
  for (const std::string& name : names) all.push_back({name, normalised(name), {}, {}});
  return all;
}

// "'a', 'b' and 3 more"
std::string listed(const std::vector<Side>& all, const Members& members) {
  constexpr std::size_t kNamed = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(members.size(), kNamed); ++i)
    text += (i > 0 ? ", '" : "'") + all[members[i]].name + "'";
  if (members.size() > kNamed) text += " and " + std::to_string(members.size() - kNamed) + " more";
  return text;
}

bool any_free(const std::vector<Side>& all, const Members& members) {
  return std::any_of(members.begin(), members.end(), [&](std::size_t i) { return all[i].is_free(); });
}

// Pairs the free photographs and poses whose keys agree. A key that several photographs or several poses have decides
// nothing, even if only one of each is still free. Gives back the photographs that were paired.
Members pair_by(const Key& key, std::vector<Side>& photos, std::vector<Side>& poses) {
  struct Group {
    Members photos, poses;
  };
  std::map<std::string, Group> groups;
  for (std::size_t i = 0; i < photos.size(); ++i) groups[key(photos[i].path)].photos.push_back(i);
  for (std::size_t i = 0; i < poses.size(); ++i) groups[key(poses[i].path)].poses.push_back(i);

  Members paired;
  for (const auto& [name, group] : groups) {
    if (!any_free(photos, group.photos) || !any_free(poses, group.poses)) continue;
    if (group.photos.size() == 1 && group.poses.size() == 1) {
      photos[group.photos[0]].partner = group.poses[0];
      poses[group.poses[0]].partner = group.photos[0];
      paired.push_back(group.photos[0]);
      continue;
    }
    const std::string sentence = "Photographs " + listed(photos, group.photos) + " and poses " +
                                 listed(poses, group.poses) +
                                 " share a file name, so which belongs to which is open; name the images in the pose "
                                 "file by their paths relative to the image folder.";
    for (const std::size_t i : group.photos)
      if (photos[i].is_free()) photos[i].ambiguity = sentence;
    for (const std::size_t i : group.poses)
      if (poses[i].is_free()) poses[i].ambiguity = sentence;
  }
  return paired;
}

bool in_folder(const std::string& path) { return path.find('/') != std::string::npos; }

// Whether both names have folders that contradict each other, rather than one being the longer path of the other.
bool folders_differ(const std::string& a, const std::string& b) {
  return in_folder(a) && in_folder(b) && !a.ends_with("/" + b) && !b.ends_with("/" + a);
}

// One note for all `paired` photographs; none if there are none.
void note_pairs(const Members& paired, const char* how, const std::vector<Side>& photos, const std::vector<Side>& poses,
                std::vector<std::string>& notes) {
  if (paired.empty()) return;
  const Side& first = photos[paired.front()];
  notes.push_back(std::to_string(paired.size()) + " photograph(s) were paired with their poses " + how +
                  "; the first: '" + first.name + "' with '" + poses[*first.partner].name + "'.");
}

}  // namespace

ImageMatches match_images(std::vector<std::string> photo_names, const PoseSet& set) {
  std::sort(photo_names.begin(), photo_names.end());
  std::vector<Side> photos = sides(photo_names);
  // Refused poses take part, so that their photographs are not given another one's; they follow the usable ones.
  std::vector<std::string> pose_names;
  for (const PosedImage& image : set.images) pose_names.push_back(image.name);
  for (const RefusedImage& image : set.refused) pose_names.push_back(image.name);
  std::vector<Side> poses = sides(pose_names);

  ImageMatches result;
  pair_by([](const std::string& path) { return path; }, photos, poses);
  Members elsewhere = pair_by(file_name, photos, poses);
  std::erase_if(elsewhere,
                [&](std::size_t i) { return !folders_differ(photos[i].path, poses[*photos[i].partner].path); });
  note_pairs(elsewhere, "by file name although their folders differ", photos, poses, result.notes);
  note_pairs(pair_by(lower_case_file_name, photos, poses), "without regard to upper and lower case", photos, poses,
             result.notes);

  const std::size_t usable = set.images.size();
  for (const Side& photo : photos) {
    if (photo.partner && *photo.partner < usable)
      result.matches.push_back({photo.name, *photo.partner});
    else if (photo.partner)
      result.photos_without_pose.push_back({photo.name, set.refused[*photo.partner - usable].reason, false});
    else if (!photo.ambiguity.empty())
      result.photos_without_pose.push_back({photo.name, photo.ambiguity, false});
    else
      result.photos_without_pose.push_back({photo.name, "The pose file has no pose for '" + photo.name + "'."});
  }
  for (std::size_t i = 0; i < usable; ++i) {
    if (poses[i].partner) continue;
    const std::string absent = set.images[i].where + ": there is no photograph '" + poses[i].name + "'.";
    const bool unknown = poses[i].ambiguity.empty();
    result.poses_without_photo.push_back({poses[i].name, unknown ? absent : poses[i].ambiguity, unknown});
  }
  return result;
}

}  // namespace skysweep::formats
