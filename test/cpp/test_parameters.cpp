// Parameters are refused with key, value and range, all at once.

#include <gtest/gtest.h>

#include <limits>

#include "deformable_manipulation/pbd/errors.h"
#include "deformable_manipulation/pbd/simulation.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

std::vector<std::string> keysOf(const ParameterError& error) {
  std::vector<std::string> keys;
  for (const Problem& problem : error.problems()) {
    keys.push_back(problem.key);
  }
  return keys;
}

TEST(RodParameters, areRefusedAllAtOnce) {
  RodParameters p = rope();
  p.length = -1.0;
  p.radius = 0.0;
  p.density = std::numeric_limits<double>::quiet_NaN();
  p.segments = 1;
  p.young_modulus = std::numeric_limits<double>::infinity();
  p.damping = -1.0;
  p.bending_retardation_time = -1.0;
  p.threads = 0;
  try {
    Rod rod(p);
    FAIL() << "no exception";
  } catch (const ParameterError& error) {
    EXPECT_EQ(keysOf(error), (std::vector<std::string>{"length", "radius", "density", "segments", "young_modulus",
                                                       "damping", "bending_retardation_time", "threads"}));
    EXPECT_EQ(error.problems()[0].value, "-1");
    EXPECT_NE(error.problems()[0].allowed.find("> 0 [m]"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("length: -1 - must be"), std::string::npos);
  }
}

TEST(RodParameters, keepTheMaterialWhenTheNewOneIsRefused) {
  Rod rod(rope());
  EXPECT_THROW(rod.setMaterial({{"young_modulus", 1e9}, {"torsion_modulus", -1.0}}), ParameterError);
  try {
    rod.setMaterial({{"young_modulus", 1e9}, {"colour", 1.0}, {"damping", -1.0}});
    FAIL() << "no exception";
  } catch (const ParameterError& error) {
    EXPECT_EQ(keysOf(error), (std::vector<std::string>{"colour", "damping"}));
  }
  EXPECT_EQ(rod.parameters().young_modulus, 30e6);
  rod.setMaterial({{"young_modulus", 1e9}});
  EXPECT_EQ(rod.parameters().young_modulus, 1e9);
}

TEST(SimulationParameters, areRefusedAllAtOnce) {
  Agent leader{"leader", 0, Hold::CLAMPED, Pose()};
  Agent same{"leader", 0, Hold::CLAMPED, Pose()};
  Agent beyond{"assistant", 28, Hold::CLAMPED, Pose()};
  beyond.start.position.x() = std::numeric_limits<double>::quiet_NaN();
  try {
    Simulation simulation(std::make_unique<Rod>(rope()), {leader, same, beyond}, {}, Clock{0.01, 2, 1});
    FAIL() << "no exception";
  } catch (const ParameterError& error) {
    EXPECT_EQ(keysOf(error), (std::vector<std::string>{"agents.leader", "agents.leader.particle",
                                                       "agents.assistant.particle", "agents.assistant.start"}));
  }
  EXPECT_THROW(Simulation(std::make_unique<Rod>(rope()), {leader}, {}, Clock{0.0, 1, 1}), ParameterError);
}

TEST(Simulation, actsOnACommandFromTheNextAdvanceOn) {
  const RodParameters p = rope();
  Agent leader{"leader", 0, Hold::CLAMPED, gripAt(p, Vector3::Zero())};
  Agent assistant{"assistant", 27, Hold::CLAMPED, gripAt(p, Vector3(0.0, 1.5, 0.0))};
  Simulation simulation(std::make_unique<Rod>(p), {leader, assistant}, {{1, Vector3(0.0, 0.0, 0.1)}},
                        Clock{0.01, 2, 1});
  EXPECT_EQ(simulation.rest(), Rest::STABLE);
  EXPECT_EQ(simulation.cycle(), 0);
  const double start_z = positions(simulation.body())[13].z();
  simulation.setCommand(1, {Vector3(0.0, 0.0, 0.1), Vector3::Zero()});
  simulation.advance();
  EXPECT_NEAR(simulation.pose(1).position.z(), 0.001, 1e-12);
  EXPECT_NEAR(simulation.twist(1).linear.z(), 0.1, 1e-12);
  EXPECT_EQ(simulation.cycle(), 1);
  EXPECT_THROW(simulation.setCommand(2, Twist()), std::out_of_range);

  simulation.clearPerturbations(1);
  EXPECT_EQ(simulation.body().copyCount(), 1);
  simulation.reset();
  EXPECT_EQ(simulation.cycle(), 0);
  EXPECT_EQ(simulation.resetCount(), 1);
  EXPECT_EQ(simulation.body().copyCount(), 2);
  EXPECT_EQ(simulation.pose(1).position.z(), 0.0);
  EXPECT_EQ(positions(simulation.body())[13].z(), start_z);
}

TEST(Simulation, letsAgentsReleaseAndGrip) {
  const RodParameters p = rope();
  Agent leader{"leader", 0, Hold::CLAMPED, gripAt(p, Vector3::Zero())};
  Agent assistant{"assistant", 27, Hold::CLAMPED, gripAt(p, Vector3(0.0, 1.5, 0.0))};
  Simulation simulation(std::make_unique<Rod>(p), {leader, assistant}, {{1, Vector3(0.0, 0.0, 0.1)}},
                        Clock{0.01, 2, 1});
  EXPECT_THROW(simulation.hold(1, 20, Hold::PINNED), std::logic_error);  // it holds one
  simulation.release(1);
  EXPECT_EQ(simulation.particleOf(1), -1);
  EXPECT_EQ(simulation.body().copyCount(), 1);
  EXPECT_EQ(simulation.wrench(1).force.norm(), 0.0);
  EXPECT_THROW(simulation.release(1), std::logic_error);
  simulation.setCommand(1, {Vector3(0.0, 0.0, -0.1), Vector3::Zero()});
  for (int i = 0; i < 100; ++i) {
    simulation.advance();
  }
  EXPECT_NEAR(simulation.pose(1).position.z(), -0.1, 1e-12);              // the agent moves on
  EXPECT_LT(positions(simulation.body())[27].z(), -0.5);                  // the rope falls
  EXPECT_THROW(simulation.hold(1, 27, Hold::CLAMPED), std::logic_error);  // out of its reach

  simulation.setCommand(1, Twist());
  for (int i = 0; i < 2000; ++i) {  // until the rope hangs still
    simulation.advance();
  }
  const Vector3 there = positions(simulation.body())[27];
  simulation.setCommand(1, {there - simulation.pose(1).position, Vector3::Zero()});
  for (int i = 0; i < 100; ++i) {
    simulation.advance();
  }
  simulation.setCommand(1, Twist());
  const Vector3 end = positions(simulation.body())[27];
  ASSERT_LT((end - simulation.pose(1).position).norm(), Simulation::kGripReach);
  simulation.hold(1, 27, Hold::PINNED);
  EXPECT_EQ(simulation.body().copyCount(), 2);  // its copy is back
  simulation.advance();
  EXPECT_LT((positions(simulation.body())[27] - end).norm(), 1e-12);
}

TEST(Simulation, keepsChangedPerturbationsOverAReset) {
  const RodParameters p = rope();
  Agent leader{"leader", 0, Hold::CLAMPED, gripAt(p, Vector3::Zero())};
  Agent assistant{"assistant", 27, Hold::CLAMPED, gripAt(p, Vector3(0.0, 1.5, 0.0))};
  const Vector3 before(0.0, 0.0, 0.1), after(0.0, 0.03, 0.0);
  Simulation simulation(std::make_unique<Rod>(p), {leader, assistant}, {{1, before}}, Clock{0.01, 2, 1});
  EXPECT_THROW(simulation.setPerturbations({{1, after}, {1, Vector3::Zero()}}), std::invalid_argument);
  ASSERT_EQ(simulation.body().copies().size(), 1u);
  EXPECT_EQ(simulation.body().copies()[0].requested, before);
  simulation.setPerturbations({{1, after}, {1, -after}});
  for (const bool is_reset : {false, true}) {
    ASSERT_EQ(simulation.body().copies().size(), 2u);
    EXPECT_EQ(simulation.body().copies()[0].requested, after);
    EXPECT_EQ(simulation.body().copies()[1].requested, -after);
    // New copies grow; after a reset they are there, settled.
    EXPECT_EQ(simulation.body().copies()[0].ready(), is_reset);
    simulation.reset();
  }
  simulation.release(1);
  EXPECT_THROW(simulation.setPerturbations({{1, before}}), std::logic_error);
}

TEST(Simulation, keepsAChangedMaterialOverAReset) {
  const RodParameters p = rope();
  Agent leader{"leader", 0, Hold::CLAMPED, gripAt(p, Vector3::Zero())};
  Simulation simulation(std::make_unique<Rod>(p), {leader}, {}, Clock{0.01, 2, 1});
  const double soft = positions(simulation.body())[27].z();
  simulation.setMaterial({{"young_modulus", 3e10}, {"torsion_modulus", 1e10}});
  simulation.reset();
  EXPECT_EQ(simulation.rest(), Rest::STABLE);
  EXPECT_GT(positions(simulation.body())[27].z(), soft + 0.5);
}

TEST(Simulation, isRefusedWhenTheObjectComesApart) {
  RodParameters p = rope();
  p.solver = RodSolver::GAUSS_SEIDEL;  // needs far more substeps
  Agent leader{"leader", 0, Hold::CLAMPED, gripAt(p, Vector3::Zero())};
  Agent assistant{"assistant", 27, Hold::CLAMPED, gripAt(p, Vector3(0.0, 1.5, 0.0))};
  try {
    Simulation simulation(std::make_unique<Rod>(p), {leader, assistant}, {}, Clock{0.2, 1, 1});
    FAIL() << "no exception";
  } catch (const ParameterError& error) {
    EXPECT_EQ(keysOf(error), (std::vector<std::string>{"simulation.time_step"}));
  }
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
