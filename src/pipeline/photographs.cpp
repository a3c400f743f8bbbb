// SPDX-License-Identifier: Apache-2.0
#include "pipeline/photographs.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "formats/match_images.h"
#include "raster/digest.h"
#include "raster/file_stamp.h"
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

// Whether the record of an earlier run still holds for the file: nobody touched it, and its camera has the same size.
bool still_holds(const ImageRecord* known, const std::string& stamp, const camera::CameraModel& model) {
  return known && known->status != ImageStatus::refused && !known->content_digest.empty() && known->stamp == stamp &&
         known->model.width_px == model.width_px && known->model.height_px == model.height_px;
}

// Fills what is known of the file itself; a reason if it cannot be used.
std::optional<std::string> read_file(const std::filesystem::path& path, const formats::PosedImage& posed,
                                     ImageRecord& record) {
  try {
    record.stamp = raster::settled_file_stamp(path);
    const raster::PhotoSize size = raster::read_photo_size(path);
    const camera::CameraModel& model = posed.model;
    if (size.width_px != model.width_px || size.height_px != model.height_px)
      return path.string() + " has " + std::to_string(size.width_px) + " x " + std::to_string(size.height_px) +
             " pixels, but its camera in " + posed.where + " has " + std::to_string(model.width_px) + " x " +
             std::to_string(model.height_px) + ": use the photographs the poses were computed from.";
    record.content_digest = raster::digest_of_file(path);
    record.file_bytes = static_cast<long long>(std::filesystem::file_size(path));
  } catch (const Error& error) {
    return error.what();
  } catch (const std::filesystem::filesystem_error& error) {
    return error.what();
  }
  return std::nullopt;
}

// Everything that can be known without decoding: is it an image, of the camera's size, seen steeply enough?
ImageRecord inspect(const std::filesystem::path& folder, const std::string& name, const formats::PosedImage& posed,
                    const PhotographOptions& options, const ImageRecord* known) {
  const std::filesystem::path path = folder / name;
  ImageRecord record;
  record.name = name;
  record.model = posed.model;
  record.pose = posed.pose;
  const std::optional<std::string> stamp = raster::file_stamp(path);
  if (!stamp) throw photograph_vanished(path);
  if (still_holds(known, *stamp, posed.model)) {
    record.content_digest = known->content_digest;
    record.file_bytes = known->file_bytes;
    record.stamp = known->stamp;
  } else if (std::optional<std::string> reason = read_file(path, posed, record)) {
    if (!raster::file_stamp(path)) throw photograph_vanished(path);
    record.status = ImageStatus::refused;
    record.reason = std::move(*reason);
    return record;
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

Error photograph_vanished(const std::filesystem::path& path) {
  return failure("The photograph " + path.string() +
                 " was there a moment ago and is gone: see that its disk or folder is still connected and run again. "
                 "What the project holds is left as it is.");
}

PhotographSet collect_photographs(const std::filesystem::path& images, const std::filesystem::path& poses_path,
                                  Vec3d origin, const PhotographOptions& options, Executor& executor,
                                  const std::vector<ImageRecord>& known) {
  const std::vector<std::string> names = raster::list_photos(images);
  if (names.empty())
    throw bad_input("There are no photographs in " + images.string() +
                    " or its subfolders (JPEG, PNG, TIFF, WebP and BMP are read).");
  return inspect_photographs(images, names, formats::read_poses(poses_path.string()), origin, options, executor, known);
}

PhotographSet inspect_photographs(const std::filesystem::path& images, const std::vector<std::string>& names,
                                  formats::PoseSet poses, Vec3d origin, const PhotographOptions& options,
                                  Executor& executor, const std::vector<ImageRecord>& known) {
  formats::add_origin(poses, origin);
  const formats::ImageMatches matches = formats::match_images(names, poses);

  PhotographSet set;
  set.notes = poses.notes;
  set.notes.insert(set.notes.end(), matches.notes.begin(), matches.notes.end());
  for (const formats::Unmatched& pose : matches.poses_without_photo) set.warnings.push_back(pose.reason);
  for (const formats::RefusedImage& pose : poses.refused) set.warnings.push_back(pose.reason);

  std::map<std::string, const ImageRecord*> known_by_name;
  for (const ImageRecord& record : known) known_by_name[record.name] = &record;
  set.records.resize(matches.matches.size());
  executor.parallel_for(static_cast<int>(matches.matches.size()), [&](int i) {
    const formats::ImageMatch& match = matches.matches[i];
    const auto found = known_by_name.find(match.photo);
    const ImageRecord* of_earlier = found == known_by_name.end() ? nullptr : found->second;
    set.records[i] = inspect(images, match.photo, poses.images[match.pose], options, of_earlier);
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
    if (record.status == ImageStatus::refused || record.status == ImageStatus::oblique)
      reasons.push_back(record.name + ": " + record.reason);
  return reasons;
}

}  // namespace skysweep::pipeline
