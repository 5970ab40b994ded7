#include "segment_extrema.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr int kMostEdges = 8;                // that are compared pair by pair on one piece
constexpr double kShortest = 1e-10;          // m, pieces that are not halved any more
constexpr double kEnvelopeTolerance = 1e-7;  // m, between an equidistant point's distance and the depth there

//! Distance [m] of two segments that do not cross.
double distanceBetween(const Segment2& one, const Segment2& other) {
  return std::min(
      {one.distance(other.start), one.distance(other.end), other.distance(one.start), other.distance(one.end)});
}

}  // namespace

void SegmentExtrema::find(const Segment2& segment, const InsidePart& part, double floor,
                          std::vector<double>* parameters) {
  pieces_.assign(1, part);
  while (!pieces_.empty()) {
    const InsidePart range = pieces_.back();
    pieces_.pop_back();
    parameters->push_back(range.first);
    parameters->push_back(range.last);
    const Segment2 piece(segment.at(range.first), segment.at(range.last));
    const double ceiling = highestDepth(piece) + kShortest;
    if (ceiling < floor) {
      continue;
    }
    near_.clear();
    tree_.visitNear(SegmentBound(piece), tree_.limitFor(ceiling * ceiling, piece.middle), [&](const EdgeGroup& group) {
      for (int index : group.index) {
        if (distanceBetween(piece, boundary_.edge(index)) <= ceiling) {
          near_.push_back(index);
        }
      }
    });
    std::sort(near_.begin(), near_.end());
    near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
    if (near_.size() <= kMostEdges || piece.length <= kShortest) {
      sites_.clear();
      for (std::size_t i = 0; i < near_.size() && i < kMostEdges; ++i) {
        addSites(piece, boundary_.edge(near_[i]));
      }
      addEquidistant(piece, ceiling, range.first, range.last - range.first, parameters);
    } else {
      const double middle = 0.5 * (range.first + range.last);
      pieces_.push_back({range.first, middle});
      pieces_.push_back({middle, range.last});
    }
  }
}

//! An upper bound [m]: an edge's distance is convex along the piece.
double SegmentExtrema::highestDepth(const Segment2& piece) const {
  const NearestEdge first = tree_.nearest(piece.start, 0), last = tree_.nearest(piece.end, first.edge);
  return std::sqrt(std::min(std::max(first.squared, boundary_.edge(first.edge).squaredDistance(piece.end)),
                            std::max(last.squared, boundary_.edge(last.edge).squaredDistance(piece.start))));
}

//! The squared distances to an edge's line and first corner along a piece.
void SegmentExtrema::addSites(const Segment2& piece, const Segment2& edge) {
  const double across = edge.across(piece.start), change = cross(edge.direction, piece.step);
  const Point2 arm = piece.start - edge.start;
  sites_.push_back({change * change, 2.0 * across * change, across * across});
  sites_.push_back({squaredNorm(piece.step), 2.0 * dot(arm, piece.step), squaredNorm(arm)});
}

void SegmentExtrema::addEquidistant(const Segment2& piece, double ceiling, double first, double scale,
                                    std::vector<double>* parameters) const {
  const auto add = [&](double fraction, const Parabola& site) {
    if (!(fraction > 0.0 && fraction < 1.0)) {
      return;
    }
    const double distance = std::sqrt(std::max(site.at(fraction), 0.0));
    if (distance <= ceiling) {
      const double depth = std::sqrt(tree_.nearest(piece.start + fraction * piece.step, near_[0]).squared);
      if (std::fabs(depth - distance) <= kEnvelopeTolerance) {
        parameters->push_back(first + fraction * scale);
      }
    }
  };
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    add(-0.5 * sites_[i].b / sites_[i].a, sites_[i]);
    for (std::size_t j = i + 1; j < sites_.size(); ++j) {
      const double a = sites_[i].a - sites_[j].a, b = sites_[i].b - sites_[j].b, c = sites_[i].c - sites_[j].c;
      const double root = std::sqrt(std::max(b * b - 4.0 * a * c, 0.0));
      const double stable = -0.5 * (b + std::copysign(root, b));
      add(stable / a, sites_[i]);
      add(c / stable, sites_[i]);
    }
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
