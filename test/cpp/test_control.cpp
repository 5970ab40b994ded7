// The controller of one or two assistants: nothing is allocated in a cycle, and equal inputs give equal answers.
// This file counts the calls of malloc of the whole test program.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "deformable_manipulation/control/differences.h"
#include "deformable_manipulation/control/linear_shapes.h"
#include "deformable_manipulation/control/team_controller.h"

namespace {

std::atomic<long> allocations{0};

}  // namespace

#ifdef __SANITIZE_ADDRESS__  // which has a malloc of its own
extern "C" void __sanitizer_malloc_hook(const volatile void*, std::size_t) { ++allocations; }
#else
extern "C" void* __libc_malloc(std::size_t size);  // glibc's own

extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace deformable_manipulation {
namespace control {
namespace {

constexpr int AGENTS = 3;
constexpr int POINTS = 29;
constexpr int COPIES = 7;

//! How a point of a chain held at both ends and in the middle goes with an agent, from 0 to 1.
double share(int agent, int point) {
  const double place = 2.0 * point / (POINTS - 1);
  return std::max(0.0, 1.0 - std::abs(place - agent));
}

//! A chain held at three points above ground, which sinks with the leader.
class Chain {
 public:
  explicit Chain(int features) : features_(features) {
    distances_.minimum.resize(COPIES);
    distances_.offsets.resize(COPIES + 1);
    distances_.features.resize(features);
    for (int m = 0; m < features; ++m) {
      distances_.features[m].normal = Vector3::UnitZ();
      distances_.features[m].vertices = {m, 0, 0};
      distances_.features[m].weights = {1.0, 0.0, 0.0};
    }
    for (int agent = 0; agent < AGENTS; ++agent) {
      for (int point = 0; point < POINTS; ++point) {
        for (int i = 0; i < 3; ++i) {
          sensitivities_[9 * (agent * POINTS + point) + 4 * i] = share(agent, point);
        }
      }
    }
  }

  //! State k of a leader that sinks at 0.1 m/s in front of assistants at rest, of whom the first has copies.
  const ObservationView& at(int cycle) {
    const double time = 0.01 * cycle;
    positions_ = {0.0, 0.0, 0.3 - 0.1 * time, 0.0, 0.75, 0.3, 0.0, 1.5, 0.3};
    for (int copy = 0; copy < COPIES; ++copy) {
      fillCopy(copy);
    }
    for (int m = 0; m < features_; ++m) {
      distances_.features[m].distance = coordinates_[3 * m + 2] - 0.2;
    }
    view_.time = time;
    view_.agents = AGENTS;
    view_.copies = COPIES;
    view_.points = POINTS;
    view_.positions = positions_.data();
    view_.coordinates = coordinates_.data();
    view_.displaced_agents = displaced_.data();
    view_.displacements = displacements_.data();
    view_.ready = ready_;
    view_.sensitivities = sensitivities_.data();
    view_.distances = &distances_;
    return view_;
  }

 private:
  void fillCopy(int copy) {
    const int axis = (copy + 2) % 3;
    displaced_[copy] = copy == 0 ? -1 : 1;
    if (copy > 0) {
      displacements_[3 * copy + axis] = copy <= 3 ? 0.1 : -0.1;
    }
    for (int point = 0; point < POINTS; ++point) {
      for (int i = 0; i < 3; ++i) {
        double& coordinate = coordinates_[3 * (copy * POINTS + point) + i];
        coordinate = share(1, point) * displacements_[3 * copy + i];
        for (int agent = 0; agent < AGENTS; ++agent) {
          coordinate += share(agent, point) * positions_[3 * agent + i];
        }
      }
    }
    distances_.minimum[copy] = coordinates_[3 * copy * POINTS + 2] - 0.2;
    distances_.offsets[copy] = copy == 0 ? 0 : features_;
    distances_.offsets[copy + 1] = features_;
  }

  int features_;
  std::vector<double> positions_ = std::vector<double>(3 * AGENTS);
  std::vector<double> coordinates_ = std::vector<double>(3 * COPIES * POINTS);
  std::vector<double> sensitivities_ = std::vector<double>(9 * AGENTS * POINTS);
  std::vector<double> displacements_ = std::vector<double>(3 * COPIES);
  std::vector<int> displaced_ = std::vector<int>(COPIES);
  distance::Distances distances_;
  bool ready_[COPIES] = {true, true, true, true, true, true, true};
  ObservationView view_;
};

using Mapping = ParameterValue::Mapping;
using List = ParameterValue::List;

List numbers(std::initializer_list<double> values) { return List(values.begin(), values.end()); }

//! A section of a barrier on pairs.
Mapping pairs(double limit) {
  return {{"limits", List(AGENTS, List(AGENTS, limit))}, {"margin", 0.0}, {"alpha", numbers({1.0, 2.0})}};
}

Mapping collision() {
  return {{"offset", 0.05},
          {"margin", 0.0},
          {"speed_margin", 0.0},
          {"snap_margin", 0.0},
          {"band", 0.1},
          {"alpha", numbers({1.0, 5.0})},
          {"anticipation", numbers({0.4, 5.0})},
          {"obstacle_velocity", true},
          {"gradient", "features"}};
}

Mapping horizon() {
  return {{"length", 0.0},         {"nodes", 8},
          {"leader", "fading"},    {"leader_fade", 3.0},
          {"leader_doubt", 0.2},   {"leader_memory", 12.0},
          {"obstacle_doubt", 0.2}, {"weights", numbers({1.0, 1.0, 0.1})}};
}

Mapping controller(bool exact) {
  return {{"formulation", "full"},
          {"feedforward", true},
          {"priority", List{"collision", "overstretch", "proximity"}},
          {"gain", 1.0},
          {"weights", numbers({1.0, 1.0, 1.0})},
          {"max_velocity", 0.15},
          {"max_acceleration", 1.0},
          {"max_jerk", 1000.0},
          {"orientation", "fixed"},
          {"turning_gain", 0.5},
          {"turning_weights", numbers({0.3, 0.3, 0.3})},
          {"max_angular_velocity", 0.5},
          {"max_angular_acceleration", 2.0},
          {"smoothing", 0.0},
          {"disturbance_filter", 0.2},
          {"timeout", 0.2},
          {"horizon", horizon()},
          {"jacobian", exact ? "equilibrium" : "perturbed_copies"},
          {"collision", collision()},
          {"overstretch", pairs(2.0)},
          {"proximity", pairs(0.2)}};
}

Mapping team(int commanded) {
  Mapping team{{"agents", AGENTS},
               {"leader", 0},
               {"assistants", List{1, 2}},
               {"commanded", List{1}},
               {"own", List{0}},
               {"references", List{numbers({0.0, 0.75, 0.0})}},
               {"places", List{numbers({0.0, 0.0, 0.0}), numbers({0.0, 0.75, 0.0}), numbers({0.0, 1.5, 0.0})}},
               {"orientations", List(AGENTS, numbers({0.0, 0.0, 0.0, 1.0}))},
               {"cycle_time", 0.01},
               {"safety", true},
               {"barriers", List{"collision", "overstretch", "proximity"}}};
  if (commanded == 2) {
    team["commanded"] = List{1, 2};
    team["own"] = List{0, 1};
    team["references"] = List{numbers({0.0, 0.75, 0.0}), numbers({0.0, 1.5, 0.0})};
  }
  return team;
}

ControllerParameters read(const ParameterValue& controller, const ParameterValue& team) {
  pbd::ParameterCheck check;
  const ControllerParameters parameters =
      ControllerParameters::read({controller, "controller", check}, {team, "team", check});
  check.throwIfAny();
  return parameters;
}

//! Of the first assistant by its copies, or of both by the exact response.
ControllerParameters parameters(int commanded = 1) { return read(controller(commanded == 2), team(commanded)); }

TEST(LinearShapes, followTheHeldPointsAsTheCopiesDo) {
  Chain chain(POINTS);
  const ObservationView& observation = chain.at(1);
  Differences differences(AGENTS, 0);
  differences.update(observation);
  std::vector<double> response;
  differences.takeResponse(response);
  ASSERT_EQ(response.size(), 9u * AGENTS * POINTS);

  std::vector<Vector3> held;
  for (int agent = 0; agent < AGENTS; ++agent) {
    held.push_back(observation.position(agent));
  }
  LinearShapes shapes;
  shapes.setResponse(held, response);
  shapes.setPresent(observation.coordinates);
  const Vector3 step(0.1, -0.2, 0.3);
  std::vector<Vector3> moved = held;  // the first assistant alone, then all together
  moved[1] += step;
  for (const Vector3& position : held) {
    moved.push_back(position + step);
  }
  shapes.find(moved);
  std::vector<double> points(3 * POINTS);
  for (int shape = 0; shape < 2; ++shape) {
    shapes.points(shape, points.data());
    for (int point = 0; point < POINTS; ++point) {
      const double part = shape == 0 ? share(1, point) : 1.0;
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(points[3 * point + i], observation.coordinates[3 * point + i] + part * step[i], 1e-12);
      }
    }
  }
}

TEST(ControllerParameters, everyMistakeIsToldAtOnce) {
  Mapping wrong = controller(false);
  wrong.erase("gain");
  wrong["weights"] = numbers({1.0, 1.0});
  wrong["priority"] = List{"collision", "gravity", "proximity"};
  try {
    read(wrong, team(1));
    FAIL();
  } catch (const pbd::ParameterError& error) {
    ASSERT_EQ(error.problems().size(), 3u);
    EXPECT_EQ(error.problems()[0].key, "controller.gain");
    EXPECT_EQ(error.problems()[1].key, "controller.weights");
    EXPECT_EQ(error.problems()[2].key, "controller.priority");
  }
}

TEST(TeamController, refusesABarrierThatThereIsNot) {
  Mapping others = team(1);
  others["barriers"] = List{"collision", "overstretch", "gravity"};
  Mapping keys = controller(false);
  keys["priority"] = List{"collision", "overstretch", "gravity"};
  EXPECT_THROW(TeamController(read(keys, others)), std::invalid_argument);
}

TEST(TeamController, staysAsItIsWhenNewParametersCannotBeUsed) {
  TeamController one(parameters());
  TeamController other(parameters());
  Mapping wrong = controller(false);
  wrong["weights"] = numbers({1.0, 2.0, 3.0});
  wrong["collision"] = Mapping{{"offset", 0.2}};
  EXPECT_THROW(one.setParameters(read(wrong, team(1))), std::invalid_argument);
  Chain chain(POINTS);
  for (int cycle = 0; cycle < 100; ++cycle) {
    EXPECT_EQ(one.update(chain.at(cycle))[0].command, other.update(chain.at(cycle))[0].command);
  }
}

TEST(Allocation, isCounted) {
  const long before = allocations;
  const TeamController controller(parameters());
  EXPECT_GT(allocations - before, 5);
}

TEST(TeamController, allocatesNothingOnceWarm) {
  for (const auto& [features, commanded] : {std::pair(3, 1), std::pair(POINTS, 1), std::pair(POINTS, 2)}) {
    TeamController controller(parameters(commanded));
    Chain chain(features);
    bool constrained = false;
    for (int cycle = 0; cycle < 200; ++cycle) {
      const ObservationView& observation = chain.at(cycle);
      const long before = allocations;
      const Decision& decision = controller.update(observation)[0];
      const long needed = allocations - before;
      constrained = constrained || decision.status != Status::NOMINAL;
      if (cycle < 100) {
        continue;
      }
      EXPECT_EQ(needed, 0) << "cycle " << cycle;
    }
    EXPECT_TRUE(constrained);
  }
}

TEST(TeamController, answersEqualInputsEqually) {
  TeamController one(parameters());
  TeamController other(parameters());
  Chain chain(POINTS);
  for (int cycle = 0; cycle < 200; ++cycle) {
    const Vector3 first = one.update(chain.at(cycle))[0].command;
    EXPECT_EQ(first, other.update(chain.at(cycle))[0].command);
    EXPECT_LE(first.cwiseAbs().maxCoeff(), parameters().max_velocity);
  }
}

TEST(DualActiveSet, allocatesNothingOnceWarmAndNeedsFewIterations) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  DualActiveSet solver;
  QuadraticProgram program;
  const int n = 13;
  const int rows = 100;
  program.hessian = Eigen::VectorXd::Ones(n);
  program.linear = Eigen::VectorXd::Zero(n);
  program.clear(rows);
  for (int trial = 0; trial < 50; ++trial) {
    program.rows = 0;
    for (int row = 0; row < rows; ++row) {
      auto added = program.addRow(normal(generator) - 1.0);
      for (int i = 0; i < n; ++i) {
        added[i] = normal(generator);
      }
    }
    for (int i = 0; i < n; ++i) {
      program.linear[i] = 3.0 * normal(generator);
    }
    const long before = allocations;
    const DualActiveSet::Outcome outcome = solver.solve(program);
    if (trial > 0) {
      EXPECT_EQ(allocations - before, 0);
    }
    EXPECT_NE(outcome, DualActiveSet::Outcome::UNSOLVED);
    EXPECT_LT(solver.iterations(), rows);
  }
}

}  // namespace
}  // namespace control
}  // namespace deformable_manipulation
