#include "inscribed_circles.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStraight = 1e-12;       // sine of the turn at a corner that is none
constexpr double kAngleTolerance = 1e-9;  // rad
constexpr double kSmallestCell = 1e-14;   // of the region's size

//! The ring's edges, those in one line joined.
std::vector<Segment2> straightEdges(const PlanarRing& ring) {
  std::vector<Point2> corners;
  for (int i = 0; i < ring.size(); ++i) {
    const Point2 before = ring.edge((i + ring.size() - 1) % ring.size()).direction, after = ring.edge(i).direction;
    if (std::fabs(cross(before, after)) > kStraight || dot(before, after) < 0.0) {
      corners.push_back(ring.edge(i).start);
    }
  }
  std::vector<Segment2> edges;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    edges.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
  }
  return edges;
}

//! Quarters squares again and again, keeping those that may have a point deeper than all around it.
//!
//! Around such a point the directions away from the nearest edges do not fit in one half of the circle.
class Quartering {
 public:
  explicit Quartering(const PlanarRegion& region) : region_(region), edges_(straightEdges(region.ring())) {}

  std::vector<InscribedCircle> run() {
    const Box2& extent = region_.ring().extent();
    const double half = 0.5 * std::max(extent.upper.u - extent.lower.u, extent.upper.v - extent.lower.v);
    smallest_ = kSmallestCell * half;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      near_.push_back(static_cast<int>(i));
    }
    visit({0.0, 0.0}, half, 0);
    std::sort(circles_.begin(), circles_.end(),
              [](const InscribedCircle& a, const InscribedCircle& b) { return a.radius > b.radius; });
    return circles_;
  }

 private:
  //! @param parents where the edges that can be nearest in the square around this one begin in near_
  void visit(const Point2& middle, double half, std::size_t parents) {
    const double reach = std::sqrt(2.0) * half;
    const std::size_t first = near_.size();
    chooseNear(middle, reach, parents, first);
    if (near_.size() - first >= 3 && mayHoldCentre(middle, reach, first)) {
      const SignedPoint here = region_.signedPoint(middle);
      if (half <= smallest_) {
        if (here.distance < 0.0) {
          circles_.push_back({middle, -here.distance, here.edge});
        }
      } else if (here.distance <= reach) {
        for (const Point2& side : {Point2{-0.5, -0.5}, Point2{-0.5, 0.5}, Point2{0.5, -0.5}, Point2{0.5, 0.5}}) {
          visit(middle + half * side, 0.5 * half, first);
        }
      }
    }
    near_.resize(first);
  }

  //! Appends the edges that can be the nearest at a point within reach of the middle.
  void chooseNear(const Point2& middle, double reach, std::size_t parents, std::size_t end) {
    double least = INFINITY;
    for (std::size_t i = parents; i < end; ++i) {
      least = std::min(least, edges_[near_[i]].distance(middle));
    }
    for (std::size_t i = parents; i < end; ++i) {
      if (edges_[near_[i]].distance(middle) <= least + 2.0 * reach + smallest_) {
        near_.push_back(near_[i]);
      }
    }
  }

  bool mayHoldCentre(const Point2& middle, double reach, std::size_t first) {
    arcs_.clear();
    for (std::size_t i = first; i < near_.size(); ++i) {
      const Segment2& edge = edges_[near_[i]];
      const double along = edge.along(middle), distance = edge.distance(middle);
      if (distance <= 2.0 * reach) {
        return true;  // the direction away from the edge may be any
      }
      const bool same_direction = std::fabs(along) + reach < 0.5 * edge.length;
      const double spread = same_direction ? 0.0 : 1.6 * reach / (distance - reach);
      const Point2 away = middle - edge.foot(along);
      const double angle = std::atan2(away.v, away.u);
      arcs_.push_back({angle - spread, angle + spread});
    }
    return !fitInHalfACircle();
  }

  //! Whether arcs lie in an open half of the circle or are two opposite directions.
  bool fitInHalfACircle() {
    std::sort(arcs_.begin(), arcs_.end());
    double end = -INFINITY, largest = 0.0, second = 0.0;
    const auto count = [&](double gap) {
      second = std::max(second, std::min(gap, largest));
      largest = std::max(largest, gap);
    };
    for (const std::array<double, 2>& arc : arcs_) {
      if (end > -INFINITY) {
        count(arc[0] - end);
      }
      end = std::max(end, arc[1]);
    }
    count(arcs_.front()[0] + 2.0 * kPi - end);
    return largest > kPi + kAngleTolerance || second > kPi - kAngleTolerance;
  }

  const PlanarRegion& region_;
  const std::vector<Segment2> edges_;
  double smallest_ = 0.0;                    // m, half a square's side
  std::vector<int> near_;                    // edges of the present square, after those of the ones around it
  std::vector<std::array<double, 2>> arcs_;  // rad
  std::vector<InscribedCircle> circles_;
};

}  // namespace

std::vector<InscribedCircle> inscribedCircles(const PlanarRegion& region) { return Quartering(region).run(); }

}  // namespace distance
}  // namespace deformable_manipulation
