#pragma once

#include <array>
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
};

//! Tells which points are near some elements: those of a cloud that a robot sees of itself and of what it carries.
class NearElements {
 public:
  //! @throw std::invalid_argument a coordinate or a reach is not finite, or a reach is negative
  explicit NearElements(std::vector<NearElement> elements);
  ~NearElements();

  //! @param xyz [count x 3] m
  //! @param marks [count] whether the point is within the reach of an element; not if it is not finite
  void mark(const float* xyz, std::size_t count, bool* marks) const;
  void mark(const double* xyz, std::size_t count, bool* marks) const;

 private:
  struct Tree;
  template <typename Number>
  void markAll(const Number* xyz, std::size_t count, bool* marks) const;
  bool isNear(const Vector3& point) const;

  std::vector<NearElement> elements_;
  std::unique_ptr<const Tree> tree_;  // null without elements
};

}  // namespace distance
}  // namespace deformable_manipulation
