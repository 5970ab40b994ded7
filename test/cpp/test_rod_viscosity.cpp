// Joints that resist the rate of bending and twisting.

#include <gtest/gtest.h>

#include <string>

#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

class Viscosity : public testing::TestWithParam<RodSolver> {
 protected:
  Viscosity() : parameters_(rope()) {
    parameters_.damping = 0.0;
    parameters_.solver = GetParam();
  }

  static void makeViscous(Rod& rod) {
    rod.setMaterial({{"bending_retardation_time", 0.1}, {"torsion_retardation_time", 0.1}});
  }

  RodParameters parameters_;
};

//! [m/s]
double fastest(const Rod& rod) {
  double highest = 0.0;
  for (const Vector3& v : velocities(rod)) {
    highest = std::max(highest, v.norm());
  }
  return highest;
}

TEST_P(Viscosity, leavesTheShapeAtRest) {
  auto rod = hangingRope(parameters_, 1.5, Hold::CLAMPED);
  ASSERT_TRUE(rod->settle(settling(20)));
  const auto before = rod->clone();
  makeViscous(*rod);
  for (int i = 0; i < 300; ++i) {
    rod->step(0.01, 20);
  }
  EXPECT_LT(difference(*rod, 0, *before, 0), 1e-4);
  ASSERT_TRUE(rod->settle(settling(20)));  // as if there were none
  EXPECT_LT(difference(*rod, 0, *before, 0), 1e-4);
  EXPECT_EQ(rod->parameters().bending_retardation_time, 0.1);
  EXPECT_EQ(rod->parameters().torsion_retardation_time, 0.1);
  EXPECT_EQ(rod->parameters().damping, 0.0);
}

TEST_P(Viscosity, takesTheEnergyOfVibrations) {
  auto rod = hangingRope(parameters_, 1.5, Hold::CLAMPED);
  ASSERT_TRUE(rod->settle(settling(20)));
  rod->setTwist(27, {Vector3(0.0, -0.5, 0.5), Vector3::Zero()});
  for (int i = 0; i < 20; ++i) {
    rod->step(0.01, 20);
  }
  rod->setTwist(27, Twist());
  auto viscous = rod->clone();
  makeViscous(static_cast<Rod&>(*viscous));
  for (int i = 0; i < 200; ++i) {
    rod->step(0.01, 20);
    viscous->step(0.01, 20);
  }
  EXPECT_LT(fastest(static_cast<Rod&>(*viscous)), 0.5 * fastest(*rod));
}

//! About the centre, without the spin of the segments [kg m^2/s].
Vector3 angularMomentum(const Rod& rod) {
  const std::vector<Vector3> x = positions(rod);
  const std::vector<Vector3> v = velocities(rod);
  Vector3 centre = Vector3::Zero();
  for (const Vector3& each : x) {
    centre += each / x.size();
  }
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += rod.parameters().segmentMass() * (x[i] - centre).cross(v[i]);
  }
  return sum;
}

TEST_P(Viscosity, doesNotResistRigidMotion) {
  parameters_.gravity.setZero();
  Rod rod(parameters_);
  makeViscous(rod);
  rod.hold(13, Hold::CLAMPED);
  rod.setTwist(13, {Vector3(0.1, 0.0, 0.0), Vector3(0.3, 0.0, 0.4)});
  for (int i = 0; i < 100; ++i) {
    rod.step(0.01, 20);
  }
  rod.release(13);
  const Vector3 before = angularMomentum(rod);
  for (int i = 0; i < 500; ++i) {
    rod.step(0.01, 20);
  }
  EXPECT_LT((angularMomentum(rod) - before).norm(), 0.02 * before.norm());
}

INSTANTIATE_TEST_SUITE_P(BothSolvers, Viscosity, testing::Values(RodSolver::DIRECT, RodSolver::GAUSS_SEIDEL),
                         [](const testing::TestParamInfo<RodSolver>& info) {
                           return info.param == RodSolver::DIRECT ? "direct" : "gaussSeidel";
                         });

TEST(Softness, isToldWhereTheSweepHasLessViscosity) {
  RodParameters p = rope();
  p.bending_retardation_time = 0.1;
  EXPECT_EQ(Rod(p).softness(0.01, 2), "");
  p.solver = RodSolver::GAUSS_SEIDEL;
  EXPECT_EQ(Rod(p).softness(0.01, 20), "");
  EXPECT_NE(Rod(p).softness(0.01, 2).find("object.bending_retardation_time"), std::string::npos);
}

TEST(Softness, isToldWhereTwistIsTooSlow) {
  RodParameters p = rope();
  EXPECT_EQ(Rod(p).softness(0.01, 1), "");
  p.torsion_modulus = 1e-3 * 0.5 * p.young_modulus;  // G J = 1e-3 E I
  const std::string words = Rod(p).softness(0.01, 2);
  EXPECT_NE(words.find("object.torsion_modulus"), std::string::npos);
  EXPECT_NE(words.find("simulation.substeps: 4"), std::string::npos) << words;
  EXPECT_EQ(Rod(p).softness(0.01, 4), "");
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
