#include "planar_boundary.h"

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

std::vector<Point2> withoutRepeats(const Corners2& points) {
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

//! The corners of a ring as they count; empty if there is a problem with them.
std::vector<Point2> checkedCorners(const Corners2& points, const std::string& name,
                                   std::vector<std::string>* problems) {
  const std::size_t problems_before = problems->size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!isUsable(points[i][0]) || !isUsable(points[i][1])) {
      problems->push_back(name + coordinateProblem(i, points[i]));
    }
  }
  if (problems->size() > problems_before) {
    return {};
  }
  std::vector<Point2> corners = withoutRepeats(points);
  if (corners.size() < 3) {
    problems->push_back(name + "a polygon needs 3 distinct points or more, not " + std::to_string(corners.size()));
    return {};
  }
  if (isFlat(corners)) {
    problems->push_back(name + "the polygon has no area: all its points lie on one line");
    return {};
  }
  return corners;
}

//! Whether a ring is around a point, by how often it crosses the ray from there to the right.
bool isAround(const std::vector<Point2>& ring, const Point2& point) {
  bool around = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.v > point.v) != (b.v > point.v)) {
      const double left = cross(b - a, point - a);
      around ^= (b.v > a.v) == (left > 0.0);
    }
  }
  return around;
}

//! Turns each ring so that the region is to its left.
void orient(std::vector<std::vector<Point2>>* rings) {
  std::vector<bool> is_hole;
  for (const std::vector<Point2>& ring : *rings) {
    const auto is_around = [&](const std::vector<Point2>& other) {
      return &other != &ring && isAround(other, ring[0]);
    };
    is_hole.push_back(std::count_if(rings->begin(), rings->end(), is_around) % 2 == 1);
  }
  for (std::size_t r = 0; r < rings->size(); ++r) {
    if ((twiceTheArea((*rings)[r]) < 0.0) != is_hole[r]) {
      std::reverse((*rings)[r].begin(), (*rings)[r].end());
    }
  }
}

}  // namespace

PlanarBoundary::PlanarBoundary(const std::vector<Corners2>& rings, std::vector<std::string>* problems) {
  const std::size_t problems_before = problems->size();
  std::vector<std::vector<Point2>> corners;
  Box2 around;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::string name = rings.size() > 1 ? "ring " + std::to_string(r) + ": " : "";
    corners.push_back(checkedCorners(rings[r], name, problems));
    std::for_each(corners.back().begin(), corners.back().end(), [&](const Point2& corner) { around.add(corner); });
  }
  if (rings.empty()) {
    problems->push_back("a polygon needs a ring of points");
  }
  if (problems->size() > problems_before) {
    return;
  }
  orient(&corners);
  origin_ = 0.5 * (around.lower + around.upper);
  for (const std::vector<Point2>& ring : corners) {
    addRing(ring);
  }
}

void PlanarBoundary::addRing(const std::vector<Point2>& corners) {
  const int begin = size(), count = static_cast<int>(corners.size());
  for (int i = 0; i < count; ++i) {
    edges_.emplace_back(corners[i] - origin_, corners[(i + 1) % count] - origin_);
    extent_.add(edges_.back().start);
    previous_.push_back(begin + (i + count - 1) % count);
    next_.push_back(begin + (i + 1) % count);
  }
  begins_.push_back(size());
}

bool PlanarBoundary::isInside(const Point2& point, int nearest_edge) const {
  const Segment2& edge = edges_[nearest_edge];
  const double along = edge.along(point);
  if (std::fabs(along) < 0.5 * edge.length) {
    return edge.across(point) > 0.0;
  }
  const int next = along < 0.0 ? nearest_edge : next_[nearest_edge];
  const int previous = previous_[next];
  const Point2 before = edges_[previous].direction, after = edges_[next].direction;
  if (dot(before, after) > 0.0) {  // a flat corner, whose sense of turning may be rounding
    return dot(point - edges_[next].start, outwardNormal(previous) + outwardNormal(next)) < 0.0;
  }
  return cross(before, after) < 0.0;  // nearest to a corner, a point lies on its reflex side
}

}  // namespace distance
}  // namespace deformable_manipulation
