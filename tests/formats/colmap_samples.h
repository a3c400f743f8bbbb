// SPDX-License-Identifier: Apache-2.0
// The bytes of COLMAP's binary files, written from its documentation and independently of the reader.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace skysweep::formats {

class Bytes {
 public:
  template <typename T>
  Bytes& add(T value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Bytes& add_doubles(const std::vector<double>& values) {
    for (const double value : values) add(value);
    return *this;
  }
  Bytes& add_name(const std::string& name) {
    text_.append(name.c_str(), name.size() + 1);
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

inline Bytes& add_camera(Bytes& file, std::uint32_t id, std::int32_t model, std::uint64_t width, std::uint64_t height,
                         const std::vector<double>& parameters) {
  return file.add(id).add(model).add(width).add(height).add_doubles(parameters);
}

// `pose`: qw, qx, qy, qz, tx, ty, tz.
inline Bytes& add_image(Bytes& file, std::uint32_t id, const std::vector<double>& pose, std::uint32_t camera,
                        const std::string& name, std::uint64_t observations) {
  file.add(id).add_doubles(pose).add(camera).add_name(name).add(observations);
  for (std::uint64_t i = 0; i < observations; ++i) file.add(1.5).add(2.5).add(std::uint64_t{7});
  return file;
}

inline Bytes& add_point(Bytes& file, std::uint64_t id, const std::vector<double>& position, double error,
                        std::uint64_t track) {
  file.add(id)
      .add_doubles(position)
      .add(std::uint8_t{1})
      .add(std::uint8_t{2})
      .add(std::uint8_t{3})
      .add(error)
      .add(track);
  for (std::uint64_t i = 0; i < track; ++i) file.add(std::uint32_t{1}).add(std::uint32_t{2});
  return file;
}

}  // namespace skysweep::formats
