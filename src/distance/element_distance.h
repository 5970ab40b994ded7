#pragma once

#include "triangle_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! The nearest point so far of a segment or triangle.
struct ElementNearest {
  double squared;  //!< [m^2]; 0: they touch or cross
  Weights weights = {0.0, 0.0, 0.0};
};

//! Exact distance of a segment (K = 2) or triangle (K = 3) to a triangle.
template <int K>
class ElementDistance {
 public:
  ElementDistance(const Corners<K>& element, const Corners<3>& triangle) : a_(element), b_(triangle) {}

  //! Whether they are nearer than the nearest so far, which then is replaced.
  bool improve(ElementNearest* nearest) {
    const Vector3 normal = (b_[1] - b_[0]).cross(b_[2] - b_[0]);
    const double squared_normal = normal.squaredNorm();
    for (int i = 0; i < K; ++i) {
      above_[i] = normal.dot(a_[i] - b_[0]);
    }
    if (apart(above_, squared_normal, nearest->squared)) {
      return false;
    }
    const double before = nearest->squared;
    Vector3 own_normal = Vector3::Zero();
    double squared_own = 0.0;
    if (K == 3) {
      own_normal = (a_[1] - a_[0]).cross(a_[K - 1] - a_[0]);
      squared_own = own_normal.squaredNorm();
      for (int j = 0; j < 3; ++j) {
        own_above_[j] = own_normal.dot(b_[j] - a_[0]);
      }
      if (squared_own > 0.0 && apart(own_above_, squared_own, nearest->squared)) {
        return false;
      }
    }
    if (pierces(a_, above_, b_, nearest)) {
      return true;
    }
    cornersOverFace(normal, squared_normal, nearest);
    if (K == 3 && squared_own > 0.0) {
      if (pierced(nearest)) {
        return true;
      }
      faceUnderCorners(own_normal, squared_own, nearest);
    }
    edges(nearest);
    return nearest->squared < before;
  }

 private:
  static constexpr int kEdges = K == 3 ? 3 : 1;

  //! Whether all points are on one side of a plane, at least as far as the bound.
  template <std::size_t N>
  static bool apart(const std::array<double, N>& above, double squared_normal, double bound) {
    const auto range = std::minmax_element(above.begin(), above.end());
    const double gap = std::max(*range.first, -*range.second);
    return gap > 0.0 && gap * gap >= bound * squared_normal;
  }

  //! Whether the line from p to q goes through a triangle's face. Neighbours judge a shared edge alike, so that no line
  //! slips between them.
  static bool goesThrough(const Vector3& p, const Vector3& q, const Corners<3>& face) {
    const Vector3 way = q - p;
    const Corners<3> arms = {face[0] - p, face[1] - p, face[2] - p};
    const double u = way.dot(arms[0].cross(arms[1])), v = way.dot(arms[1].cross(arms[2])),
                 w = way.dot(arms[2].cross(arms[0]));
    return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  }

  static Weights onEdge(int from, int to, double parameter) {
    Weights weights = {0.0, 0.0, 0.0};
    weights[from] = 1.0 - parameter;
    weights[to] += parameter;
    return weights;
  }

  static bool pierces(const Corners<K>& element, const std::array<double, K>& above, const Corners<3>& face,
                      ElementNearest* nearest) {
    for (int i = 0; i < kEdges; ++i) {
      const int j = (i + 1) % K;
      if (above[i] * above[j] < 0.0 && goesThrough(element[i], element[j], face)) {
        *nearest = {0.0, onEdge(i, j, above[i] / (above[i] - above[j]))};
        return true;
      }
    }
    return false;
  }

  //! Whether an edge of the obstacle's triangle goes through the element.
  bool pierced(ElementNearest* nearest) const {
    const Corners<3> face = {a_[0], a_[1], a_[K - 1]};
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if (own_above_[i] * own_above_[j] < 0.0 && goesThrough(b_[i], b_[j], face)) {
        const double t = own_above_[i] / (own_above_[i] - own_above_[j]);
        *nearest = {0.0, nearestOnTriangle(b_[i] + t * (b_[j] - b_[i]), face).weights};
        return true;
      }
    }
    return false;
  }

  void cornersOverFace(const Vector3& normal, double squared_normal, ElementNearest* nearest) const {
    for (int i = 0; i < K; ++i) {
      const double squared = above_[i] * above_[i] / squared_normal;
      if (squared < nearest->squared && isOver(a_[i], b_, normal)) {
        nearest->squared = squared;
        nearest->weights = onEdge(i, i, 0.0);
      }
    }
  }

  void faceUnderCorners(const Vector3& normal, double squared_normal, ElementNearest* nearest) const {
    const Corners<3> face = {a_[0], a_[1], a_[K - 1]};
    for (int j = 0; j < 3; ++j) {
      const double squared = own_above_[j] * own_above_[j] / squared_normal;
      if (squared < nearest->squared && isOver(b_[j], face, normal)) {
        nearest->squared = squared;
        nearest->weights = nearestOnTriangle(b_[j], face).weights;
      }
    }
  }

  static bool isOver(const Vector3& point, const Corners<3>& face, const Vector3& normal) {
    for (int k = 0; k < 3; ++k) {
      if (normal.dot((face[(k + 1) % 3] - face[k]).cross(point - face[k])) < 0.0) {
        return false;
      }
    }
    return true;
  }

  void edges(ElementNearest* nearest) const {
    for (int i = 0; i < kEdges; ++i) {
      const int j = (i + 1) % K;
      const Vector3 edge = a_[j] - a_[i];
      for (int k = 0; k < 3; ++k) {
        const NearestOfSegments found = nearestOfSegments(a_[i], edge, b_[k], b_[(k + 1) % 3] - b_[k]);
        if (found.squared < nearest->squared) {
          *nearest = {found.squared, onEdge(i, j, found.s)};
        }
      }
    }
  }

  const Corners<K>& a_;
  const Corners<3>& b_;
  std::array<double, K> above_;      // of the element's corners, times the normal's length
  std::array<double, 3> own_above_;  // of the triangle's corners over a triangular element
};

}  // namespace distance
}  // namespace deformable_manipulation
