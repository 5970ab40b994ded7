#include "deformable_manipulation/control/turning_law.h"

#include <algorithm>
#include <sstream>

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double kLeap = 10.0;           // rad/s, faster than any grip turns
constexpr double kLeastInterval = 1e-4;  // s, between observations that tell a velocity

}  // namespace

TurningLaw::TurningLaw(const ControllerParameters& parameters) {
  setParameters(parameters);
  reset();
}

void TurningLaw::setParameters(const ControllerParameters& p) {
  mode_ = p.orientation;
  gain_ = p.turning_gain;
  leader_ = p.team.leader;
  starts_ = p.orientations;
}

void TurningLaw::reset() {
  time_.reset();
  orientations_ = predicted_ = starts_;
  velocities_.assign(starts_.size(), Vector3::Zero());
  moving_ = errors_ = velocities_;
}

std::string TurningLaw::fault(const ObservationView& observation) const {
  if (!turns()) {
    return "";
  }
  if (observation.orientations == nullptr) {
    return "the state does not tell the orientations of the grips, which are to turn";
  }
  const std::vector<Quaternion> now = orientationsOf(observation);
  for (int agent = 0; time_ && observation.time > *time_ && agent < observation.agents; ++agent) {
    const double angle = rotationVector(now[agent] * orientations_[agent].conjugate()).norm();
    if (angle > kLeap * std::max(observation.time - *time_, kLeastInterval)) {
      std::ostringstream text;
      text << "the orientation of agent " << agent << " leaps by " << angle << " rad within "
           << observation.time - *time_ << " s";
      return text.str();
    }
  }
  return "";
}

void TurningLaw::observe(const ObservationView& observation) {
  if (!turns()) {
    return;
  }
  const double interval = time_ ? observation.time - *time_ : 0.0;
  const std::vector<Quaternion> now = orientationsOf(observation);
  for (int agent = 0; agent < observation.agents; ++agent) {
    if (observation.angular_velocities != nullptr) {
      velocities_[agent] = Eigen::Map<const Vector3>(observation.angular_velocities + 3 * agent);
    } else if (interval >= kLeastInterval) {
      velocities_[agent] = rotationVector(now[agent] * orientations_[agent].conjugate()) / interval;
    }
  }
  orientations_ = now;
  time_ = observation.time;
}

void TurningLaw::predict(const std::vector<Vector3>& angular_velocities, double delay) {
  moving_ = angular_velocities;
  for (std::size_t agent = 0; agent < orientations_.size(); ++agent) {
    predicted_[agent] = rotationBy(delay * moving_[agent]) * orientations_[agent];
  }
}

Quaternion TurningLaw::leaderTurn(const Quaternion& leader) const { return leader * starts_[leader_].conjugate(); }

Vector3 TurningLaw::turned(const Vector3& place, bool predicted) const {
  if (mode_ != OrientationMode::FOLLOW) {
    return place;
  }
  return leaderTurn(predicted ? predicted_[leader_] : orientations_[leader_]) * place;
}

Vector3 TurningLaw::unturned(const Vector3& place) const {
  return mode_ == OrientationMode::FOLLOW ? Vector3(leaderTurn(orientations_[leader_]).conjugate() * place) : place;
}

Vector3 TurningLaw::velocityOf(const Vector3& place) const {
  return mode_ == OrientationMode::FOLLOW ? Vector3(moving_[leader_].cross(place)) : Vector3(Vector3::Zero());
}

Quaternion TurningLaw::wanted(int agent) const {
  return mode_ == OrientationMode::FOLLOW ? leaderTurn(predicted_[leader_]) * starts_[agent] : starts_[agent];
}

Turn TurningLaw::turn(int agent) {
  Turn turn;
  errors_[agent] = rotationVectorNear(wanted(agent) * predicted_[agent].conjugate(), errors_[agent]);
  turn.error = errors_[agent];
  turn.nominal = gain_ * turn.error;
  if (mode_ == OrientationMode::FOLLOW) {
    turn.nominal += moving_[leader_];
  }
  return turn;
}

}  // namespace control
}  // namespace deformable_manipulation
