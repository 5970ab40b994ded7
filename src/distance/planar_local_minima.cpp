#include "planar_local_minima.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kDescent = 1e-13;  // m, over a probe: slopes below 1e-8 count as level

}  // namespace

void PlanarLocalMinima::find(const PlanarCopy& line, double limit, std::vector<MaterialPoint>* found) {
  measureLine(line);
  collect(limit);
  if (places_.empty()) {
    return;
  }
  thinOut();
  probe();
  const auto by_distance = [](const Place& a, const Place& b) { return a.distance < b.distance; };
  const std::size_t least = std::min_element(places_.begin(), places_.end(), by_distance) - places_.begin();
  for (std::size_t first = 0, last; first < places_.size(); first = last + 1) {
    for (last = first; places_[last].joined; ++last) {
    }
    if (isLowest(first, last) || (first <= least && least <= last)) {
      const double position = 0.5 * (places_[first].position + places_[last].position);
      const int segment = segmentAt(position);
      const double parameter = parameterAt(position, segment);
      found->push_back(onSegment(segment, {places_[first].distance, parameter, 0}));
    }
  }
}

void PlanarLocalMinima::measureLine(const PlanarCopy& line) {
  line_ = line;
  reached_.assign(1, 0.0);
  for (int i = 0; i + 1 < line.count; ++i) {
    reached_.push_back(reached_.back() + norm(line.points[i + 1] - line.points[i]));
  }
}

//! Places such that between two neighbouring ones there is no local minimum below the limit.
void PlanarLocalMinima::collect(double limit) {
  places_.clear();
  polyline_.visitNear(line_, limit + kBoundSlack, [&](int segment) { collectOnSegment(segment, limit); });
}

void PlanarLocalMinima::collectOnSegment(int i, double limit) {
  const Segment2 segment(line_.points[i], line_.points[i + 1]);
  parameters_.assign({0.0, 1.0});
  if (limit >= 0.0) {  // opposite to corners
    const double squared = region_.tree().limitFor(limit * limit, segment.middle);
    region_.tree().visitNear(SegmentBound(segment), squared, [&](const EdgeGroup& group) {
      for (int edge : group.index) {
        parameters_.push_back(segment.parameter(segment.along(region_.boundary().edge(edge).start)));
      }
    });
  }
  for (const InsidePart& part : region_.partsInside(segment)) {
    extrema_.find(segment, part, -limit - kBoundSlack, &parameters_);
  }
  for (double parameter : parameters_) {
    const double distance = region_.signedPoint(segment.at(parameter)).distance;
    if (distance <= limit) {
      places_.push_back({reached_[i] + parameter * segment.length, distance, 0.0, 0.0, false});
    }
  }
}

//! Of each cluster of places along the line only the nearest one.
void PlanarLocalMinima::thinOut() {
  std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
    return a.position < b.position || (a.position == b.position && a.distance < b.distance);
  });
  std::size_t kept = 0;
  double previous = -INFINITY;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place place = places_[i];
    if (place.position - previous > kProbe) {
      places_[kept++] = place;
    } else if (place.distance < places_[kept - 1].distance) {
      places_[kept - 1] = place;
    }
    previous = place.position;
  }
  places_.resize(kept);
}

void PlanarLocalMinima::probe() {
  for (Place& place : places_) {
    place.distance = distanceAt(place.position);
    place.before = distanceAt(place.position - kProbe);
    place.after = distanceAt(place.position + kProbe);
  }
  for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
    Place& one = places_[i];
    const Place& other = places_[i + 1];
    one.joined = std::fabs(one.distance - other.distance) <= kLevel &&
                 std::fabs(one.after - one.distance) <= kDescent &&
                 std::fabs(other.before - other.distance) <= kDescent &&
                 std::fabs(distanceAt(0.5 * (one.position + other.position)) - one.distance) <= kLevel;
  }
}

//! Whether the distance grows at both ends of a level stretch of places.
bool PlanarLocalMinima::isLowest(std::size_t first, std::size_t last) const {
  const Place &left = places_[first], &right = places_[last];
  if (left.before < left.distance - kDescent || right.after < right.distance - kDescent) {
    return false;
  }
  // A terrace ends level, and the next place is nearer.
  const double on_left = places_[first > 0 ? first - 1 : first].distance;
  const double on_right = places_[std::min(last + 1, places_.size() - 1)].distance;
  const bool falls_left = on_left < left.distance - kLevel && std::fabs(left.before - left.distance) <= kDescent;
  const bool falls_right = on_right < right.distance - kLevel && std::fabs(right.after - right.distance) <= kDescent;
  return !falls_left && !falls_right;
}

int PlanarLocalMinima::segmentAt(double position) const {
  const auto beyond = std::upper_bound(reached_.begin(), reached_.end(), position);
  return std::min(std::max(static_cast<int>(beyond - reached_.begin()) - 1, 0), line_.count - 2);
}

double PlanarLocalMinima::parameterAt(double position, int segment) const {
  const double length = reached_[segment + 1] - reached_[segment];
  return length > 0.0 ? std::min(std::max((position - reached_[segment]) / length, 0.0), 1.0) : 0.0;
}

double PlanarLocalMinima::distanceAt(double position) const {
  const int segment = segmentAt(position);
  const Segment2 piece(line_.points[segment], line_.points[segment + 1]);
  return region_.signedPoint(piece.at(parameterAt(position, segment))).distance;
}

}  // namespace distance
}  // namespace deformable_manipulation
