#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace distance {

using pbd::Vector3;

//! A triangle, or a segment as start, end, end, or a point three times, with what is around it.
struct NearElement {
  std::array<Vector3, 3> corners;  //!< [m]
  double reach = 0.0;              //!< [m]
  double farthest =
      INFINITY;  //!< [m] points that are farther away do not count, wherever else on their rays they may be
};

//! Points may be elsewhere on their rays: a point at the distance r from the origin by up to `doubt` r^2 either way.
struct Rays {
  Vector3 origin = Vector3::Zero();  //!< [m]
  double doubt = 0.0;                //!< [1/m]
};

//! Tells which points are near some elements: those of a cloud that a robot sees of itself and of what it carries.
class NearElements {
 public:
  //! @throw std::invalid_argument a coordinate, a reach or the doubt is not finite, or one of the last two is negative
  explicit NearElements(std::vector<NearElement> elements, const Rays& rays = Rays());
  ~NearElements();

  //! @param xyz [count x 3] m
  //! @param marks [count] whether the point, or where else on its ray it may be, is within the reach of an element; not
  //!     if it is not finite
  void mark(const float* xyz, std::size_t count, bool* marks) const;
  void mark(const double* xyz, std::size_t count, bool* marks) const;

 private:
  struct Tree;
  template <typename Number>
  void markAll(const Number* xyz, std::size_t count, bool* marks) const;
  bool isNear(const Vector3& point, const Vector3& doubt) const;

  std::vector<NearElement> elements_;
  Rays rays_;
  std::unique_ptr<const Tree> tree_;  // null without elements
};

}  // namespace distance
}  // namespace deformable_manipulation
