#include "deformable_manipulation/pbd/shape_correction.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deformable_manipulation {
namespace pbd {
namespace {

constexpr int kModesOfSpan = 16;
constexpr int kModesOfEnd = 8;
constexpr double kShortEnd = 0.1;     // of the length: a shorter free end goes with its grip
constexpr double kMemory = 1.0;       // s, how late measurements may come
constexpr double kEarly = 0.05;       // s, how far ahead of the newest state they may be
constexpr int kMostPoints = 200;      // of a measurement, beyond which neighbours tell the same
constexpr double kGate = 4.0;         // standard deviations within which a point counts as one of the object
constexpr double kDisagreeing = 0.5;  // s, for how long before it is said

}  // namespace

CorrectionParameters CorrectionParameters::read(const ParameterSection& correction) {
  return {correction.number("noise"),     correction.number("expected"), correction.number("fading_time"),
          correction.number("smoothing"), correction.number("limit"),    correction.flag("stop")};
}

ShapeCorrection::ShapeCorrection(const CorrectionParameters& parameters, std::vector<double> arc_lengths,
                                 std::vector<double> held)
    : parameters_(parameters), arc_lengths_(std::move(arc_lengths)) {
  setHolds(std::move(held));
}

void ShapeCorrection::setHolds(std::vector<double> held) {
  held_ = std::move(held);
  std::sort(held_.begin(), held_.end());
  makeModes();
  reset();
}

void ShapeCorrection::reset() {
  amplitudes_ = Points::Zero(modes_.cols(), 3);
  covariance_ = prior_.asDiagonal();
  field_.assign(3 * arc_lengths_.size(), 0.0);
  past_.clear();
  measured_ = -std::numeric_limits<double>::infinity();
  disagreeing_since_ = std::numeric_limits<double>::infinity();
}

void ShapeCorrection::makeModes() {
  modes_.resize(static_cast<Eigen::Index>(arc_lengths_.size()), 0);
  prior_.resize(0);
  const double length = arc_lengths_.back() - arc_lengths_.front();
  if (held_.empty()) {
    return;
  }
  if (held_.front() - arc_lengths_.front() > kShortEnd * length) {
    addModes(held_.front(), arc_lengths_.front(), kModesOfEnd, true);
  }
  for (std::size_t i = 0; i + 1 < held_.size(); ++i) {
    addModes(held_[i], held_[i + 1], kModesOfSpan, false);
  }
  if (arc_lengths_.back() - held_.back() > kShortEnd * length) {
    addModes(held_.back(), arc_lengths_.back(), kModesOfEnd, true);
  }
}

//! Sines that vanish at the beginning and, unless it is free, at the end. Their variances fall with the square of the
//! wave number, as those of a line whose direction is wrong by independent amounts from place to place (a Brownian
//! bridge): smooth enough for few points to tell of the rest, and steep enough at a grip that turns the line wrongly.
void ShapeCorrection::addModes(double begin, double end, int modes, bool free) {
  const Eigen::Index first = modes_.cols();
  modes_.conservativeResize(Eigen::NoChange, first + modes);
  prior_.conservativeResize(first + modes);
  double sum = 0.0;
  for (int m = 0; m < modes; ++m) {
    const double waves = free ? m + 0.5 : m + 1.0;  // half waves
    for (std::size_t p = 0; p < arc_lengths_.size(); ++p) {
      const double along = (arc_lengths_[p] - begin) / (end - begin);
      modes_(static_cast<Eigen::Index>(p), first + m) =
          along > 0.0 && along <= 1.0 ? std::sin(M_PI * waves * along) : 0.0;
    }
    const double in_the_middle = std::sin(M_PI * waves * (free ? 1.0 : 0.5));
    prior_[first + m] = 1.0 / (waves * waves);
    sum += prior_[first + m] * in_the_middle * in_the_middle;
  }
  prior_.tail(modes) *= parameters_.expected * parameters_.expected / sum;
}

void ShapeCorrection::advance(double time, const double* points) {
  const double step = past_.empty() ? 0.0 : time - time_;
  time_ = time;
  const double kept = std::exp(-step / parameters_.fading_time);
  amplitudes_ *= kept;
  covariance_ *= kept * kept;
  covariance_.diagonal() += (1.0 - kept * kept) * prior_;
  const Points target = modes_ * amplitudes_;
  const double follow = parameters_.smoothing > 0.0 ? 1.0 - std::exp(-step / parameters_.smoothing) : 1.0;
  Eigen::Map<Points> field(field_.data(), target.rows(), 3);
  field += follow * (target - field);
  past_.emplace_back(time, Eigen::Map<const Points>(points, target.rows(), 3));
  while (past_.front().first < time - kMemory) {
    past_.pop_front();
  }
}

std::string ShapeCorrection::measure(double time, const std::vector<MeasuredPoint>& points) {
  if (!std::isfinite(time)) {
    return "its time is not finite";
  }
  if (past_.empty() || time < past_.front().first) {
    return "it is older than all states that are remembered (" + std::to_string(kMemory) + " s)";
  }
  if (time > time_ + kEarly) {
    return "its time is " + std::to_string(time - time_) + " s ahead of the model's";
  }
  if (time <= measured_) {
    return "it is not newer than the one before";
  }
  std::vector<MeasuredPoint> seen;
  std::copy_if(points.begin(), points.end(), std::back_inserter(seen),
               [](const MeasuredPoint& point) { return point.position.allFinite(); });
  if (seen.empty()) {
    return "it has no point with finite coordinates";
  }
  measured_ = time;
  const Points shape = shapeAt(std::min(time, time_));
  const std::size_t stride = (seen.size() + kMostPoints - 1) / kMostPoints;
  int used = 0;
  int all = 0;
  for (std::size_t i = 0; i < seen.size(); i += stride, ++all) {
    used += fuse(shape, seen[i]) ? 1 : 0;
  }
  judge(2 * used >= all && largest() <= parameters_.limit);
  return "";
}

//! One coordinate after the other: the noise of points is independent. @return whether the point is of the object
bool ShapeCorrection::fuse(const Points& shape, const MeasuredPoint& point) {
  const Points estimate = shape + modes_ * amplitudes_;
  const bool known =
      std::isfinite(point.place) && point.place >= arc_lengths_.front() && point.place <= arc_lengths_.back();
  const Place place = known ? placeOf(point.place) : nearest(estimate, point.position);
  const auto at = [&place](const auto& rows) {
    return ((1.0 - place.share) * rows.row(place.before) + place.share * rows.row(place.before + 1)).eval();
  };
  const Eigen::RowVectorXd mode = at(modes_);
  const Eigen::RowVector3d missing = point.position.transpose() - at(estimate);
  const Eigen::VectorXd spread = covariance_ * mode.transpose();
  const double variance = mode.dot(spread) + parameters_.noise * parameters_.noise;
  if (missing.squaredNorm() > kGate * kGate * variance) {
    return false;
  }
  amplitudes_ += spread / variance * missing;
  covariance_ -= spread * spread.transpose() / variance;
  return true;
}

void ShapeCorrection::judge(bool agrees) {
  if (agrees) {
    disagreeing_since_ = std::numeric_limits<double>::infinity();
  } else {
    disagreeing_since_ = std::min(disagreeing_since_, measured_);
  }
}

bool ShapeCorrection::disagrees() const { return measured_ - disagreeing_since_ >= kDisagreeing; }

double ShapeCorrection::largest() const {
  const Points target = modes_ * amplitudes_;
  return std::sqrt(target.rowwise().squaredNorm().maxCoeff());
}

ShapeCorrection::Points ShapeCorrection::shapeAt(double time) const {
  const auto after = std::lower_bound(past_.begin(), past_.end(), time,
                                      [](const auto& state, double wanted) { return state.first < wanted; });
  if (after == past_.begin()) {
    return after->second;
  }
  const auto before = std::prev(after);
  const double share = (time - before->first) / (after->first - before->first);
  return (1.0 - share) * before->second + share * after->second;
}

ShapeCorrection::Place ShapeCorrection::placeOf(double arc_length) const {
  const auto after = std::upper_bound(arc_lengths_.begin() + 1, arc_lengths_.end() - 1, arc_length);
  const int before = static_cast<int>(after - arc_lengths_.begin()) - 1;
  return {before, (arc_length - arc_lengths_[before]) / (*after - arc_lengths_[before])};
}

ShapeCorrection::Place ShapeCorrection::nearest(const Points& shape, const Vector3& position) const {
  Place best{0, 0.0};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i + 1 < shape.rows(); ++i) {
    const Vector3 from = shape.row(i);
    const Vector3 along = shape.row(i + 1).transpose() - from;
    const double share = std::clamp((position - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (from + share * along - position).squaredNorm();
    if (distance < least) {
      least = distance;
      best = {i, share};
    }
  }
  return best;
}

}  // namespace pbd
}  // namespace deformable_manipulation
