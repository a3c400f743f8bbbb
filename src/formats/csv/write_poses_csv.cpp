// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"
#include "formats/pose_writers.h"
#include "formats/text/line_reader.h"
#include "formats/text/numbers.h"
#include "formats/text/text_file.h"

namespace skysweep::formats {
namespace {

// The name as a field: quoted only where it must be.
std::string field(const std::string& name, const std::string& path) {
  if (name.empty() || name.find_first_of("\r\n") != std::string::npos)
    throw bad_input(path + ": the image name '" + name + "' is empty or holds a line break; rename the photograph.");
  const bool plain = name.find_first_of(",\"") == std::string::npos && name.front() != '#' && trimmed(name) == name;
  if (plain) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

std::string row(const PosedImage& image, const std::string& path) {
  const camera::CameraModel& m = image.model;
  const camera::Distortion& d = m.distortion;
  const camera::Quaternion q = camera::quaternion_from_rotation(image.pose.cam_from_world);
  const Vec3d c = image.pose.center;
  std::string text = field(image.name, path);
  for (const double value : {c.x, c.y, c.z, q.w, q.x, q.y, q.z}) text += ',' + exact_text(value);
  text += ',' + std::to_string(m.width_px) + ',' + std::to_string(m.height_px);
  for (const double value : {m.fx_px, m.fy_px, m.cx_px, m.cy_px, d.k1, d.k2, d.p1, d.p2, d.k3})
    text += ',' + exact_text(value);
  return text + '\n';
}

}  // namespace

void write_poses_csv(const std::string& path, const std::vector<PosedImage>& images) {
  std::string text = "image,x,y,z,qw,qx,qy,qz,width,height,fx,fy,cx,cy,k1,k2,p1,p2,k3\n";
  for (const PosedImage& image : images) text += row(image, path);
  write_text_file(path, text);
}

}  // namespace skysweep::formats
