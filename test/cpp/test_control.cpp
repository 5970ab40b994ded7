// The controller of one or two assistants: nothing is allocated in a cycle, and equal inputs give equal answers.
// This file counts the calls of malloc of the whole test program.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

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
      distance_[m] = coordinates_[3 * m + 2] - 0.2;
      normal_[3 * m + 2] = weights_[3 * m] = 1.0;
      vertices_[3 * m] = m;
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
    view_.distances = {minimum_.data(),  offsets_.data(), distance_.data(), normal_.data(),
                       vertices_.data(), weights_.data(), still_.data(),    features_};
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
    minimum_[copy] = coordinates_[3 * copy * POINTS + 2] - 0.2;
    offsets_[copy] = copy == 0 ? 0 : features_;
    offsets_[copy + 1] = features_;
  }

  int features_;
  std::vector<double> positions_ = std::vector<double>(3 * AGENTS);
  std::vector<double> coordinates_ = std::vector<double>(3 * COPIES * POINTS);
  std::vector<double> sensitivities_ = std::vector<double>(9 * AGENTS * POINTS);
  std::vector<double> displacements_ = std::vector<double>(3 * COPIES);
  std::vector<double> minimum_ = std::vector<double>(COPIES);
  std::vector<int> displaced_ = std::vector<int>(COPIES);
  std::vector<int> offsets_ = std::vector<int>(COPIES + 1);
  std::vector<double> distance_ = std::vector<double>(POINTS);
  std::vector<double> normal_ = std::vector<double>(3 * POINTS);
  std::vector<double> weights_ = std::vector<double>(3 * POINTS);
  std::vector<double> still_ = std::vector<double>(3 * POINTS);
  std::vector<int> vertices_ = std::vector<int>(3 * POINTS);
  bool ready_[COPIES] = {true, true, true, true, true, true, true};
  ObservationView view_;
};

//! Of the first assistant by its copies, or of both by the exact response.
ControllerParameters parameters(int commanded = 1) {
  ControllerParameters p;
  p.assistants = {1, 2};
  p.commanded = {1};
  p.references = {{0.0, 0.75, 0.0}};
  if (commanded == 2) {
    p.exact_gradients = true;
    p.commanded.push_back(2);
    p.references.emplace_back(0.0, 1.5, 0.0);
  }
  p.collision.offset = 0.05;
  p.overstretch.limits = Eigen::MatrixXd::Constant(AGENTS, AGENTS, 2.0);
  p.proximity.limits = Eigen::MatrixXd::Constant(AGENTS, AGENTS, 0.2);
  return p;
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
