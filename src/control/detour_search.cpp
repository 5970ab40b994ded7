#include "deformable_manipulation/control/detour_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double kStep = 1.0 / 40.0;  // of the object's length, between two places
constexpr double kRange = 0.5;        // of the object's length, beyond the start and the goal
constexpr int kSteps = 8;             // in one direction: shapes that are found at once
constexpr int kGoalEvery = 4;         // looks of which one is towards the goal
constexpr int kMostLooks = 3000;      // before there is said to be no way
constexpr double kKnown = 0.5;        // steps around a place within which nothing new is looked for
constexpr int kShortenings = 40;      // tried
constexpr double kSame = 0.05;        // steps by which two shapes may differ that are the same
constexpr double kSpare = 0.005;  // [m] by which limits are kept on the way beyond what they ask: filters have margins

double lengthOf(const double* points, int count) {
  double length = 0.0;
  for (int p = 1; p < count; ++p) {
    length += (Eigen::Map<const Vector3>(points + 3 * p) - Eigen::Map<const Vector3>(points + 3 * p - 3)).norm();
  }
  return length;
}

//! [m] How far the point is apart that is farthest apart in two shapes.
double farthestApart(const std::vector<double>& one, const std::vector<double>& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < one.size(); i += 3) {
    most = std::max(most, (Eigen::Map<const Vector3>(&other[i]) - Eigen::Map<const Vector3>(&one[i])).norm());
  }
  return most;
}

}  // namespace

DetourSearch::DetourSearch(std::shared_ptr<pbd::RestShapes> shapes, std::shared_ptr<distance::MinimumDistance> distance)
    : shapes_(std::move(shapes)), distance_(std::move(distance)) {}

void DetourSearch::start(const ObservationView& observation, int agent, const Vector3& goal, Limits limits) {
  limits_ = std::move(limits);
  agent_ = agent;
  goal_ = goal;
  held_.clear();
  for (int each = 0; each < observation.agents; ++each) {
    held_.push_back(observation.position(each));
  }
  const double length = lengthOf(observation.coordinates, observation.points);
  step_ = kStep * length;
  range_ = kRange * length;
  random_.seed(1);
  looks_ = 0;
  way_.clear();
  if (observation.orientations != nullptr) {  // grips turn, and are to keep them now
    shapes_->setOrientations(orientationsOf(observation));
  }
  const double* points = observation.coordinates;
  correction_.clear();
  if (observation.correction != nullptr) {
    correction_.assign(observation.correction,
                       observation.correction + 3 * static_cast<std::ptrdiff_t>(observation.points));
  }
  places_.assign(1, {held_[agent],
                     -1,
                     observation.distances->minimum[0],
                     {points, points + static_cast<std::ptrdiff_t>(3) * observation.points}});
}

DetourSearch::Outcome DetourSearch::advance() {
  ++looks_;
  return way_.empty() ? explore() : shorten();
}

DetourSearch::Outcome DetourSearch::explore() {
  const Vector3 to = looks_ % kGoalEvery == 1 ? goal_ : draw();
  const int nearest = nearestTo(to);
  const bool known = to != goal_ && (places_[nearest].position - to).norm() < kKnown * step_;
  const int last = known ? nearest : go(nearest, to);
  if (places_[last].position == goal_) {
    way_ = placesTo(last);
    looks_ = 0;
  }
  return looks_ < kMostLooks ? Outcome::SEARCHING : Outcome::NO_WAY;
}

//! Tries to go straight from one place of the way to another.
DetourSearch::Outcome DetourSearch::shorten() {
  if (looks_ > kShortenings || way_.size() < 3) {
    return Outcome::FOUND;
  }
  const std::size_t first = random_() % (way_.size() - 2);
  const std::size_t farthest = std::min(way_.size() - 1, first + 4 * kSteps);
  const std::size_t second = first + 2 + random_() % (farthest - first - 1);
  const Place target = places_[way_[second]];
  int last = way_[first];
  for (int end = -1; last != end && places_[last].position != target.position;) {
    end = last;
    last = go(last, target.position);
  }
  const Place& reached = places_[last];
  const std::vector<int> shorter = placesTo(last);
  if (reached.position == target.position && shorter.size() < second + 1 &&
      farthestApart(reached.points, target.points) < kSame * step_) {
    std::vector<int> way = shorter;
    way.insert(way.end(), way_.begin() + static_cast<std::ptrdiff_t>(second) + 1, way_.end());
    for (std::size_t i = shorter.size(); i < way.size(); ++i) {
      places_[way[i]].from = way[i - 1];
    }
    way_ = std::move(way);
  }
  return Outcome::SEARCHING;
}

int DetourSearch::nearestTo(const Vector3& position) const {
  const auto nearer = [&](const Place& one, const Place& other) {
    return (one.position - position).squaredNorm() < (other.position - position).squaredNorm();
  };
  return static_cast<int>(std::min_element(places_.begin(), places_.end(), nearer) - places_.begin());
}

//! A random place around the start and the goal.
Vector3 DetourSearch::draw() {
  const Vector3& start = places_[0].position;
  Vector3 drawn;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::min(start[axis], goal_[axis]) - range_;
    const double high = std::max(start[axis], goal_[axis]) + range_;
    drawn[axis] = low + (high - low) * random_() / static_cast<double>(std::mt19937::max());
  }
  return drawn;
}

//! Adds places towards another position, as far as the limits and the number of steps allow.
//! @return the last one
int DetourSearch::go(int from, const Vector3& to) {
  const Vector3 way = to - places_[from].position;
  const double length = way.norm();
  const int steps = static_cast<int>(std::ceil(length / step_ - 1e-9));
  std::vector<Vector3> positions;
  for (int i = 1; i <= std::min(steps, kSteps); ++i) {
    positions.push_back(i == steps ? to : Vector3(places_[from].position + i * step_ / length * way));
  }
  if (positions.empty()) {
    return from;
  }
  findShapes(places_[from], positions);
  int last = from;
  for (Place& found : found_) {
    if (!isPossible(places_[last], found)) {
      break;
    }
    found.from = last;
    last = static_cast<int>(places_.size());
    places_.push_back(std::move(found));
  }
  return last;
}

//! The shapes with the held point elsewhere that continue the one at a place.
void DetourSearch::findShapes(const Place& from, const std::vector<Vector3>& positions) {
  std::vector<Vector3> held;
  for (const Vector3& position : positions) {
    held.insert(held.end(), held_.begin(), held_.end());
    held[held.size() - held_.size() + agent_] = position;
  }
  shapes_->forget();
  shapes_->setPresent(from.points.data(), correction_.empty() ? nullptr : correction_.data());
  shapes_->find(held);
  found_.clear();
  std::vector<double> all;
  for (std::size_t i = 0; i < positions.size() && shapes_->known(static_cast<int>(i)); ++i) {
    std::vector<double> points(from.points.size());
    shapes_->points(static_cast<int>(i), points.data());
    all.insert(all.end(), points.begin(), points.end());
    found_.push_back({positions[i], -1, 0.0, std::move(points)});
  }
  if (found_.empty()) {
    return;
  }
  distance::ObjectView object;
  object.points = all.data();
  object.copies = static_cast<int>(found_.size());
  object.point_count = shapes_->pointCount();
  const distance::Distances& distances = distance_->compute(object);
  for (std::size_t i = 0; i < found_.size(); ++i) {
    found_[i].distance = distances.minimum[i];
  }
}

bool DetourSearch::isPossible(const Place& before, const Place& after) const {
  if (farthestApart(before.points, after.points) >= before.distance + after.distance) {
    return false;  // it may have passed through something, or snapped to another shape
  }
  PresentState state{held_, after.distance};
  state.positions[agent_] = after.position;
  state.shape.agents = static_cast<int>(held_.size());
  state.shape.points = shapes_->pointCount();
  state.shape.coordinates = after.points.data();
  return limits_(state) >= (after.position == goal_ ? 0.0 : kSpare);
}

std::vector<int> DetourSearch::placesTo(int last) const {
  std::vector<int> places;
  for (int place = last; place >= 0; place = places_[place].from) {
    places.push_back(place);
  }
  std::reverse(places.begin(), places.end());
  return places;
}

std::vector<Vector3> DetourSearch::way() const {
  std::vector<Vector3> way;
  for (std::size_t i = 1; i < way_.size(); ++i) {
    way.push_back(places_[way_[i]].position);
  }
  return way;
}

}  // namespace control
}  // namespace deformable_manipulation
