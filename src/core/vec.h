// SPDX-License-Identifier: Apache-2.0
// Small vectors and matrices in double precision: just what cameras and boxes need.
#pragma once

#include <array>
#include <cmath>

namespace skysweep {

struct Vec2d {
  double x = 0, y = 0;
  friend constexpr bool operator==(const Vec2d&, const Vec2d&) = default;
};

struct Vec3d {
  double x = 0, y = 0, z = 0;
  friend constexpr bool operator==(const Vec3d&, const Vec3d&) = default;
};

constexpr Vec2d operator+(Vec2d a, Vec2d b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2d operator-(Vec2d a, Vec2d b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2d operator*(double s, Vec2d a) { return {s * a.x, s * a.y}; }
constexpr double dot(Vec2d a, Vec2d b) { return a.x * b.x + a.y * b.y; }
// z component of the 3D cross product: twice the signed area of the triangle (0, a, b).
constexpr double cross(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2d a) { return std::sqrt(dot(a, a)); }

constexpr Vec3d operator+(Vec3d a, Vec3d b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3d operator-(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3d operator-(Vec3d a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3d operator*(double s, Vec3d a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3d cross(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3d a) { return std::sqrt(dot(a, a)); }
inline Vec3d normalized(Vec3d a) { return (1.0 / norm(a)) * a; }
inline bool is_finite(Vec3d a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

// 3 x 3 matrix, row-major.
struct Mat3d {
  std::array<double, 9> m = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  constexpr double operator()(int row, int column) const { return m[3 * row + column]; }
  constexpr double& operator()(int row, int column) { return m[3 * row + column]; }
  constexpr Vec3d row(int i) const { return {m[3 * i], m[3 * i + 1], m[3 * i + 2]}; }
  friend constexpr bool operator==(const Mat3d&, const Mat3d&) = default;
};

constexpr Vec3d operator*(const Mat3d& a, Vec3d v) { return {dot(a.row(0), v), dot(a.row(1), v), dot(a.row(2), v)}; }
constexpr Mat3d transpose(const Mat3d& a) {
  return {{a(0, 0), a(1, 0), a(2, 0), a(0, 1), a(1, 1), a(2, 1), a(0, 2), a(1, 2), a(2, 2)}};
}
constexpr Mat3d operator*(const Mat3d& a, const Mat3d& b) {
  Mat3d c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return c;
}
constexpr double determinant(const Mat3d& a) { return dot(a.row(0), cross(a.row(1), a.row(2))); }

}  // namespace skysweep
