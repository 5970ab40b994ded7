// What the leader is expected to do, with and without announcements, right and wrong.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "deformable_manipulation/control/leader_forecast.h"

namespace deformable_manipulation {
namespace control {
namespace {

constexpr double CYCLE = 0.01;  // [s]
constexpr double STEP = 0.1;    // [s] between announced positions
constexpr int POSITIONS = 34;
constexpr int NODES = 8;
constexpr double LENGTH = 3.0;  // [s]
constexpr double FADE = 3.0;    // [s]
constexpr double MEMORY = 5.0;  // [s]

using Way = std::function<Vector3(double)>;

//! Up to 0.3 m/s, and never twice the same.
Vector3 path(double time) {
  return {0.2 * std::sin(1.1 * time), 0.25 * std::sin(0.7 * time + 1.0), 0.15 * std::sin(1.7 * time)};
}

Vector3 velocityOf(const Way& way, double time) { return (way(time) - way(time - CYCLE)) / CYCLE; }

HorizonParameters parameters(ExpectedLeader leader) {
  return {LENGTH, NODES, leader, FADE, 0.2, MEMORY, 0.2, Vector3(1.0, 1.0, 0.1)};
}

struct Announcement {
  std::vector<double> times;
  std::vector<double> positions;

  AnnouncementView view() const { return {static_cast<int>(times.size()), times.data(), positions.data()}; }
};

//! What is announced at a time for the times ahead.
Announcement announce(double now, const Way& way) {
  Announcement announcement;
  for (int k = 0; k < POSITIONS; ++k) {
    const double time = now + k * STEP;
    const Vector3 position = way(time);
    announcement.times.push_back(time);
    announcement.positions.insert(announcement.positions.end(), position.data(), position.data() + 3);
  }
  return announcement;
}

//! A leader on a path, and what is expected of it.
class Watched {
 public:
  explicit Watched(ExpectedLeader leader) : forecast(parameters(leader)) {}

  void look(double time, const Announcement& announcement) {
    const Vector3 position = path(time);
    ObservationView observation;
    observation.time = time;
    observation.agents = 1;
    observation.positions = position.data();
    observation.announcement = announcement.view();
    PredictedState predicted;
    predicted.delay = CYCLE;
    predicted.velocities.assign(1, velocityOf(path, time));
    predicted.positions.assign(1, position + CYCLE * predicted.velocities[0]);
    forecast.look(observation, predicted);
  }

  //! Goes on with announcements of a way that is made at each time.
  void go(double seconds, const std::function<Way(double)>& announced) {
    for (const double end = now + seconds; now < end; now += CYCLE) {
      look(now, announce(now - CYCLE, announced(now - CYCLE)));
    }
  }

  //! [m] How far the expectation of the newest state is from what the leader will do, root mean square of all nodes.
  double error() const {
    double sum = 0.0;
    for (int node = 0; node < NODES; ++node) {
      sum += (forecast.positions()[node + 1] - path(now + (node + 1) * LENGTH / NODES)).squaredNorm();
    }
    return std::sqrt(sum / NODES);
  }

  LeaderForecast forecast;
  double now = 0.0;
};

Way honest(double /*now*/) { return path; }

Way opposite(double now) {
  return [now](double time) { return Vector3(2.0 * path(now) - path(time)); };
}

Way late(double /*now*/) {
  return [](double time) { return path(time - 1.0); };
}

Way scaled(double now) {
  return [now](double time) { return Vector3(path(now) + 2.0 * (path(time) - path(now))); };
}

Way wild(double now) {
  std::mt19937 generator(static_cast<unsigned>(now));  // another one every second
  std::uniform_real_distribution<double> component(-0.3, 0.3);
  const Vector3 velocity(component(generator), component(generator), component(generator));
  return [now, velocity](double time) { return Vector3(path(now) + (time - now) * velocity); };
}

void expectFading(const LeaderForecast& forecast, double time) {
  const Vector3 velocity = velocityOf(path, time);
  const Vector3 start = path(time) + CYCLE * velocity;
  for (int node = 0; node < NODES; ++node) {
    const double ahead = (node + 1) * LENGTH / NODES;
    const Vector3 expected = start + FADE * (1.0 - std::exp(-ahead / FADE)) * velocity;
    EXPECT_LT((forecast.positions()[node + 1] - expected).norm(), 1e-12) << "node " << node;
  }
}

TEST(LeaderForecast, WithoutAnnouncementsTheVelocityFades) {
  for (const ExpectedLeader leader : {ExpectedLeader::FADING, ExpectedLeader::ANNOUNCED, ExpectedLeader::KNOWN}) {
    Watched watched(leader);
    watched.look(2.0, {});
    expectFading(watched.forecast, 2.0);
    EXPECT_NEAR(watched.forecast.doubt(NODES - 1), 0.2 * velocityOf(path, 2.0).norm(), 1e-12);
    EXPECT_NEAR(watched.forecast.fastest(), velocityOf(path, 2.0).norm(), 1e-12);
  }
}

TEST(LeaderForecast, AFastLeaderIsForgottenSlowly) {
  LeaderForecast forecast(parameters(ExpectedLeader::FADING));
  const Vector3 position = Vector3::Zero();
  ObservationView observation;
  observation.agents = 1;
  observation.positions = position.data();
  PredictedState predicted;
  predicted.positions.assign(1, position);
  const auto lookAt = [&](double time, double speed) {
    observation.time = time;
    predicted.velocities.assign(1, Vector3(0.0, speed, 0.0));
    forecast.look(observation, predicted);
  };
  lookAt(0.0, 0.3);
  lookAt(1.0, 0.1);
  lookAt(5.0, 0.0);
  EXPECT_NEAR(forecast.doubt(0), 0.2 * 0.3 * std::exp(-5.0 / MEMORY), 1e-12);
  EXPECT_NEAR(forecast.fastest(), 0.3 * std::exp(-5.0 / MEMORY), 1e-12);
  EXPECT_EQ(forecast.positions()[NODES], position);
  lookAt(6.0, 0.25);
  EXPECT_NEAR(forecast.doubt(0), 0.2 * 0.25, 1e-12);
  forecast.reset();
  lookAt(7.0, 0.0);
  EXPECT_EQ(forecast.doubt(0), 0.0);
}

TEST(LeaderForecast, WhoDoesNotListenExpectsTheFadingVelocity) {
  Watched watched(ExpectedLeader::FADING);
  watched.go(10.0, honest);
  expectFading(watched.forecast, watched.now - CYCLE);
}

TEST(LeaderForecast, TrustHasToBeEarned) {
  Watched watched(ExpectedLeader::ANNOUNCED);
  watched.look(0.0, announce(0.0, path));
  expectFading(watched.forecast, 0.0);
}

TEST(LeaderForecast, WhatHasBeenTrueIsTrusted) {
  Watched watched(ExpectedLeader::ANNOUNCED);
  Watched without(ExpectedLeader::FADING);
  watched.go(6.0, honest);
  without.go(6.0, honest);
  EXPECT_LT(watched.error(), 0.02);
  EXPECT_GT(without.error(), 0.1);
  for (int node = 0; node < NODES; ++node) {
    EXPECT_GT(watched.forecast.trust(node), 0.9) << "node " << node;
    EXPECT_LT(watched.forecast.doubt(node), 0.5 * without.forecast.doubt(node) + 0.03);
  }
}

TEST(LeaderForecast, TheKnownIsExpectedAtOnce) {
  Watched watched(ExpectedLeader::KNOWN);
  watched.look(0.0, announce(0.0, path));
  watched.now = CYCLE;
  EXPECT_LT(watched.error(), 0.01);
  EXPECT_GE(watched.forecast.fastest(), velocityOf(path, 0.0).norm());
}

//! The mean error with announcements is at most a little above that without any.
void expectHarmless(const std::function<Way(double)>& announced) {
  Watched watched(ExpectedLeader::ANNOUNCED);
  Watched without(ExpectedLeader::FADING);
  double error = 0.0;
  double reference = 0.0;
  for (int k = 0; k < 400; ++k) {
    watched.go(0.1, announced);
    without.go(0.1, announced);
    error += watched.error();
    reference += without.error();
  }
  EXPECT_LT(error, 1.03 * reference);
}

TEST(LeaderForecast, WrongAnnouncementsAreNoWorseThanNone) {
  for (const auto& announced : {opposite, late, scaled, wild}) {
    expectHarmless(announced);
  }
}

TEST(LeaderForecast, TheOppositeIsNotTrusted) {
  Watched watched(ExpectedLeader::ANNOUNCED);
  watched.go(10.0, opposite);
  expectFading(watched.forecast, watched.now - CYCLE);
}

TEST(LeaderForecast, TrustIsLostQuickly) {
  Watched watched(ExpectedLeader::ANNOUNCED);
  watched.go(20.0, honest);
  watched.go(2.0, opposite);
  for (int node = 0; node < NODES; ++node) {
    EXPECT_LT(watched.forecast.trust(node), 0.1) << "node " << node;
  }
}

TEST(LeaderForecast, AfterAResetTrustHasToBeEarnedAgain) {
  Watched watched(ExpectedLeader::ANNOUNCED);
  watched.go(6.0, honest);
  watched.forecast.reset();
  watched.look(watched.now, announce(watched.now, path));
  expectFading(watched.forecast, watched.now);
}

TEST(LeaderForecast, UnusableAnnouncementsCountAsNone) {
  constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(Announcement&)>> faults{
      [](Announcement& a) { a.positions[10] = NOT_A_NUMBER; },
      [](Announcement& a) { a.times[3] = NOT_A_NUMBER; },
      [](Announcement& a) { std::swap(a.times[3], a.times[4]); },
      [](Announcement& a) { a.positions[10] += 10.0; },
      [](Announcement& a) { a.times.resize(1); },
      [](Announcement& a) { a.times.clear(); },
      [](Announcement& a) {  // as old as that
        for (double& time : a.times) {
          time -= 5.0;
        }
      },
      [](Announcement& a) {  // begins later
        for (double& time : a.times) {
          time += 0.1;
        }
      }};
  for (const auto& spoil : faults) {
    Watched watched(ExpectedLeader::ANNOUNCED);
    watched.go(6.0, honest);
    Announcement announcement = announce(watched.now, path);
    spoil(announcement);
    watched.look(watched.now, announcement);
    expectFading(watched.forecast, watched.now);
  }
}

TEST(LeaderForecast, BeyondItsEndAnAnnouncementIsContinued) {
  Watched watched(ExpectedLeader::KNOWN);
  Announcement announcement = announce(0.0, path);
  announcement.times.resize(2);
  watched.look(0.0, announcement);
  expectFading(watched.forecast, 0.0);
}

TEST(LeaderForecast, FaultsAreNamed) {
  Announcement announcement = announce(0.0, path);
  EXPECT_EQ(findFault(announcement.view()), "");
  announcement.times[4] = announcement.times[3];
  EXPECT_EQ(findFault(announcement.view()), "the time of position 4 is not after the one before");
  announcement.positions[3] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(findFault(announcement.view()), "position 1 or its time is not finite");
  EXPECT_EQ(findFault(AnnouncementView()), "it has 0 positions, at least two are needed");
}

}  // namespace
}  // namespace control
}  // namespace deformable_manipulation
