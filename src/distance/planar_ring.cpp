#include "planar_ring.h"

#include <sstream>

#include "coordinate_limit.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kSmallestExtent = 1e-6;  // m
constexpr double kFlatness = 1e-12;       // twice the area of a triangle over its extent squared: below it is a line

bool isUsable(double coordinate) { return std::fabs(coordinate) <= kLargestCoordinate; }

std::string coordinateProblem(std::size_t index, const std::array<double, 2>& point) {
  std::ostringstream text;
  text << "point " << index << " is (" << point[0] << ", " << point[1] << "); coordinates must be finite and at most "
       << kLargestCoordinate << " m";
  return text.str();
}

std::vector<Point2> withoutRepeats(const std::vector<std::array<double, 2>>& points) {
  std::vector<Point2> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] != points[(i + 1) % points.size()]) {
      kept.push_back({points[i][0], points[i][1]});
    }
  }
  return kept;
}

bool isFlat(const std::vector<Point2>& corners) {
  const auto farther = [&](const Point2& a, const Point2& b) {
    return squaredNorm(a - corners[0]) < squaredNorm(b - corners[0]);
  };
  const Segment2 axis(corners[0], *std::max_element(corners.begin(), corners.end(), farther));
  return axis.length < kSmallestExtent || std::all_of(corners.begin(), corners.end(), [&](const Point2& corner) {
           return std::fabs(axis.across(corner)) <= kFlatness * axis.length;
         });
}

//! Counterclockwise around a region: positive.
double twiceTheArea(const std::vector<Point2>& corners) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    area += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return area;
}

}  // namespace

PlanarRing::PlanarRing(const std::vector<std::array<double, 2>>& points, std::vector<std::string>* problems) {
  const std::size_t problems_before = problems->size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!isUsable(points[i][0]) || !isUsable(points[i][1])) {
      problems->push_back(coordinateProblem(i, points[i]));
    }
  }
  if (problems->size() > problems_before) {
    return;
  }
  std::vector<Point2> corners = withoutRepeats(points);
  if (corners.size() < 3) {
    problems->push_back("a polygon needs 3 distinct points or more, not " + std::to_string(corners.size()));
    return;
  }
  if (isFlat(corners)) {
    problems->push_back("the polygon has no area: all its points lie on one line");
    return;
  }
  if (twiceTheArea(corners) < 0.0) {
    std::reverse(corners.begin(), corners.end());
  }
  Box2 around;
  for (const Point2& corner : corners) {
    around.add(corner);
  }
  origin_ = 0.5 * (around.lower + around.upper);
  for (Point2& corner : corners) {
    corner = corner - origin_;
    extent_.add(corner);
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    edges_.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
  }
}

bool PlanarRing::isInside(const Point2& point, int nearest_edge) const {
  const Segment2& edge = edges_[nearest_edge];
  const double along = edge.along(point);
  if (std::fabs(along) < 0.5 * edge.length) {
    return edge.across(point) > 0.0;
  }
  const int next = along < 0.0 ? nearest_edge : (nearest_edge + 1) % size();
  const int previous = (next + size() - 1) % size();
  const Point2 before = edges_[previous].direction, after = edges_[next].direction;
  if (dot(before, after) > 0.0) {  // a flat corner, whose sense of turning may be rounding
    return dot(point - edges_[next].start, outwardNormal(previous) + outwardNormal(next)) < 0.0;
  }
  return cross(before, after) < 0.0;  // nearest to a corner, a point lies on its reflex side
}

}  // namespace distance
}  // namespace deformable_manipulation
