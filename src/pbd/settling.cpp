// How a body comes to rest.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "deformable_manipulation/pbd/body.h"
#include "deformable_manipulation/pbd/errors.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// With less, an object swings for minutes; with more, it creeps, and is slow long before it is at rest.
constexpr double kLeastDamping = 1.0;  // 1/s
constexpr double kMostDamping = 20.0;  // 1/s

// As parts of the object's extent.
constexpr double kPush = 2e-3;
constexpr double kLeft = 1e-2;  // farther than where it was pushed to, it has left its shape

constexpr double kUnderWay = 1.0;  // s after a push, in which a departure has become faster than the tolerance
constexpr int kPushes = 5;

//! A smooth field without symmetries, of a length up to about 1, over positions counted in the object's extent.
Vector3 pushAt(const Vector3& place) {
  constexpr double kTwoPi = 6.283185307179586;
  static const std::array<Vector3, 3> waves = {Vector3(0.41, 0.73, 0.37), Vector3(0.97, -0.53, 0.61),
                                               Vector3(-0.29, 0.67, 1.13)};
  static const std::array<double, 3> phases = {0.9, 2.3, 4.4};
  Vector3 push;
  for (int axis = 0; axis < 3; ++axis) {
    push[axis] = 0.6 * std::sin(kTwoPi * waves[axis].dot(place) + phases[axis]);
  }
  return push;
}

void requireOptions(const SettleOptions& options) {
  ParameterCheck check;
  check.positive("time_step", options.time_step, "[s]");
  check.require(options.substeps >= 1, "substeps", options.substeps, "a whole number >= 1");
  check.notNegative("speed_tolerance", options.speed_tolerance, "[m/s]");
  check.notNegative("time_limit", options.time_limit, "[s]");
  check.throwIfAny();
}

}  // namespace

//! Calls settling() with the holds at rest and a damping that is neither too low nor too high. Viscosity would let the
//! object creep.
template <typename Settling>
auto Body::quicklyDamped(const SettleOptions& options, Settling settling) {
  requireOptions(options);
  for (HeldPoint& held : holds_) {
    held.twist = Twist();
  }
  const std::vector<MaterialParameter> own = dampings();
  std::vector<MaterialParameter> quick = own;
  for (MaterialParameter& parameter : quick) {
    parameter.value = 0.0;
  }
  quick.front().value = std::min(std::max(own.front().value, kLeastDamping), kMostDamping);
  const auto same = [](const MaterialParameter& a, const MaterialParameter& b) { return a.value == b.value; };
  if (std::equal(own.begin(), own.end(), quick.begin(), same)) {
    return settling();
  }
  setMaterial(quick);
  const auto result = settling();
  setMaterial(own);
  return result;
}

bool Body::settle(const SettleOptions& options) {
  return quicklyDamped(options, [&] { return settleAsDamped(options); });
}

Rest Body::settleStably(const SettleOptions& options) {
  return quicklyDamped(options, [&] { return pushOffBalance(options); });
}

bool Body::settleAsDamped(const SettleOptions& options) {
  const int steps = static_cast<int>(std::ceil(options.time_limit / options.time_step));
  for (int i = 0; i < steps; ++i) {
    step(options.time_step, options.substeps);
    const bool arrived =
        std::all_of(copies_.begin(), copies_.end(), [](const PerturbedCopy& copy) { return copy.ready(); });
    if (arrived && highestSpeed() < options.speed_tolerance) {
      stop();
      return true;
    }
  }
  stop();
  return false;
}

Rest Body::pushOffBalance(const SettleOptions& options) {
  for (int i = 0; i < kPushes; ++i) {
    if (!settleAsDamped(options)) {
      return Rest::MOVING;
    }
    if (!leavesItsShape(options)) {
      return Rest::STABLE;
    }
    push(options);
  }
  return Rest::BALANCED;
}

//! Whether a push of a copy of the object ends in another shape.
bool Body::leavesItsShape(const SettleOptions& options) const {
  const std::unique_ptr<Body> pushed = clone();
  while (!pushed->copies_.empty()) {
    pushed->removeCopy(pushed->copies_.back().id);
  }
  pushed->push(options);
  pushed->settleAsDamped(options);
  std::vector<double> before(3 * static_cast<std::size_t>(particleCount())), after(before.size());
  positions(0, before.data());
  pushed->positions(0, after.data());
  double farthest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    farthest = std::max(farthest, std::abs(after[i] - before[i]));
  }
  return farthest > kLeft * extent();
}

//! [m] Of the object itself: the longest side of the box around its particles.
double Body::extent() const {
  std::vector<double> numbers(3 * static_cast<std::size_t>(particleCount()));
  positions(0, numbers.data());
  const Eigen::Map<const Eigen::Matrix3Xd> places(numbers.data(), 3, particleCount());
  return (places.rowwise().maxCoeff() - places.rowwise().minCoeff()).maxCoeff();
}

//! Moves the free particles a little, and lets the object and its copies go from there for a while.
void Body::push(const SettleOptions& options) {
  const double size = extent();
  std::vector<double> numbers(3 * static_cast<std::size_t>(particleCount()));
  positions(0, numbers.data());
  for (int i = 0; i < particleCount(); ++i) {
    if (!isHeld(i)) {
      displace(i, kPush * size * pushAt(Eigen::Map<const Vector3>(&numbers[3 * i]) / size));
    }
  }
  for (int copy = 1; copy < copyCount(); ++copy) {
    restartCopy(copy);
  }
  for (double time = 0.0; time < kUnderWay; time += options.time_step) {
    step(options.time_step, options.substeps);
  }
}

bool Body::isHeld(int particle) const {
  return std::any_of(holds_.begin(), holds_.end(),
                     [particle](const HeldPoint& held) { return held.particle == particle; });
}

}  // namespace pbd
}  // namespace deformable_manipulation
