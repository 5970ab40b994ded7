#include "point_search.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kOthersBelow = 5e-4;    // m, how far it pays to know that no other point is as high as the nearest one
constexpr double kLeastSpare = 2e-5;     // m, less of it does not last
constexpr int kRest = 16;                // calls, after which it is tried again
constexpr double kRounded = 1.0 - 1e-6;  // of squared distances along directions of single precision

//! A lower bound of how far [m] a corner of an element is along a unit vector.
template <int K>
float lowestAlong(const Eigen::Vector3f& direction, const Corners<K>& corners) {
  const Vector3 along = direction.cast<double>();
  double lowest = INFINITY;
  for (const Vector3& corner : corners) {
    lowest = std::min(lowest, along.dot(corner));
  }
  return static_cast<float>(lowest - 1e-6 * std::fabs(lowest));
}

//! Segments and triangles beside eight points at a time.
template <int K>
class PointDistance;

template <>
class PointDistance<2> {
 public:
  explicit PointDistance(const Corners<2>& segment) : start_(segment[0]), way_(segment[1] - segment[0]) {
    const double squared = way_.squaredNorm();
    inverse_ = squared > 0.0 ? 1.0 / squared : 0.0;
  }

  //! A point beside the segment: bit for bit what improve() finds of it.
  ElementNearest of(const Vector3& point) const {
    const double x = point.x() - start_.x(), y = point.y() - start_.y(), z = point.z() - start_.z();
    const double along = inverse_ * (way_.x() * x + way_.y() * y + way_.z() * z);
    const double t = std::min(std::max(along, 0.0), 1.0);
    const double dx = x - way_.x() * t, dy = y - way_.y() * t, dz = z - way_.z() * t;
    return {dx * dx + dy * dy + dz * dz, {1.0 - t, t, 0.0}};
  }

  //! Lower bounds [m] of the children's distances that their boxes do not tell.
  FourFloats gaps(const BoxNode& /*node*/) const { return FourFloats{}; }

  //! Whether one of the points is nearer than the nearest so far, which then is replaced; `slot` says which.
  bool improve(const PointBlock& points, const Vector3& /*direction*/, double /*lowest*/, ElementNearest* nearest,
               int* slot) const {
    bool improved = false;
    for (int half = 0; half < PointBlock::kSize / 4; ++half) {
      const Four x = points.four(0, half) - start_.x(), y = points.four(1, half) - start_.y(),
                 z = points.four(2, half) - start_.z();
      const Four along = inverse_ * (way_.x() * x + way_.y() * y + way_.z() * z);
      const Four t = smaller(larger(along, broadcast(0.0)), broadcast(1.0));
      const Four dx = x - way_.x() * t, dy = y - way_.y() * t, dz = z - way_.z() * t;
      const Four squared = dx * dx + dy * dy + dz * dz;
      for (int k = 0; least(squared) < nearest->squared && k < 4; ++k) {
        if (squared[k] < nearest->squared) {
          *nearest = {squared[k], {1.0 - t[k], t[k], 0.0}};
          *slot = 4 * half + k;
          improved = true;
        }
      }
    }
    return improved;
  }

 private:
  Vector3 start_, way_;
  double inverse_;  // 1/m^2
};

template <>
class PointDistance<3> {
 public:
  explicit PointDistance(const Corners<3>& triangle) : triangle_(triangle) {
    normal_ = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    const double squared = normal_.squaredNorm();
    normal_ *= squared > 0.0 ? 1.0 / std::sqrt(squared) : 0.0;
    rough_normal_ = normal_.cast<float>();
    lowest_ = lowestAlong<3>(rough_normal_, triangle);
    lowest_below_ = lowestAlong<3>(-rough_normal_, triangle);
  }

  //! To both sides of the triangle's plane.
  FourFloats gaps(const BoxNode& node) const {
    return larger(lowest_ - node.heightsAlong(rough_normal_), lowest_below_ - node.heightsAlong(-rough_normal_));
  }

  //! @param direction a unit vector along which no point of the triangle is below the height `lowest` [m], or zero
  bool improve(const PointBlock& points, const Vector3& direction, double lowest, ElementNearest* nearest,
               int* slot) const {
    bool improved = false;
    for (int half = 0; half < PointBlock::kSize / 4; ++half) {
      const Four x = points.four(0, half) - triangle_[0].x(), y = points.four(1, half) - triangle_[0].y(),
                 z = points.four(2, half) - triangle_[0].z();
      const Four height = normal_.x() * x + normal_.y() * y + normal_.z() * z;
      const Four gap = lowest - (direction.x() * points.four(0, half) + direction.y() * points.four(1, half) +
                                 direction.z() * points.four(2, half));
      const Four above = larger(height * height, whereAbove(gap, broadcast(0.0), kRounded * gap * gap, broadcast(0.0)));
      for (int k = 0; least(above) < nearest->squared && k < 4; ++k) {
        if (above[k] < nearest->squared) {
          const NearestOnTriangle there = nearestOnTriangle(points.point(4 * half + k), triangle_);
          if (there.squared < nearest->squared) {
            *nearest = {there.squared, there.weights};
            *slot = 4 * half + k;
            improved = true;
          }
        }
      }
    }
    return improved;
  }

 private:
  Corners<3> triangle_;
  Vector3 normal_;
  Eigen::Vector3f rough_normal_;
  float lowest_, lowest_below_;  // m, along the normal and against it
};

}  // namespace

PointPlace PointSearch::minimum(ObjectTree& object, const PointPlace& guess, MovingBounds* bounds) {
  startPairs(object, bounds);
  double upper = INFINITY;
  if (guess.known()) {
    Nearest pair;
    pair.element = guess.element;
    pair.piece = guess.piece;
    improve(&pair);
    upper = std::sqrt(pair.at.squared);
  }
  return placeOf(nearestPair(upper));
}

void PointSearch::elements(ObjectTree& object, double limit, MovingBounds* bounds, std::vector<PointPlace>* places) {
  startPairs(object, bounds);
  for (int element = 0; element < object.size(); ++element) {
    if (bounds->of(element) < limit + kSlack) {
      Nearest pair = lastPair(element);
      const double others = bounds->ofOthers(element, object.corners<3>(element));
      if (pair.piece < 0 || others <= std::sqrt(pair.at.squared)) {
        pair = nearestWithin(element, limit, pair);
        findOthers(element, pair);
      }
      const PointPlace found = placeOf(pair);
      if (found.distance <= limit) {
        places->push_back(found);
      }
    }
  }
}

//! Notes how far all other points are below the one that is nearest to an element, so that the next calls need not
//! search it again until it has moved so far that another one may be nearer. Where that is soon, it is not worth it.
void PointSearch::findOthers(int element, const Nearest& nearest) {
  bounds_->setOthers(element, MovingBounds::Plane());
  rests_.resize(object_->size(), 0);
  if (nearest.element < 0 || rests_[element] > 0) {
    rests_[element] = std::max(0, rests_[element] - 1);
    return;
  }
  const MovingBounds::Plane plane = planeOfOthers(nearest);
  bounds_->setOthers(element, plane);
  const double spare = bounds_->ofOthers(element, object_->corners<3>(element)) - std::sqrt(nearest.at.squared);
  rests_[element] = spare < kLeastSpare ? kRest : 0;
}

MovingBounds::Plane PointSearch::planeOfOthers(const Nearest& nearest) {
  const Box box = boxAround(object_->corners<3>(nearest.element));
  MovingBounds::Plane plane;
  plane.normal = towards(nearest);
  HeightRange range;
  range.enough = plane.normal.dot(tree_->point(nearest.piece));
  range.lowest = range.enough - kOthersBelow;
  plane.beyond = INFINITY;
  plane.height = tree_->heightAlong(plane.normal, range, box, INFINITY, nearest.piece);
  if (plane.height > range.enough) {
    plane.beyond = std::sqrt(nearest.at.squared) + bounds_->reserve();
    plane.height = tree_->heightAlong(plane.normal, range, box, plane.beyond * plane.beyond, nearest.piece);
  }
  plane.height += kSlack;
  return plane;
}

PointPlace PointSearch::placeOf(const Nearest& pair) {
  return pair.element < 0 ? PointPlace()
                          : PointPlace{std::sqrt(pair.at.squared), pair.piece, pair.element, pair.at.weights};
}

//! Compares the element and the point of a pair.
void PointSearch::improve(Nearest* pair) const {
  const Vector3 point = tree_->point(pair->piece);
  if (object_->surface()) {
    const NearestOnTriangle there = nearestOnTriangle(point, object_->corners<3>(pair->element));
    pair->at = {there.squared, there.weights};
    return;
  }
  pair->at = PointDistance<2>(object_->corners<2>(pair->element)).of(point);
}

//! The unit vector from the point towards the element, or zero if they touch.
Vector3 PointSearch::towards(const Nearest& pair) const {
  const Vector3 arm = weighted<3>(object_->corners<3>(pair.element), pair.at.weights) - tree_->point(pair.piece);
  return arm.normalized();
}

//! Returns a lower bound [m^2] of the element's squared distance.
template <int K>
double PointSearch::search(int element, const Nearest& known, Nearest* nearest) {
  const Corners<K> corners = object_->corners<K>(element);
  const Box box = boxAround(corners);
  const PointDistance<K> distance(corners);
  Eigen::Vector3f direction = known.direction.cast<float>();
  float lowest = lowestAlong<K>(direction, corners);
  double beyond = INFINITY;  // m^2, least bound of what has been left out
  stack_.push(0.0F, tree_->root());
  while (!stack_.empty()) {
    const auto entry = stack_.pop();
    if (entry.bound >= nearest->at.squared) {
      beyond = std::min(beyond, double(entry.bound));
      continue;
    }
    if (entry.what < 0) {
      int slot = 0;
      if (distance.improve(tree_->block(~entry.what), direction.cast<double>(), lowest, &nearest->at, &slot)) {
        nearest->element = element;
        nearest->piece = PointBlock::kSize * ~entry.what + slot;
        direction = towards(*nearest).cast<float>();
        lowest = lowestAlong<K>(direction, corners);
      }
      beyond = std::min(beyond, nearest->at.squared);
      continue;
    }
    const BoxNode& node = tree_->nodes()[entry.what];
    FourFloats bounds = node.squaredDistances(box);
    const FourFloats order = bounds;
    FourFloats gaps = distance.gaps(node);
    if (direction.squaredNorm() > 0.0F) {
      gaps = larger(gaps, lowest - node.heightsAlong(direction));
    }
    bounds = gaps > 0.0F ? larger(bounds, gaps * gaps * float(kRounded)) : bounds;
    const NearChildren near(order, bounds, nearest->at.squared);
    for (int i = 0; i < near.count(); ++i) {
      stack_.push(bounds[near.slot(i)], node.children[near.slot(i)]);
    }
    beyond = std::min(beyond, double(near.leastLeftOut()));
  }
  return nearest->element < 0 ? beyond : nearest->at.squared;
}

}  // namespace distance
}  // namespace deformable_manipulation
