// Rods that carry masses at places.

#include <gtest/gtest.h>

#include <cmath>

#include "deformable_manipulation/pbd/rod_equilibrium.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

class Loaded : public testing::TestWithParam<RodSolver> {
 protected:
  Loaded() : parameters_(rope()) {
    parameters_.solver = GetParam();
    parameters_.point_masses = {{0.0, 0.05}, {0.8, 0.1}, {2.24, 0.2}};
  }

  RodParameters parameters_;
};

TEST_P(Loaded, weighsWhatItCarries) {
  auto rod = hangingRope(parameters_, 1.5, Hold::CLAMPED);
  EXPECT_NEAR(rod->mass(), rope().mass() + 0.35, 1e-12);
  ASSERT_TRUE(rod->settle({0.01, 40, 1e-6, 200.0}));
  const Vector3 sum = rod->wrench(0).force + rod->wrench(27).force;
  EXPECT_NEAR(sum.z(), -9.81 * rod->mass(), 1e-4);
  EXPECT_NEAR(sum.head<2>().norm(), 0.0, 1e-4);
}

TEST_P(Loaded, settlesInTheEquilibriumWithAFreeEnd) {
  parameters_.young_modulus = 1e8;
  parameters_.torsion_modulus = 3e7;
  Rod rod(parameters_);
  rod.hold(0, Hold::CLAMPED, gripAt(parameters_, Vector3::Zero()));
  rod.hold(9, Hold::PINNED, gripAt(parameters_, Vector3(0.0, 0.71, 0.0)));
  rod.layOut();
  const bool direct = GetParam() == RodSolver::DIRECT;
  ASSERT_TRUE(rod.settle({0.01, direct ? 2 : 200, 1e-7, 200.0}));
  RodEquilibrium equilibrium;
  equilibrium.update(rod, 1);
  ASSERT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0));
  std::vector<double> expected(3 * rod.pointCount());
  std::vector<double> points(3 * rod.pointCount());
  equilibrium.points(0, expected.data());
  rod.points(points.data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i], expected[i], direct ? 5e-5 : 1e-2);
  }
  double wrenches[12];
  equilibrium.wrenches(0, wrenches);
  EXPECT_NEAR(wrenches[3], rod.wrench(0).torque.x(), direct ? 1e-5 : 2e-2);
}

//! Masses off the centres of the last segments fall as the others do.
TEST_P(Loaded, fallsWithoutTurning) {
  Rod rod(parameters_);
  const std::vector<Vector3> before = positions(rod);
  for (int i = 0; i < 50; ++i) {
    rod.step(0.01, 4);
  }
  const std::vector<Vector3> after = positions(rod);
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR((after[i] - before[i] - (after[0] - before[0])).norm(), 0.0, 1e-9);
    EXPECT_NEAR(velocities(rod)[i].z(), -9.81 * 0.5, 1e-9);
  }
}

TEST_P(Loaded, staysWhereItIsWhenHeldAndReleased) {
  auto rod = hangingRope(parameters_, 1.5, Hold::CLAMPED);
  std::vector<double> before(3 * rod->pointCount());
  std::vector<double> after(before.size());
  rod->points(before.data());
  rod->release(27);
  rod->hold(27, Hold::PINNED);
  rod->release(27);
  rod->points(after.data());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i], before[i], 1e-14);
  }
}

//! A free rod that was thrown.
TEST_P(Loaded, keepsItsMomentum) {
  parameters_.gravity.setZero();
  parameters_.damping = 0.0;
  Rod rod(parameters_);
  std::vector<double> points(3 * rod.pointCount());
  std::vector<double> speeds(points.size(), 0.0);
  rod.points(points.data());
  for (int i = 0; i < rod.pointCount(); ++i) {
    speeds[3 * i + 2] = 0.3 * i / 28.0;
  }
  rod.setState(points.data(), speeds.data());
  const auto momentum = [&] {  // the masses at the ends are on the line through the last two centres
    const std::vector<Vector3> v = velocities(rod);
    const double l = parameters_.segmentLength();
    const auto along = [&](double at) {
      const double place = at / l - 0.5;
      const int i = std::min(std::max(static_cast<int>(place), 0), 26);
      return Vector3(v[i] + (place - i) * (v[i + 1] - v[i]));
    };
    Vector3 sum = Vector3::Zero();
    for (const Vector3& each : v) {
      sum += parameters_.segmentMass() * each;
    }
    for (const PointMass& point : parameters_.point_masses) {
      sum += point.mass * along(point.at);
    }
    return sum;
  };
  const Vector3 before = momentum();
  for (int i = 0; i < 20; ++i) {
    rod.step(0.01, 10);
  }
  EXPECT_NEAR((momentum() - before).norm(), 0.0, 2e-2 * before.norm());
}

INSTANTIATE_TEST_SUITE_P(BothSolvers, Loaded, testing::Values(RodSolver::DIRECT, RodSolver::GAUSS_SEIDEL),
                         [](const testing::TestParamInfo<RodSolver>& info) {
                           return std::string(info.param == RodSolver::DIRECT ? "direct" : "gauss_seidel");
                         });

TEST(PointMass, isOnTheRod) {
  RodParameters p = rope();
  p.point_masses = {{2.3, 0.1}};
  EXPECT_THROW(Rod{p}, ParameterError);
  p.point_masses = {{1.0, 0.0}};
  EXPECT_THROW(Rod{p}, ParameterError);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
