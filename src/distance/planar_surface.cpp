#include "planar_surface.h"

namespace deformable_manipulation {
namespace distance {
namespace {

std::array<Point2, 3> cornersOf(const PlanarCopy& copy, const std::array<int, 3>& triangle) {
  return {copy.points[triangle[0]], copy.points[triangle[1]], copy.points[triangle[2]]};
}

//! Weights of a point of a triangle's side from corner k to the next one.
std::array<double, 3> weightsOnSide(int k, double parameter) {
  std::array<double, 3> weights = {0.0, 0.0, 0.0};
  weights[k] = 1.0 - parameter;
  weights[(k + 1) % 3] = parameter;
  return weights;
}

//! Weights of a point in the plane, all positive if it is inside the triangle; NaN if that has no area.
std::array<double, 3> weightsOf(const std::array<Point2, 3>& corners, const Point2& point) {
  const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double second = cross(point - corners[0], corners[2] - corners[0]) / area;
  const double third = cross(corners[1] - corners[0], point - corners[0]) / area;
  return {1.0 - second - third, second, third};
}

Point2 weighted(const std::array<Point2, 3>& corners, const std::array<double, 3>& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

}  // namespace

MaterialPoint PlanarSurface::minimum(const PlanarCopy& copy, const std::array<int, 3>* triangles, int count,
                                     double bound) {
  boundPoints(copy);
  MaterialPoint best;
  bound += kBoundSlack;
  for (int t = 0; t < count; ++t) {
    const Corners corners = cornersOf(copy, triangles[t]);
    const double lower = lowerBound(corners, triangles[t]);
    if (lower <= bound) {
      const MaterialPoint found = nearest(corners, triangles[t], bound, lower <= 0.0);
      if (found.distance < best.distance) {
        best = found;
        bound = std::min(bound, best.distance);
      }
    }
  }
  return best;
}

void PlanarSurface::elements(const PlanarCopy& copy, const std::array<int, 3>* triangles, int count, double limit,
                             std::vector<MaterialPoint>* found) {
  boundPoints(copy);
  for (int t = 0; t < count; ++t) {
    const Corners corners = cornersOf(copy, triangles[t]);
    const double lower = lowerBound(corners, triangles[t]);
    if (lower <= limit + kBoundSlack) {
      const MaterialPoint place = nearestMiddle(corners, triangles[t], limit, lower <= 0.0);
      if (place.distance <= limit) {
        found->push_back(place);
      }
    }
  }
}

void PlanarSurface::boundPoints(const PlanarCopy& copy) {
  lower_.resize(copy.count);
  for (int i = 0; i < copy.count; ++i) {
    lower_[i] = region_.lowerBound(copy.points[i]);
  }
}

//! The signed distance changes by no more than the way, and a triangle's ways to its corners add up to at most its
//! two longer sides.
double PlanarSurface::lowerBound(const Corners& corners, const std::array<int, 3>& triangle) const {
  const double a = normBound(corners[1] - corners[0]), b = normBound(corners[2] - corners[1]),
               c = normBound(corners[0] - corners[2]);
  const double ways = a + b + c - std::min({a, b, c});
  return (lower_[triangle[0]] + lower_[triangle[1]] + lower_[triangle[2]] - ways) / 3.0;
}

MaterialPoint PlanarSurface::nearest(const Corners& corners, const std::array<int, 3>& triangle, double bound,
                                     bool may_contain_circle) {
  MaterialPoint best;
  best.vertices = triangle;
  for (int k = 0; k < 3; ++k) {
    const Segment2 side(corners[k], corners[(k + 1) % 3]);
    const SegmentNearest found = region_.nearest(side, std::min(bound, best.distance));
    if (found.distance < best.distance) {
      best.distance = found.distance;
      best.edge = found.edge;
      best.weights = weightsOnSide(k, found.parameter);
    }
  }
  if (may_contain_circle) {
    enterCircles(corners, bound, &best);
  }
  return best;
}

MaterialPoint PlanarSurface::nearestMiddle(const Corners& corners, const std::array<int, 3>& triangle, double bound,
                                           bool may_contain_circle) {
  MaterialPoint best = nearest(corners, triangle, bound, may_contain_circle);
  if (!(best.distance <= bound)) {
    return best;
  }
  std::array<double, 3> mean = {0.0, 0.0, 0.0};
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    const Segment2 side(corners[k], corners[(k + 1) % 3]);
    const SegmentNearest found = region_.nearestMiddle(side, best.distance + kLevel);
    if (found.distance <= best.distance + kLevel) {
      const std::array<double, 3> weights = weightsOnSide(k, found.parameter);
      std::transform(weights.begin(), weights.end(), mean.begin(), mean.begin(), std::plus<double>());
      ++count;
    }
  }
  if (count > 0) {
    for (double& weight : mean) {
      weight /= count;
    }
    const SignedPoint there = region_.signedPoint(weighted(corners, mean), best.edge);
    if (there.distance <= best.distance + kLevel) {
      best.distance = there.distance;
      best.edge = there.edge;
      best.weights = mean;
    }
  }
  return best;
}

void PlanarSurface::enterCircles(const Corners& corners, double bound, MaterialPoint* best) const {
  for (const InscribedCircle& circle : circles_) {
    if (-circle.radius > std::min(bound, best->distance)) {
      return;
    }
    const std::array<double, 3> weights = weightsOf(corners, circle.centre);
    if (weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0 && -circle.radius < best->distance) {
      best->distance = -circle.radius;
      best->edge = circle.edge;
      best->weights = weights;
      return;
    }
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
