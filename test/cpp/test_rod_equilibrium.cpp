// Settled shapes against theory.

#include <gtest/gtest.h>

#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

//! Scale a of the catenary z = a cosh(y / a) whose arc of the given length spans a width, by bisection.
double catenaryScale(double length, double span) {
  double low = 1e-3;
  double high = 1e3;
  for (int i = 0; i < 200; ++i) {
    const double a = 0.5 * (low + high);
    (2.0 * a * std::sinh(0.5 * span / a) > length ? low : high) = a;
  }
  return low;
}

struct Case {
  RodSolver solver;
  int substeps;
  double tolerance;  // of the sag, relative to the length
};

class HangingRope : public testing::TestWithParam<Case> {};

TEST_P(HangingRope, followsTheCatenary) {
  RodParameters p = rope(60);
  p.young_modulus = p.torsion_modulus = 1e4;  // bending hardly matters: a chain
  p.solver = GetParam().solver;
  const double span = 1.5;
  auto rod = hangingRope(p, span, Hold::PINNED);
  SettleOptions options = settling();
  options.substeps = GetParam().substeps;
  ASSERT_TRUE(rod->settle(options));

  const double length = rod->freeLength(0, p.segments - 1);
  const double a = catenaryScale(length, span);
  double worst = 0.0;
  for (const Vector3& x : positions(*rod)) {
    const double z = a * (std::cosh((x.y() - 0.5 * span) / a) - std::cosh(0.5 * span / a));
    worst = std::max(worst, std::abs(x.z() - z));
    EXPECT_NEAR(x.x(), 0.0, 1e-9);
  }
  EXPECT_LT(worst / length, GetParam().tolerance);
}

TEST_P(HangingRope, isCarriedByItsHolds) {
  RodParameters p = rope();
  p.solver = GetParam().solver;
  auto rod = hangingRope(p, 1.5, Hold::CLAMPED);
  SettleOptions options = settling();
  options.substeps = GetParam().substeps;
  ASSERT_TRUE(rod->settle(options));
  rod->step(0.01, options.substeps);  // settling ends with all velocities taken away

  const Wrench left = rod->wrench(0);
  const Wrench right = rod->wrench(p.segments - 1);
  const Vector3 weight = rod->mass() * p.gravity;
  EXPECT_NEAR((left.force + right.force - weight).norm() / weight.norm(), 0.0, 1e-3);
  EXPECT_NEAR(left.force.z() / right.force.z(), 1.0, 1e-3);
  // Torque about the left hold: the right one carries its part over the span.
  const Vector3 arm(0.0, 1.5, 0.0);
  Vector3 moment = left.torque + right.torque + arm.cross(right.force);
  for (const Vector3& x : positions(*rod)) {
    moment -= x.cross(p.segmentMass() * p.gravity);
  }
  EXPECT_LT(moment.norm(), 1e-3 * weight.norm() * 1.5);
}

INSTANTIATE_TEST_SUITE_P(BothSolvers, HangingRope,
                         testing::Values(Case{RodSolver::DIRECT, 5, 2e-3}, Case{RodSolver::GAUSS_SEIDEL, 20, 4e-3}),
                         [](const testing::TestParamInfo<Case>& info) {
                           return info.param.solver == RodSolver::DIRECT ? "direct" : "gaussSeidel";
                         });

TEST(Cantilever, bendsAsABeamUnderItsWeight) {
  RodParameters p = rope(50);
  p.young_modulus = 3e12;  // small deflection
  p.torsion_modulus = 1e12;
  Rod rod(p);
  rod.hold(0, Hold::CLAMPED);
  SettleOptions options = settling();
  options.speed_tolerance = 1e-7;
  ASSERT_TRUE(rod.settle(options));
  std::vector<double> points(3 * rod.pointCount());
  rod.points(points.data());

  const double free_length = p.length - 0.5 * p.segmentLength();  // from the centre of the held segment
  const double load = rod.mass() / p.length * 9.81;
  const double drop = load * std::pow(free_length, 4) / (8.0 * p.bendingStiffness());
  EXPECT_NEAR(-points.back() / drop, 1.0, 2e-3);
}

TEST(Cantilever, isStretchedByItsModulus) {
  RodParameters p = rope(40);
  p.stretch = Stretch::FROM_MODULI;
  p.pose.orientation = Quaternion(Eigen::AngleAxisd(M_PI / 2.0, Vector3::UnitY()));  // hangs down
  Rod rod(p);
  rod.hold(0, Hold::CLAMPED);
  SettleOptions options = settling();
  options.speed_tolerance = 1e-8;
  ASSERT_TRUE(rod.settle(options));
  std::vector<double> points(3 * rod.pointCount());
  rod.points(points.data());
  const double free_length = p.length - 0.5 * p.segmentLength();
  const double load = rod.mass() / p.length * 9.81;
  const double elongation = load * free_length * free_length / (2.0 * p.axialStiffness());
  EXPECT_NEAR((-points.back() - p.length) / elongation, 1.0, 0.02);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
