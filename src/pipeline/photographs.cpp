// SPDX-License-Identifier: Apache-2.0
#include "pipeline/photographs.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "formats/match_images.h"
#include "raster/digest.h"
#include "raster/photo.h"

namespace skysweep::pipeline {
namespace {

using index::ImageRecord;
using index::ImageStatus;

ImageRecord refused(const std::string& name, const std::string& reason) {
  ImageRecord record;
  record.name = name;
  record.status = ImageStatus::refused;
  record.reason = reason;
  return record;
}

// Everything that can be known without decoding: is it an image, of the camera's size, seen steeply enough?
ImageRecord inspect(const std::filesystem::path& folder, const std::string& name, const formats::PosedImage& posed,
                    const PhotographOptions& options) {
  const std::filesystem::path path = folder / name;
  ImageRecord record;
  record.name = name;
  record.model = posed.model;
  record.pose = posed.pose;
  const auto refuse = [&](const std::string& reason) {
    record.status = ImageStatus::refused;
    record.reason = reason;
    return record;
  };
  try {
    const raster::PhotoSize size = raster::read_photo_size(path);
    const camera::CameraModel& model = posed.model;
    if (size.width_px != model.width_px || size.height_px != model.height_px)
      return refuse(path.string() + " has " + std::to_string(size.width_px) + " x " + std::to_string(size.height_px) +
                    " pixels, but its camera in " + posed.where + " has " + std::to_string(model.width_px) + " x " +
                    std::to_string(model.height_px) + ": use the photographs the poses were computed from.");
    record.content_digest = raster::digest_of_file(path);
    record.file_bytes = static_cast<long long>(std::filesystem::file_size(path));
  } catch (const Error& error) {
    return refuse(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return refuse(error.what());
  }
  const camera::Camera camera(posed.model, posed.pose);
  record.view_class = camera::classify(camera, options.near_vertical_limit_deg);
  if (record.view_class == camera::ViewClass::oblique || record.view_class == camera::ViewClass::high_oblique) {
    record.status = ImageStatus::oblique;
    record.reason = name + " looks " + std::to_string(std::lround(camera::off_nadir_deg(posed.pose))) +
                    " degrees away from nadir; up to " + std::to_string(std::lround(options.near_vertical_limit_deg)) +
                    " are matched.";
  }
  return record;
}

std::string nothing_usable(const std::vector<ImageRecord>& records, const std::filesystem::path& images) {
  std::string sentence = "None of the " + std::to_string(records.size()) + " photographs in " + images.string() +
                         " can be matched. The first: " + records.front().reason;
  const bool all_oblique = std::all_of(records.begin(), records.end(),
                                       [](const ImageRecord& r) { return r.status == ImageStatus::oblique; });
  if (all_oblique)
    sentence +=
        " If the cameras did look down, the pitch angles of the pose file may count from nadir: Skysweep takes "
        "-90 as straight down.";
  return sentence;
}

}  // namespace

PhotographSet collect_photographs(const std::filesystem::path& images, const std::filesystem::path& poses_path,
                                  Vec3d origin, const PhotographOptions& options, Executor& executor) {
  const std::vector<std::string> names = raster::list_photos(images);
  if (names.empty())
    throw bad_input("There are no photographs in " + images.string() +
                    " or its subfolders (JPEG, PNG, TIFF, WebP and BMP are read).");
  formats::PoseSet poses = formats::read_poses(poses_path.string());
  formats::add_origin(poses, origin);
  const formats::ImageMatches matches = formats::match_images(names, poses);

  PhotographSet set;
  set.notes = poses.notes;
  set.notes.insert(set.notes.end(), matches.notes.begin(), matches.notes.end());
  for (const formats::Unmatched& pose : matches.poses_without_photo) set.warnings.push_back(pose.reason);
  for (const formats::RefusedImage& pose : poses.refused) set.warnings.push_back(pose.reason);

  set.records.resize(matches.matches.size());
  executor.parallel_for(static_cast<int>(matches.matches.size()), [&](int i) {
    const formats::ImageMatch& match = matches.matches[i];
    set.records[i] = inspect(images, match.photo, poses.images[match.pose], options);
  });
  for (const formats::Unmatched& photo : matches.photos_without_pose)
    set.records.push_back(refused(photo.name, photo.reason));
  std::sort(set.records.begin(), set.records.end(),
            [](const ImageRecord& a, const ImageRecord& b) { return a.name < b.name; });

  const auto used = std::count_if(set.records.begin(), set.records.end(),
                                  [](const ImageRecord& r) { return r.status == ImageStatus::used; });
  if (used == 0) throw bad_input(nothing_usable(set.records, images));
  if (used == 1)
    throw bad_input("Only one photograph in " + images.string() +
                    " can be used; heights need at least two that show the same ground.");
  return set;
}

std::vector<std::string> refusals(const std::vector<ImageRecord>& records) {
  std::vector<std::string> reasons;
  for (const ImageRecord& record : records)
    if (record.status != ImageStatus::used) reasons.push_back(record.name + ": " + record.reason);
  return reasons;
}

}  // namespace skysweep::pipeline
