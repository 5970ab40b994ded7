// Commands within limits of velocity, acceleration and jerk.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "deformable_manipulation/control/motion_limits.h"

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double CYCLE = 0.01;
constexpr double INFINITE = INFINITY;

TEST(MotionLimits, holdWhateverIsChosen) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (double jerk : {5.0, 50.0, 1000.0}) {
    const MotionLimits limits = {0.15, 1.0, jerk, CYCLE};
    double velocity = 0.0, acceleration = 0.0, wish = 0.0;
    for (int cycle = 0; cycle < 20000; ++cycle) {
      wish = cycle % 50 == 0 ? 0.4 * (share(random) - 0.5) : wish;
      const VelocityRange range = limits.next(velocity, acceleration);
      ASSERT_LE(range.lower, range.upper);
      const double chosen = std::clamp(wish, range.lower, range.upper);
      const double now = (chosen - velocity) / CYCLE;
      ASSERT_LE(std::fabs(chosen), 0.15 + 1e-9);
      ASSERT_LE(std::fabs(now), 1.0 + 1e-9);
      ASSERT_LE(std::fabs(now - acceleration) / CYCLE, jerk + 1e-6) << cycle;
      velocity = chosen;
      acceleration = now;
    }
  }
}

TEST(MotionLimits, endAtRestWithoutOvershoot) {
  for (double jerk : {5.0, 50.0, 1000.0, INFINITE}) {
    const MotionLimits limits = {0.15, 1.0, jerk, CYCLE};
    double velocity = 0.12, acceleration = 0.0;
    int cycles = 0;
    for (; velocity != 0.0 && cycles < 1000; ++cycles) {
      const double next = limits.slowed(velocity, acceleration);
      const double now = (next - velocity) / CYCLE;
      ASSERT_GE(next, -1e-9);
      ASSERT_LE(next, velocity + 1e-12);
      ASSERT_LE(std::fabs(now), 1.0 + 1e-9);
      if (std::isfinite(jerk)) {
        ASSERT_LE(std::fabs(now - acceleration) / CYCLE, jerk + 1e-6);
      }
      velocity = std::fabs(next) < 1e-12 ? 0.0 : next;
      acceleration = now;
    }
    // v / a where jerk does not matter, else 2 sqrt(v / j) and a little.
    EXPECT_LE(cycles * CYCLE, 0.12 + 0.03 + (std::isfinite(jerk) ? 2.5 * std::sqrt(0.12 / jerk) : 0.0)) << jerk;
  }
}

TEST(MotionLimits, withoutLimitsOfAccelerationStopAtOnce) {
  const MotionLimits limits = {0.15, INFINITE, INFINITE, CYCLE};
  EXPECT_EQ(limits.slowed(0.12, 0.0), 0.0);
  const VelocityRange range = limits.next(0.12, 0.0);
  EXPECT_EQ(range.lower, -0.15);
  EXPECT_EQ(range.upper, 0.15);
}

TEST(MotionLimits, leadBackToALimitThatWasLowered) {
  const MotionLimits limits = {0.05, 1.0, 1000.0, CYCLE};
  const VelocityRange range = limits.next(0.12, 0.0);
  EXPECT_NEAR(range.lower, 0.11, 1e-12);
  EXPECT_NEAR(range.upper, 0.11, 1e-12);
}

}  // namespace
}  // namespace control
}  // namespace deformable_manipulation
