// SPDX-License-Identifier: Apache-2.0
// Which height planes are searched: k counts planes z = k dz on the absolute lattice, so that a wider range never moves
// a plane.
#pragma once

#include <vector>

namespace skysweep::sweep {

// Planes k = first..last.
struct PlaneRange {
  int first = 0;
  int last = -1;

  bool empty() const { return last < first; }
  int count() const { return empty() ? 0 : last - first + 1; }
  bool contains(int k) const { return first <= k && k <= last; }
  void include(PlaneRange other);  // and everything between
  friend bool operator==(PlaneRange, PlaneRange) = default;
};

// The planes that bracket all heights from z_low to z_high, `margin` planes more on both sides.
PlaneRange planes_between(double z_low, double z_high, double dz_m, int margin);

// Ranges of planes with planes between them that are not searched: the ground and the roof of a house, not the air
// between.
class PlaneSet {
 public:
  PlaneSet() = default;
  PlaneSet(PlaneRange range);  // NOLINT(google-explicit-constructor): a range is a set

  bool empty() const { return ranges_.empty(); }
  int count() const;        // planes in all ranges
  PlaneRange hull() const;  // from the lowest to the highest plane
  bool contains(int k) const { return contains(PlaneRange{k, k}); }
  bool contains(PlaneRange range) const;                             // within one of its ranges
  const std::vector<PlaneRange>& ranges() const { return ranges_; }  // ascending, at least one plane apart

  void include(PlaneRange range);
  void include(const PlaneSet& other);
  // What lies outside `range` goes.
  void clip(PlaneRange range);
  // Ranges that are at most `planes` planes apart become one.
  void bridge(int planes);

  friend bool operator==(const PlaneSet&, const PlaneSet&) = default;

 private:
  std::vector<PlaneRange> ranges_;
};

}  // namespace skysweep::sweep
