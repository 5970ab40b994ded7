#include "inscribed_circles.h"

#include <iterator>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStraight = 1e-12;          // sine of the turn at a corner that is none
constexpr double kAngleTolerance = 1e-6;     // rad, directions less apart than this count as one
constexpr std::size_t kMostCompared = 64;    // edges that are compared pair by pair
constexpr double kSmallestCell = 1e-14;      // of the region's size
constexpr double kRelativeRounding = 1e-15;  // of distances, as a part of the region's size

//! The boundary's edges, those in one line joined.
std::vector<Segment2> straightEdges(const PlanarBoundary& boundary) {
  std::vector<Segment2> edges;
  for (std::size_t r = 0; r + 1 < boundary.begins().size(); ++r) {
    std::vector<Point2> corners;
    for (int i = boundary.begins()[r]; i < boundary.begins()[r + 1]; ++i) {
      const Point2 before = boundary.edge(boundary.previous(i)).direction, after = boundary.edge(i).direction;
      if (std::fabs(cross(before, after)) > kStraight || dot(before, after) < 0.0) {
        corners.push_back(boundary.edge(i).start);
      }
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      edges.emplace_back(corners[i], corners[(i + 1) % corners.size()]);
    }
  }
  return edges;
}

//! Quarters squares again and again, keeping those that may have a point deeper than all around it.
//!
//! Around such a point the directions away from the nearest edges do not fit in one half of the circle.
class Quartering {
 public:
  explicit Quartering(const PlanarRegion& region) : region_(region), edges_(straightEdges(region.boundary())) {}

  std::vector<InscribedCircle> run() {
    const Box2& extent = region_.boundary().extent();
    const double half = 0.5 * std::max(extent.upper.u - extent.lower.u, extent.upper.v - extent.lower.v);
    smallest_ = kSmallestCell * half;
    rounding_ = kRelativeRounding * half;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      near_.push_back(static_cast<int>(i));
    }
    visit({0.0, 0.0}, half, 0);
    std::sort(circles_.begin(), circles_.end(),
              [](const InscribedCircle& a, const InscribedCircle& b) { return a.radius > b.radius; });
    return circles_;
  }

 private:
  //! An edge seen from the middle of a square.
  struct Site {
    int edge;
    double distance;  // m
    Point2 away;      // unit vector from the edge
    double spread;    // rad, by which that may turn within the square; more than pi: any
  };

  //! @param parents where the edges that can be nearest in the square around this one begin in near_
  void visit(const Point2& middle, double half, std::size_t parents) {
    const double reach = std::sqrt(2.0) * half;
    const std::size_t first = near_.size();
    lookFrom(middle, reach, parents);
    chooseNear(reach);
    if (sites_.size() >= 3 && !fitInHalfACircle()) {
      const SignedPoint here = region_.signedPoint(middle);
      if (half <= smallest_) {
        if (here.distance < 0.0) {
          circles_.push_back({middle, -here.distance, here.edge});
        }
      } else if (here.distance <= reach) {
        std::transform(sites_.begin(), sites_.end(), std::back_inserter(near_), [](const Site& s) { return s.edge; });
        for (const Point2& side : {Point2{-0.5, -0.5}, Point2{-0.5, 0.5}, Point2{0.5, -0.5}, Point2{0.5, 0.5}}) {
          visit(middle + half * side, 0.5 * half, first);
        }
      }
    }
    near_.resize(first);
  }

  void lookFrom(const Point2& middle, double reach, std::size_t parents) {
    sites_.clear();
    for (std::size_t i = parents; i < near_.size(); ++i) {
      const Segment2& edge = edges_[near_[i]];
      const double along = edge.along(middle);
      const Point2 arm = middle - edge.foot(along);
      const double distance = norm(arm);
      if (distance <= 2.0 * reach) {
        sites_.push_back({near_[i], distance, {0.0, 0.0}, 2.0 * kPi});
      } else {
        const bool opposite = std::fabs(along) + reach < 0.5 * edge.length;
        sites_.push_back(
            {near_[i], distance, (1.0 / distance) * arm, opposite ? 0.0 : 1.6 * reach / (distance - reach)});
      }
    }
  }

  //! Keeps the edges that can be the nearest somewhere in the square: no other one is so much nearer from its middle
  //! that it is nearer everywhere.
  void chooseNear(double reach) {
    const auto nearer = [](const Site& a, const Site& b) { return a.distance < b.distance; };
    const double least = std::min_element(sites_.begin(), sites_.end(), nearer)->distance;
    const auto is_far = [&](const Site& site) { return site.distance > least + 2.0 * reach + rounding_; };
    sites_.erase(std::remove_if(sites_.begin(), sites_.end(), is_far), sites_.end());
    if (sites_.size() <= kMostCompared) {
      compared_ = sites_;
      const auto is_farther = [&](const Site& site) {
        return std::any_of(compared_.begin(), compared_.end(), [&](const Site& other) {
          return site.distance - other.distance > reach * differenceOf(site, other) + rounding_;
        });
      };
      sites_.erase(std::remove_if(sites_.begin(), sites_.end(), is_farther), sites_.end());
    }
  }

  //! By how much the difference of two edges' distances changes at most per metre within the square.
  static double differenceOf(const Site& one, const Site& other) {
    return std::min(norm(one.away - other.away) + one.spread + other.spread, 2.0);
  }

  //! Whether the directions away from the edges lie in an open half of the circle or are two opposite ones.
  bool fitInHalfACircle() {
    arcs_.clear();
    for (const Site& site : sites_) {
      if (site.spread > kPi) {
        return false;
      }
      const double angle = std::atan2(site.away.v, site.away.u);
      arcs_.push_back({angle - site.spread, angle + site.spread});
    }
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
  double rounding_ = 0.0;  // m, of distances
  double smallest_ = 0.0;  // m, half a square's side
  std::vector<int> near_;  // edges of the present square, after those of the ones around it
  std::vector<Site> sites_, compared_;
  std::vector<std::array<double, 2>> arcs_;  // rad
  std::vector<InscribedCircle> circles_;
};

}  // namespace

std::vector<InscribedCircle> inscribedCircles(const PlanarRegion& region) { return Quartering(region).run(); }

}  // namespace distance
}  // namespace deformable_manipulation
