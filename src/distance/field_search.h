#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "distance_field.h"
#include "triangle_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! A point of a segment or triangle with its signed distance in a field.
struct FieldPlace {
  double distance = INFINITY;  //!< [m] signed
  Weights weights = {0.0, 0.0, 0.0};
};

//! A signed distance and the direction along which it grows.
struct FieldSample {
  double distance;   //!< [m]
  Vector3 gradient;  //!< of any length
};

//! The least signed distance of segments and triangles in a field.
//!
//! Elements are cut at the planes of the grid. Within a cell, the function is its first-order expansion but for
//! products of coordinates, which are bounded. What cannot be below the least so far is dropped, all else halved.
//!
//! Outside of the field nothing is known. If that counts as free, a point at the distance d from its nearest point b on
//! the border, where the field is f, is at least hypot(d, f) away from all that is within, or d + f where f is
//! negative. If it counts as occupied, the border is the surface of an obstacle around the field.
class FieldSearch {
 public:
  //! @param field that stays
  FieldSearch(const DistanceField& field, bool is_free_outside) : field_(field), is_free_(is_free_outside) {}

  FieldSample sample(const Vector3& point) const;

  //! Its distance alone [m].
  double distanceAt(const Vector3& point) const;

  //! No more than this much the distance changes per metre, anywhere.
  double steepness() const { return std::hypot(1.0, field_.steepness()); }

  //! A lower bound [m] of an element's least distance.
  //! @param enough [m] it is sought no farther than it is known to be above this
  double lowerBound(const Corners<3>& corners, double enough = INFINITY) const;

  //! The point with the least distance, to kTolerance; if none is below the limit [m], its distance is infinite.
  //! @param count of the corners: 2 or 3
  FieldPlace minimum(const Corners<3>& corners, int count, double limit);

  static constexpr double kTolerance = 1e-5;  // m

 private:
  struct Piece {
    Corners<3> corners;
    std::array<Weights, 3> weights;
    std::array<double, 3> distances;  // m, at the corners
  };

  //! The cells around an element, and the box around it.
  struct Surroundings {
    DistanceField::Index from, to;
    Vector3 low, high, middle;
  };

  double bySlopes(const Corners<3>& corners, const Surroundings& around) const;
  double borderDistance(const Vector3& point, Vector3* gradient) const;
  FieldSample within(const CellExpansion& f, const Vector3& beyond) const;
  double cellBound(const Piece& piece) const;
  bool cut(const Piece& piece);
  void halve(const Piece& piece);
  void divide(const Piece& piece, int from, int to, double parameter);
  double consider(const Vector3& point, const Weights& weights);
  FieldPlace middle(const Corners<3>& corners) const;

  const DistanceField& field_;
  bool is_free_;
  int count_ = 0;
  FieldPlace best_;
  std::vector<Piece> pieces_;  // that are still to be searched
};

}  // namespace distance
}  // namespace deformable_manipulation
