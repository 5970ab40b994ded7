#pragma once

#include <vector>

#include "inscribed_circles.h"
#include "planar_object.h"

namespace deformable_manipulation {
namespace distance {

//! Nearest points of triangulated surfaces to a region, both seen along the normal of the plane.
//!
//! Seen so, a triangle is filled. Its point with the least signed distance is on one of its edges, or it is one of
//! the region's centres of inscribed circles.
class PlanarSurface {
 public:
  explicit PlanarSurface(PlanarRegion& region) : region_(region), circles_(inscribedCircles(region)) {}

  //! The point with the least signed distance, which is not more than `bound` [m].
  MaterialPoint minimum(const PlanarCopy& copy, const std::array<int, 3>* triangles, int count, double bound);

  //! Appends the nearest point of each triangle whose signed distance is at most `limit` [m]. Where several are equally
  //! near, their mean if it is so, too.
  void elements(const PlanarCopy& copy, const std::array<int, 3>* triangles, int count, double limit,
                std::vector<MaterialPoint>* found);

 private:
  using Corners = std::array<Point2, 3>;

  void boundPoints(const PlanarCopy& copy);
  double lowerBound(const Corners& corners, const std::array<int, 3>& triangle) const;
  MaterialPoint nearest(const Corners& corners, const std::array<int, 3>& triangle, double bound,
                        bool may_contain_circle);
  MaterialPoint nearestMiddle(const Corners& corners, const std::array<int, 3>& triangle, double bound,
                              bool may_contain_circle);
  void enterCircles(const Corners& corners, double bound, MaterialPoint* best) const;

  PlanarRegion& region_;
  std::vector<InscribedCircle> circles_;  // the largest first
  std::vector<double> lower_;             // m, of the copy's points
};

}  // namespace distance
}  // namespace deformable_manipulation
