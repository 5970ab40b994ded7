#pragma once

#include "four.h"
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

  //! Whether they are nearer than the nearest so far, which then is replaced. What is found does not depend on that.
  bool improve(ElementNearest* nearest) {
    ElementNearest found{INFINITY};
    if (!measure(nearest->squared, &found) || found.squared >= nearest->squared) {
      return false;
    }
    *nearest = found;
    return true;
  }

 private:
  //! Returns false if they are seen to be at least so far apart.
  bool measure(double squared_bound, ElementNearest* found) {
    const Vector3 normal = (b_[1] - b_[0]).cross(b_[2] - b_[0]);
    const double squared_normal = normal.squaredNorm();
    for (int i = 0; i < K; ++i) {
      above_[i] = normal.dot(a_[i] - b_[0]);
    }
    const double gap = gapOf(above_);
    if (gap > 0.0 && gap * gap >= squared_bound * squared_normal) {
      return false;
    }
    Vector3 own_normal = Vector3::Zero();
    double squared_own = 0.0, own_gap = 0.0;
    if (K == 3) {
      own_normal = (a_[1] - a_[0]).cross(a_[K - 1] - a_[0]);
      squared_own = own_normal.squaredNorm();
      for (int j = 0; j < 3; ++j) {
        own_above_[j] = own_normal.dot(b_[j] - a_[0]);
      }
      own_gap = gapOf(own_above_);
      if (squared_own > 0.0 && own_gap > 0.0 && own_gap * own_gap >= squared_bound * squared_own) {
        return false;
      }
    }
    if (pierces(a_, above_, b_, found)) {
      return true;
    }
    cornersOverFace(normal, squared_normal, found);
    if (gap > 0.0 && found->squared <= gap * gap / squared_normal) {  // as near as the planes let it be
      return true;
    }
    if (K == 3 && squared_own > 0.0) {
      if (pierced(found)) {
        return true;
      }
      faceUnderCorners(own_normal, squared_own, found);
      if (own_gap > 0.0 && found->squared <= own_gap * own_gap / squared_own) {
        return true;
      }
    }
    edges(found);
    return true;
  }

  static constexpr int kEdges = K == 3 ? 3 : 1;

  //! How far all points are on one side of a plane, in lengths of its normal; negative if they are on both.
  template <std::size_t N>
  static double gapOf(const std::array<double, N>& above) {
    const auto range = std::minmax_element(above.begin(), above.end());
    return std::max(*range.first, -*range.second);
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

  //! Each edge of the element with the triangle's three at a time.
  void edges(ElementNearest* nearest) const {
    std::array<Four, 3> start, way;
    for (int k = 0; k < 3; ++k) {
      const Vector3 edge = b_[(k + 1) % 3] - b_[k];
      for (int axis = 0; axis < 3; ++axis) {
        start[axis].set(k, b_[k][axis]);
        way[axis].set(k, edge[axis]);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {  // the fourth is the first again
      start[axis].set(3, b_[0][axis]);
      way[axis].set(3, way[axis][0]);
    }
    const Four squared_way = dot(way, way);
    for (int i = 0; i < kEdges; ++i) {
      const int j = (i + 1) % K;
      const Vector3 edge = a_[j] - a_[i];
      Four s;
      const Four squared = toEdges(a_[i], edge, start, way, squared_way, &s);
      for (int k = 0; k < 3; ++k) {
        if (squared[k] < nearest->squared) {
          *nearest = {squared[k], onEdge(i, j, s[k])};
        }
      }
    }
  }

  static Four dot(const std::array<Four, 3>& a, const std::array<Four, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static Four dot(const Vector3& a, const std::array<Four, 3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Four clamped(const Four& value) { return smaller(larger(value, broadcast(0.0)), broadcast(1.0)); }

  //! Squared distances [m^2] of the segment from p to p + d to those from q to q + e, which have a length.
  //! @param s parameter in [0, 1] of the nearest points (Ericson, Real-Time Collision Detection, 5.1.9)
  static Four toEdges(const Vector3& p, const Vector3& d, const std::array<Four, 3>& q, const std::array<Four, 3>& e,
                      const Four& ee, Four* s) {
    const std::array<Four, 3> r = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    const double a = d.squaredNorm();
    const Four inverse_a = broadcast(a > 0.0 ? 1.0 / a : 0.0);
    const Four f = dot(e, r), c = dot(d, r), b = dot(d, e);
    const Four product = a * ee, determinant = product - b * b, least = 1e-14 * product;
    const Four along = whereAbove(determinant, least, b * f - c * ee, broadcast(0.0));
    *s = clamped(along / whereAbove(determinant, least, determinant, broadcast(1.0)));
    const Four free = (b * *s + f) / ee, t = clamped(free);
    const Four again = clamped((b * t - c) * inverse_a);
    *s = whereAbove(absolute(free - t), broadcast(0.0), again, *s);
    const std::array<Four, 3> gap = {r[0] + d[0] * *s - t * e[0], r[1] + d[1] * *s - t * e[1],
                                     r[2] + d[2] * *s - t * e[2]};
    return dot(gap, gap);
  }

  const Corners<K>& a_;
  const Corners<3>& b_;
  std::array<double, K> above_;      // of the element's corners, times the normal's length
  std::array<double, 3> own_above_;  // of the triangle's corners over a triangular element
};

}  // namespace distance
}  // namespace deformable_manipulation
