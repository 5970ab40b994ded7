#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "deformable_manipulation/distance/features.h"

namespace deformable_manipulation {
namespace distance {

using Weights = std::array<double, 3>;

//! The corners of a triangle; a segment has two of them.
template <int K>
using Corners = std::array<Vector3, K>;

template <int K>
Vector3 weighted(const Corners<K>& corners, const Weights& weights) {
  Vector3 sum = weights[0] * corners[0] + weights[1] * corners[1];
  if (K == 3) {
    sum += weights[2] * corners[K - 1];
  }
  return sum;
}

//! The nearest point of a triangle to another point. Weights are exactly 0 if it is on an edge or a corner.
struct NearestOnTriangle {
  double squared;  //!< [m^2]
  Weights weights;
};

//! By the Voronoi regions of the triangle's corners, edges and face (Ericson, Real-Time Collision Detection, 5.1.5).
inline NearestOnTriangle nearestOnTriangle(const Vector3& p, const Corners<3>& t) {
  const Vector3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const auto at = [&](double u, double v, double w) {
    const Weights weights = {u, v, w};
    return NearestOnTriangle{(ap - v * ab - w * ac).squaredNorm(), weights};
  };
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return {ap.squaredNorm(), {1.0, 0.0, 0.0}};
  }
  if (d3 >= 0.0 && d4 <= d3) {
    return {bp.squaredNorm(), {0.0, 1.0, 0.0}};
  }
  if (d6 >= 0.0 && d5 <= d6) {
    return {cp.squaredNorm(), {0.0, 0.0, 1.0}};
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double v = d1 / (d1 - d3);
    return at(1.0 - v, v, 0.0);
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double w = d2 / (d2 - d6);
    return at(1.0 - w, 0.0, w);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return at(0.0, 1.0 - w, w);
  }
  const double sum = va + vb + vc;
  return at(va / sum, vb / sum, vc / sum);
}

//! The nearest point of a segment or triangle to another point.
template <int K>
Vector3 nearestOnElement(const Vector3& point, const Corners<K>& element) {
  if (K == 3) {
    const Corners<3> triangle = {element[0], element[1], element[K - 1]};
    return weighted<3>(triangle, nearestOnTriangle(point, triangle).weights);
  }
  const Vector3 along = element[1] - element[0];
  const double squared = along.squaredNorm();
  const double parameter = squared > 0.0 ? (point - element[0]).dot(along) / squared : 0.0;
  return element[0] + std::min(std::max(parameter, 0.0), 1.0) * along;
}

}  // namespace distance
}  // namespace deformable_manipulation
