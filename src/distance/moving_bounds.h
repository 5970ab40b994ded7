#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "triangle_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! Lower bounds [m] of the distances between an object's elements and a surface, that stay true while the object moves.
//!
//! A distance falls by no more than the farthest any point has moved since it was known. Of an element that is near, a
//! plane is known as well: the surface is below it, or far from the element. How high the element is above the plane
//! tells its distance but for the second order of its motion.
class MovingBounds {
 public:
  struct Plane {
    Vector3 normal = Vector3::Zero();  //!< unit vector
    double height = INFINITY;          //!< [m] along the normal
    double beyond = -INFINITY;         //!< [m] what is above the plane is not nearer to the element than this
  };

  //! Forgets everything.
  void reset(int elements) {
    bounds_.assign(elements, -INFINITY);
    planes_.assign(elements, Plane());
    others_.clear();
    least_ = -INFINITY;
  }

  //! @param step [m] no point has moved farther since the last call
  void move(double step) {
    travel_ += step * (1.0 + 1e-12);
    reserve_ = step > 0.0 ? std::min(kHorizon * step, kLargestReserve) : reserve_;
  }

  double of(int element) const { return bounds_[element] - travel_; }

  //! Of all elements, as known at the last call of findLeast().
  double least() const { return least_ - travel_; }
  void findLeast() { least_ = *std::min_element(bounds_.begin(), bounds_.end()); }

  //! @param bound [m] of the element, where it is now
  void set(int element, double bound) { bounds_[element] = bound + travel_; }

  //! @param plane with its `beyond` as it is now
  void set(int element, const Plane& plane) { planes_[element] = asBefore(plane); }

  //! Notes what is known of all pieces of the surface but the one that is nearest to an element.
  //! @param plane of those pieces, with its `beyond` as it is now
  void setOthers(int element, const Plane& plane) {
    others_.resize(planes_.size());
    others_[element] = asBefore(plane);
  }

  //! A lower bound [m] of their distances from the element.
  double ofOthers(int element, const Corners<3>& corners) const {
    return others_.empty() ? -INFINITY : boundBy(others_[element], corners);
  }

  //! Of an element's plane, or zero.
  const Vector3& normal(int element) const { return planes_[element].normal; }

  //! Whether an element is at least so far away [m], as its plane tells.
  bool renew(int element, const Corners<3>& corners, double least) {
    const double bound = boundBy(planes_[element], corners);
    if (bound < least) {
      return false;
    }
    bounds_[element] = bound + travel_;
    return true;
  }

  //! How much [m] farther than necessary it pays to look, for the sake of the next calls.
  double reserve() const { return reserve_; }

 private:
  static constexpr double kHorizon = 8.0;          // calls
  static constexpr double kLargestReserve = 0.02;  // m

  Plane asBefore(Plane plane) const {
    plane.beyond += travel_;
    return plane;
  }

  double boundBy(const Plane& plane, const Corners<3>& corners) const {
    double above = INFINITY;
    for (const Vector3& corner : corners) {
      above = std::min(above, plane.normal.dot(corner));
    }
    return std::min(above - plane.height, plane.beyond - travel_);
  }

  std::vector<double> bounds_;  // m, as they were before anything moved
  std::vector<Plane> planes_;   // of the elements; `beyond` as before anything moved
  std::vector<Plane> others_;   // likewise, of all but the nearest pieces; empty until they are asked for
  double least_ = -INFINITY;    // m, the same of all
  double travel_ = 0.0;         // m
  double reserve_ = 0.0;
};

}  // namespace distance
}  // namespace deformable_manipulation
