#include "deformable_manipulation/pbd/body.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "deformable_manipulation/pbd/errors.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// A copy displaced at once could jump to another equilibrium; it moves there at this speed instead.
constexpr double kDisplacementSpeed = 0.5;  // m/s
constexpr double kRestUntilReady = 0.3;     // s

// A copy pulled taut no longer tells how the slack object answers. Displacements end at this
// fraction of the free length, and return to the request only below the smaller one.
constexpr double kReach = 0.995;
constexpr double kReachToReturn = 0.985;

void requirePose(const Pose& pose) {
  if (!pose.position.allFinite() || !pose.orientation.coeffs().allFinite() ||
      std::abs(pose.orientation.norm() - 1.0) > 1e-6) {
    throw std::invalid_argument("a held pose must be finite with a quaternion of norm 1");
  }
}

void requireStep(double time_step, int substeps) {
  if (std::isfinite(time_step) && time_step > 0.0 && substeps >= 1) {
    return;  // before the texts are made: nothing is allocated inside a step
  }
  ParameterCheck check;
  check.positive("time_step", time_step, "[s]");
  check.require(substeps >= 1, "substeps", substeps, "a whole number >= 1");
  check.throwIfAny();
}

}  // namespace

bool PerturbedCopy::ready() const { return resting >= kRestUntilReady; }

void Body::requireParticle(int particle) const {
  if (particle < 0 || particle >= particleCount()) {
    throw std::out_of_range("particle " + std::to_string(particle) + ": there are particles 0 to " +
                            std::to_string(particleCount() - 1));
  }
}

void Body::hold(int particle, Hold type) {
  requireParticle(particle);
  hold(particle, type, pose(particle));
}

void Body::hold(int particle, Hold type, const Pose& pose) { hold(particle, {}, type, pose); }

void Body::hold(int particle, const std::vector<FurtherParticle>& further, Hold type, const Pose& pose) {
  requireFree(particle);
  requirePose(pose);
  std::vector<HeldPoint> holds = holds_;
  holds.push_back({particle, type, pose, Twist()});
  for (const FurtherParticle& each : further) {
    requireFree(each.particle);
    requirePose(each.place);
    holds.push_back({each.particle, type, pose, Twist(), particle, each.place});
  }
  std::sort(holds.begin(), holds.end(), [](const HeldPoint& a, const HeldPoint& b) { return a.particle < b.particle; });
  const auto same = [](const HeldPoint& a, const HeldPoint& b) { return a.particle == b.particle; };
  const auto twice = std::adjacent_find(holds.begin(), holds.end(), same);
  if (twice != holds.end()) {
    throw std::invalid_argument("particle " + std::to_string(twice->particle) + " is given twice");
  }
  holds_ = std::move(holds);
  placeFollowers();
  holdsChanged();
}

void Body::requireFree(int particle) const {
  requireParticle(particle);
  if (isHeld(particle)) {
    throw std::invalid_argument("particle " + std::to_string(particle) + " is already held");
  }
}

void Body::release(int particle) {
  leading(particle);
  for (std::size_t i = copies_.size(); i-- > 0;) {
    if (copies_[i].particle == particle) {
      removeCopy(copies_[i].id);
    }
  }
  const auto released = [particle](const HeldPoint& held) { return held.grip == particle; };
  holds_.erase(std::remove_if(holds_.begin(), holds_.end(), released), holds_.end());
  holdsChanged();
}

void Body::setTwist(int particle, const Twist& twist) {
  if (!twist.linear.allFinite() || !twist.angular.allFinite()) {
    throw std::invalid_argument("the velocity of particle " + std::to_string(particle) + " must be finite");
  }
  findHeld(particle).twist = twist;
}

void Body::setPose(int particle, const Pose& pose) {
  requirePose(pose);
  findHeld(particle).pose = pose;
  placeFollowers();
}

void Body::moveTo(int particle, const Pose& pose, double duration) {
  requirePose(pose);
  if (!(duration > 0.0) || !std::isfinite(duration)) {
    throw std::invalid_argument("a duration must be finite and > 0 [s], not " + std::to_string(duration));
  }
  const Pose& from = held(particle).pose;
  Quaternion turn = pose.orientation * from.orientation.conjugate();
  turn.coeffs() *= turn.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::AngleAxisd rotation(turn.normalized());
  setTwist(particle, {(pose.position - from.position) / duration, rotation.angle() / duration * rotation.axis()});
}

HeldPoint& Body::findHeld(int particle) { return const_cast<HeldPoint&>(leading(particle)); }

const HeldPoint& Body::leading(int particle) const {
  const HeldPoint& found = held(particle);
  if (!found.leads()) {
    throw std::invalid_argument("particle " + std::to_string(particle) + " is held together with particle " +
                                std::to_string(found.grip) + ", which stands for both");
  }
  return found;
}

int Body::gripCount() const {
  return static_cast<int>(std::count_if(holds_.begin(), holds_.end(), std::mem_fn(&HeldPoint::leads)));
}

const HeldPoint& Body::held(int particle) const {
  for (const HeldPoint& held : holds_) {
    if (held.particle == particle) {
      return held;
    }
  }
  throw std::invalid_argument("particle " + std::to_string(particle) + " is not held");
}

Wrench Body::gripWrench(int particle, int copy) const {
  const Vector3 about = heldPosition(leading(particle), copy);
  Wrench sum = wrench(particle, copy);
  for (const HeldPoint& held : holds_) {
    if (held.grip == particle && !held.leads()) {
      const Wrench own = wrench(held.particle, copy);
      sum.force += own.force;
      sum.torque += own.torque + (heldPosition(held, copy) - about).cross(own.force);
    }
  }
  return sum;
}

std::string Body::softness(double, int) const { return ""; }

std::unique_ptr<RestShapes> Body::restShapes(const std::vector<HeldPoint>& /*agents*/) const { return nullptr; }

ResponseStatus Body::response(double*) { return ResponseStatus::NOT_AVAILABLE; }

bool Body::turningResponse(double*) const { return false; }

bool Body::wrenchResponse(double*) const { return false; }

int Body::addCopy(int particle, const Vector3& displacement) {
  leading(particle);
  const double length = displacement.norm();
  double longest = 0.0;
  for (int other = 0; other < particleCount(); ++other) {
    longest = std::max(longest, freeLength(particle, other));
  }
  if (!std::isfinite(length) || length == 0.0 || length > longest) {
    throw std::invalid_argument("the displacement of a copy must be finite, not zero and at most " +
                                std::to_string(longest) + " m long, not " + std::to_string(length) + " m");
  }
  PerturbedCopy copy{next_id_++, particle, displacement, displacement, Vector3::Zero()};
  copies_.push_back(copy);
  resizeCopies();
  assignCopy(copyCount() - 1, 0);
  return copy.id;
}

void Body::removeCopy(int id) {
  const auto found =
      std::find_if(copies_.begin(), copies_.end(), [id](const PerturbedCopy& copy) { return copy.id == id; });
  if (found == copies_.end()) {
    throw std::invalid_argument("there is no copy with id " + std::to_string(id));
  }
  for (int to = static_cast<int>(found - copies_.begin()) + 1; to + 1 < copyCount(); ++to) {
    assignCopy(to, to + 1);
  }
  copies_.erase(found);
  resizeCopies();
}

void Body::setState(const double* points, const double* velocities) {
  const auto finite = [](double value) { return std::isfinite(value); };
  const int numbers = 3 * pointCount();
  if (!std::all_of(points, points + numbers, finite) || !std::all_of(velocities, velocities + numbers, finite)) {
    throw std::invalid_argument("the points and velocities of a state must be finite");
  }
  placeState(points, velocities);
  for (int copy = 1; copy < copyCount(); ++copy) {
    restartCopy(copy);
  }
}

void Body::step(double time_step, int substeps) {
  requireStep(time_step, substeps);
  const double h = time_step / substeps;
  retargetCopies();
  moveFollowers();
  beginStep(h);
  for (int i = 0; i < substeps; ++i) {
    advanceHolds(h);
    advanceCopies(h);
    substep();
  }
  endStep();
  ++steps_;
  checkFinite();
}

Vector3 Body::heldPosition(const HeldPoint& held, int copy) const {
  if (copy > 0 && copies_[copy - 1].particle == held.grip) {
    return held.pose.position + copies_[copy - 1].present;
  }
  return held.pose.position;
}

void Body::advanceHolds(double h) {
  for (HeldPoint& held : holds_) {
    if (held.leads()) {
      held.pose = moved(held.pose, held.twist, h);
    }
  }
  placeFollowers();
}

//! Puts all particles of the grips where these are.
void Body::placeFollowers() {
  for (HeldPoint& follower : holds_) {
    if (!follower.leads()) {
      const Pose& grip = held(follower.grip).pose;
      follower.pose.position = grip.position + grip.orientation * follower.place.position;
      follower.pose.orientation = (grip.orientation * follower.place.orientation).normalized();
    }
  }
}

//! Gives them the velocities that they have with their grips at present.
void Body::moveFollowers() {
  for (HeldPoint& follower : holds_) {
    if (!follower.leads()) {
      const HeldPoint& grip = held(follower.grip);
      const Vector3 arm = follower.pose.position - grip.pose.position;
      follower.twist = {grip.twist.linear + grip.twist.angular.cross(arm), grip.twist.angular};
    }
  }
}

//! Whether each particle of the displaced grip is within the object's reach from each one of the others.
bool Body::inReach(const PerturbedCopy& copy, const Vector3& displacement, double margin) const {
  const auto reaches = [&](const HeldPoint& displaced, const HeldPoint& other) {
    return (displaced.pose.position + displacement - other.pose.position).norm() <=
           margin * freeLength(displaced.particle, other.particle);
  };
  return std::all_of(holds_.begin(), holds_.end(), [&](const HeldPoint& displaced) {
    return displaced.grip != copy.particle || std::all_of(holds_.begin(), holds_.end(), [&](const HeldPoint& other) {
             return other.grip == copy.particle || reaches(displaced, other);
           });
  });
}

void Body::retargetCopies() {
  for (std::size_t i = 0; i < copies_.size(); ++i) {
    PerturbedCopy& copy = copies_[i];
    if (copy.target != copy.requested && inReach(copy, copy.requested, kReachToReturn)) {
      copy.target = copy.requested;
    } else if (!inReach(copy, copy.target, kReach)) {
      for (double factor : {1.0, -1.0, 0.5, -0.5, 0.25, -0.25}) {
        if (inReach(copy, factor * copy.requested, kReach)) {
          copy.target = factor * copy.requested;
          break;
        }
      }
    }
    if (copy.present.dot(copy.target) < 0.0) {  // turned round
      restartCopy(static_cast<int>(i) + 1);
    }
  }
}

//! Begins again from the object itself.
void Body::restartCopy(int copy) {
  copies_[copy - 1].present.setZero();
  copies_[copy - 1].resting = 0.0;
  assignCopy(copy, 0);
}

void Body::advanceCopies(double h) {
  for (PerturbedCopy& copy : copies_) {
    const Vector3 remaining = copy.target - copy.present;
    const double distance = remaining.norm();
    if (distance == 0.0) {
      copy.resting += h;
      continue;
    }
    copy.resting = 0.0;
    copy.present = distance > h * kDisplacementSpeed
                       ? Vector3(copy.present + (h * kDisplacementSpeed / distance) * remaining)
                       : copy.target;
  }
}

void Body::checkFinite() const {
  for (int copy = 0; copy < copyCount(); ++copy) {
    const int particle = firstNonFinite(copy);
    if (particle >= 0) {
      throw NonFiniteState(steps_, copy, particle);
    }
  }
}

}  // namespace pbd
}  // namespace deformable_manipulation
