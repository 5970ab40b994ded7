// Rods in segments of unequal length, next to grips of a length.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "../../src/pbd/rod_pieces.h"
#include "deformable_manipulation/pbd/rod_equilibrium.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

RodParameters gripped(const std::vector<Grip>& grips, int segments = 28) {
  RodParameters p = rope(segments);
  p.grips = grips;
  return p;
}

TEST(RodPieces, areEqualWithoutGripsOfALength) {
  const RodPieces pieces = rodPieces(gripped({{0, {}}, {27, {}}}));
  EXPECT_TRUE(pieces.equal);
  for (double length : pieces.lengths) {
    EXPECT_EQ(length, 2.25 / 28);
  }
}

TEST(RodPieces, growAwayFromTheGripsAndAddUp) {
  const RodPieces pieces = rodPieces(gripped({{0, 0.02}, {27, 0.05}}));
  EXPECT_NEAR(std::accumulate(pieces.lengths.begin(), pieces.lengths.end(), 0.0), 2.25, 1e-12);
  EXPECT_NEAR(pieces.ends.back(), 2.25, 1e-12);
  EXPECT_NEAR(pieces.lengths[0] - pieces.lengths[1], 0.02, 1e-12);
  EXPECT_NEAR(pieces.lengths[27] - pieces.lengths[26], 0.05, 1e-12);
  for (int i = 1; i < 13; ++i) {
    EXPECT_GE(pieces.lengths[i + 1], pieces.lengths[i]);
    EXPECT_LE(pieces.lengths[i + 1], std::exp(9.42 / 28) * pieces.lengths[i] * (1.0 + 1e-12));
    EXPECT_NEAR(pieces.lengths[27 - i], pieces.lengths[i], 1e-12);
  }
}

//! A joint next to a gripper bends over the rod from its edge to the middle of the next segment, and as much before it.
TEST(RodPieces, bendFromTheEdgeOfTheGripper) {
  const RodPieces pieces = rodPieces(gripped({{0, 0.02}, {14, 0.03}, {27, {}}}));
  EXPECT_NEAR(pieces.joint_lengths[0], 0.5 * (pieces.lengths[0] - 0.02 + pieces.lengths[1]), 1e-12);
  EXPECT_NEAR(pieces.joint_lengths[13], 0.5 * (pieces.lengths[13] + pieces.lengths[14] - 0.03), 1e-12);
  EXPECT_NEAR(pieces.joint_lengths[5], 0.5 * (pieces.lengths[5] + pieces.lengths[6]), 1e-12);
  EXPECT_NEAR(std::accumulate(pieces.joint_lengths.begin(), pieces.joint_lengths.end(), 0.0),
              2.25 - 0.03 - 0.5 * (pieces.lengths[0] + 0.02 + pieces.lengths[27]), 1e-12);
}

TEST(RodPieces, leaveInnerGripsWhereTheyAre) {
  const RodPieces pieces = rodPieces(gripped({{0, 0.02}, {9, 0.02}, {20, {}}}));
  EXPECT_NEAR(pieces.centre(9), 9.5 * 2.25 / 28, 1e-12);
  EXPECT_NEAR(pieces.centre(20), 20.5 * 2.25 / 28, 1e-12);
  EXPECT_NEAR(pieces.lengths[20], 2.25 / 28, 1e-12);
  EXPECT_EQ(pieces.at(9.5 * 2.25 / 28), 9);
  EXPECT_EQ(pieces.at(0.0), 0);
  EXPECT_EQ(pieces.at(2.25), 27);
}

TEST(RodPieces, fillSpansOfFewSegments) {
  const RodPieces pieces = rodPieces(gripped({{0, 0.02}, {4, 0.02}}, 5));
  EXPECT_NEAR(pieces.ends.back(), 2.25, 1e-12);
  EXPECT_NEAR(pieces.lengths[1], pieces.lengths[3], 1e-12);
  EXPECT_NEAR(pieces.lengths[2], 2.0 * pieces.lengths[1], 1e-12);
}

class Gripped : public testing::TestWithParam<RodSolver> {};

TEST_P(Gripped, settlesInTheEquilibrium) {
  RodParameters p = gripped({{0, 0.03}, {12, 0.05}});
  p.solver = GetParam();
  p.young_modulus = 1e8;
  p.torsion_modulus = 3e7;
  p.natural_shape.curvature = {0.2, 0.3};
  p.point_masses = {{0.5, 0.02}, {2.2, 0.02}};
  Rod rod(p);
  rod.hold(0, Hold::CLAMPED, gripAt(p, Vector3::Zero()));
  rod.hold(12, Hold::CLAMPED, gripAt(p, Vector3(0.0, 0.9, 0.1)));
  rod.layOut();
  const bool direct = GetParam() == RodSolver::DIRECT;
  ASSERT_TRUE(rod.settle({0.01, direct ? 2 : 400, 1e-7, 200.0}));
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
  const Vector3 sum = rod.wrench(0).force + rod.wrench(12).force;
  EXPECT_NEAR(sum.z(), -9.81 * rod.mass(), 1e-4);
  EXPECT_NEAR(rod.mass(), rope().mass() + 0.04, 1e-12);
}

//! Held nowhere, light and heavy segments fall alike, and a thrown rod keeps its momentum.
TEST_P(Gripped, movesFreelyWithItsMomentum) {
  RodParameters p = gripped({{0, 0.03}, {12, 0.05}});
  p.solver = GetParam();
  p.gravity.setZero();
  p.damping = 2.0;
  Rod rod(p);
  const RodPieces pieces = rodPieces(p);
  std::vector<double> points(3 * rod.pointCount());
  Eigen::Matrix3Xd speeds = Eigen::Matrix3Xd::Zero(3, rod.pointCount());
  rod.points(points.data());
  for (int i = 0; i < rod.pointCount(); ++i) {
    speeds(2, i) = 0.3 * pieces.ends[i];
  }
  rod.setState(points.data(), speeds.data());
  const auto momentum = [&] {
    const std::vector<Vector3> v = velocities(rod);
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < v.size(); ++i) {
      sum += pieces.lengths[i] / 2.25 * rope().mass() * v[i];
    }
    return sum;
  };
  const Vector3 before = momentum();
  EXPECT_NEAR(before.z(), rope().mass() * 0.3 * 0.5 * 2.25, 1e-9);
  for (int i = 0; i < 20; ++i) {
    rod.step(0.01, 10);
  }
  EXPECT_NEAR((momentum() - before).norm(), 0.0, 1e-9);
}

//! A copy is an object that is held elsewhere, lane by lane.
TEST_P(Gripped, hasCopiesThatAreDisplacedRods) {
  RodParameters p = gripped({{0, 0.02}, {27, 0.02}});
  p.solver = GetParam();
  const Vector3 displacement(0.0, -0.1, 0.05);
  auto rod = hangingRope(p, 1.5, Hold::CLAMPED);
  rod->addCopy(27, displacement);
  Rod displaced(p);
  displaced.hold(0, Hold::CLAMPED, gripAt(p, Vector3::Zero()));
  displaced.hold(27, Hold::CLAMPED, gripAt(p, Vector3(0.0, 1.5, 0.0) + displacement));
  displaced.layOut();
  for (int i = 0; i < 600; ++i) {
    rod->step(0.01, 4);
    displaced.step(0.01, 4);
  }
  EXPECT_LT(difference(*rod, 1, displaced, 0), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(BothSolvers, Gripped, testing::Values(RodSolver::DIRECT, RodSolver::GAUSS_SEIDEL),
                         [](const testing::TestParamInfo<RodSolver>& info) {
                           return std::string(info.param == RodSolver::DIRECT ? "direct" : "gauss_seidel");
                         });

TEST(Grip, isOnTheRodAndLeavesRoom) {
  for (const std::vector<Grip>& grips : std::vector<std::vector<Grip>>{{{28, 0.02}},
                                                                       {{3, 0.02}, {3, 0.02}},
                                                                       {{5, 0.02}, {3, 0.02}},
                                                                       {{0, -0.01}},
                                                                       {{0, 2.3}},
                                                                       {{0, std::nan("")}},
                                                                       {{3, 0.02}, {4, 0.02}},
                                                                       {{3, 0.2}, {5, 0.2}},
                                                                       {{1, 0.3}}}) {
    EXPECT_THROW(Rod{gripped(grips)}, ParameterError) << grips[0].particle;
  }
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
