#pragma once

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace distance {

//! A point of, or a vector in, the plane of a planar obstacle [m].
struct Point2 {
  double u = 0.0, v = 0.0;
};

inline Point2 operator+(const Point2& a, const Point2& b) { return {a.u + b.u, a.v + b.v}; }
inline Point2 operator-(const Point2& a, const Point2& b) { return {a.u - b.u, a.v - b.v}; }
inline Point2 operator*(double s, const Point2& a) { return {s * a.u, s * a.v}; }
inline double dot(const Point2& a, const Point2& b) { return a.u * b.u + a.v * b.v; }
inline double cross(const Point2& a, const Point2& b) { return a.u * b.v - a.v * b.u; }
inline double squaredNorm(const Point2& a) { return dot(a, a); }
inline double norm(const Point2& a) { return std::sqrt(squaredNorm(a)); }

//! Not less than the norm, at most 9 % more, without a square root.
inline double normBound(const Point2& a) {
  const double u = std::fabs(a.u), v = std::fabs(a.v);
  return std::max(u, v) + 0.41422 * std::min(u, v);
}

//! A straight piece in the plane; one of length zero is the point it consists of.
struct Segment2 {
  Segment2(const Point2& from, const Point2& to) : start(from), end(to), step(to - from), length(norm(step)) {
    direction = length > 0.0 ? (1.0 / length) * step : Point2{1.0, 0.0};
    middle = start + 0.5 * step;
  }

  Point2 at(double parameter) const { return start + parameter * step; }

  //! Distance [m] of a point along the piece from its middle.
  double along(const Point2& point) const { return dot(direction, point - middle); }

  //! Distance [m] of a point to the left of the line through the piece.
  double across(const Point2& point) const { return cross(direction, point - middle); }

  double squaredDistance(const Point2& point) const {
    const double beyond = std::max(std::fabs(along(point)) - 0.5 * length, 0.0);
    const double aside = across(point);
    return beyond * beyond + aside * aside;
  }

  double distance(const Point2& point) const { return std::sqrt(squaredDistance(point)); }

  //! The point of the piece nearest to what is `along` from its middle.
  Point2 foot(double along) const {
    return middle + std::min(std::max(along, -0.5 * length), 0.5 * length) * direction;
  }

  //! From 0 at the start to 1 at the end, of the same point.
  double parameter(double along) const {
    return length > 0.0 ? std::min(std::max(along / length + 0.5, 0.0), 1.0) : 0.0;
  }

  Point2 start, end, step;
  double length;
  Point2 direction, middle;
};

//! A rectangle along the axes.
struct Box2 {
  void add(const Point2& point) {
    lower = {std::min(lower.u, point.u), std::min(lower.v, point.v)};
    upper = {std::max(upper.u, point.u), std::max(upper.v, point.v)};
  }

  Point2 lower = {INFINITY, INFINITY};
  Point2 upper = {-INFINITY, -INFINITY};
};

}  // namespace distance
}  // namespace deformable_manipulation
