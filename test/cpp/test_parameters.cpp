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
  try {
    Rod rod(p);
    FAIL() << "no exception";
  } catch (const ParameterError& error) {
    EXPECT_EQ(keysOf(error), (std::vector<std::string>{"length", "radius", "density", "segments", "young_modulus",
                                                       "damping"}));
    EXPECT_EQ(error.problems()[0].value, "-1");
    EXPECT_NE(error.problems()[0].allowed.find("> 0 [m]"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("length: -1 - must be"), std::string::npos);
  }
}

TEST(RodParameters, keepTheMaterialWhenTheNewOneIsRefused) {
  Rod rod(rope());
  EXPECT_THROW(rod.setMaterial(1e9, -1.0, 10.0), ParameterError);
  EXPECT_EQ(rod.parameters().young_modulus, 30e6);
  rod.setMaterial(1e9, 1e8, 10.0);
  EXPECT_EQ(rod.parameters().young_modulus, 1e9);
}

TEST(SimulationParameters, areRefusedAllAtOnce) {
  Agent leader{"leader", 0, Hold::CLAMPED, Pose()};
  Agent same{"leader", 0, Hold::CLAMPED, Pose()};
  Agent beyond{"assistant", 28, Hold::CLAMPED, Pose()};
  beyond.start.position.x() = std::numeric_limits<double>::quiet_NaN();
  try {
    Simulation simulation(std::make_unique<Rod>(rope()), {leader, same, beyond}, {}, Clock());
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
  Simulation simulation(std::make_unique<Rod>(p), {leader, assistant}, {{1, Vector3(0.0, 0.0, 0.1)}}, Clock());
  EXPECT_TRUE(simulation.settled());
  EXPECT_EQ(simulation.cycle(), 0);
  const double start_z = positions(simulation.body())[13].z();
  simulation.setCommand(1, {Vector3(0.0, 0.0, 0.1), Vector3::Zero()});
  simulation.advance();
  EXPECT_NEAR(simulation.held(1).pose.position.z(), 0.001, 1e-12);
  EXPECT_NEAR(simulation.twist(1).linear.z(), 0.1, 1e-12);
  EXPECT_EQ(simulation.cycle(), 1);
  EXPECT_THROW(simulation.setCommand(2, Twist()), std::out_of_range);

  simulation.clearPerturbations(1);
  EXPECT_EQ(simulation.body().copyCount(), 1);
  simulation.reset();
  EXPECT_EQ(simulation.cycle(), 0);
  EXPECT_EQ(simulation.resetCount(), 1);
  EXPECT_EQ(simulation.body().copyCount(), 2);
  EXPECT_EQ(simulation.held(1).pose.position.z(), 0.0);
  EXPECT_EQ(positions(simulation.body())[13].z(), start_z);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
