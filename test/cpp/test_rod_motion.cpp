// Holding, carrying, letting go; energy.

#include <gtest/gtest.h>

#include <limits>
#include <tuple>

#include "deformable_manipulation/pbd/errors.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

TEST(Holds, followTheirPrescribedMotion) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  rod->setTwist(27, {Vector3(0.02, -0.1, 0.05), Vector3(0.3, 0.0, 0.0)});
  for (int i = 0; i < 100; ++i) {
    rod->step(0.01, 2);
  }
  EXPECT_LT((positions(*rod)[27] - Vector3(0.02, 1.4, 0.05)).norm(), 1e-12);
  EXPECT_LT((velocities(*rod)[27] - Vector3(0.02, -0.1, 0.05)).norm(), 1e-9);
  EXPECT_LT(positions(*rod)[0].norm(), 1e-12);
  std::vector<double> q(4 * 28);
  rod->orientations(0, q.data());
  const Quaternion expected = Quaternion(Eigen::AngleAxisd(0.3, Vector3::UnitX())) * rope().pose.orientation;
  EXPECT_LT(Eigen::Map<Eigen::Vector4d>(&q[4 * 27]).cwiseAbs().isApprox(expected.coeffs().cwiseAbs(), 1e-9) ? 0 : 1, 1);
}

TEST(Holds, leaveThePinnedOrientationFree) {
  auto clamped = hangingRope(rope(), 1.5, Hold::CLAMPED);
  auto pinned = hangingRope(rope(), 1.5, Hold::PINNED);
  clamped->settle(settling());
  pinned->settle(settling());
  EXPECT_LT(clamped->wrench(27).force.z(), 0.0);
  EXPECT_GT(clamped->wrench(27).torque.norm(), 1e-2);
  EXPECT_LT(pinned->wrench(27).torque.norm(), 1e-3);  // the overhanging half segment alone
}

TEST(Holds, includeAnyNumberOfInteriorSegments) {
  Rod rod(rope(45));
  const double l = rod.parameters().segmentLength();
  for (int particle : {0, 21, 22, 44}) {
    rod.hold(particle, particle == 44 ? Hold::PINNED : Hold::CLAMPED,
             gripAt(rod.parameters(), Vector3(0.0, 0.8 * l * particle, 0.0)));
  }
  rod.layOut();
  ASSERT_TRUE(rod.settle(settling()));
  rod.step(0.01, 2);
  double carried = 0.0;
  for (const HeldPoint& held : rod.holds()) {
    carried += rod.wrench(held.particle).force.z();
  }
  EXPECT_NEAR(carried, -9.81 * rod.mass(), 1e-3 * 9.81 * rod.mass());
}

TEST(Holds, canBeTakenAndReleasedWhileRunning) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  rod->settle(settling());
  const Vector3 before = positions(*rod)[13];
  rod->hold(13, Hold::PINNED);
  rod->release(27);
  for (int i = 0; i < 300; ++i) {
    rod->step(0.01, 2);
  }
  EXPECT_LT((positions(*rod)[13] - before).norm(), 1e-12);
  EXPECT_LT(positions(*rod)[27].z(), before.z());  // the free end has fallen
  rod->release(13);
  rod->release(0);
  const double height = positions(*rod)[13].z();
  for (int i = 0; i < 100; ++i) {
    rod->step(0.01, 2);
  }
  EXPECT_NEAR(positions(*rod)[13].z() - height, -0.5 * 9.81, 0.5);  // falls freely, damped in itself only
}

TEST(Holds, refuseWhatCannotBe) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  EXPECT_THROW(rod->hold(28, Hold::PINNED), std::out_of_range);
  EXPECT_THROW(rod->hold(-1, Hold::PINNED), std::out_of_range);
  EXPECT_THROW(rod->hold(0, Hold::PINNED), std::invalid_argument);
  EXPECT_THROW(rod->release(5), std::invalid_argument);
  EXPECT_THROW(rod->setTwist(5, Twist()), std::invalid_argument);
  EXPECT_THROW(rod->setTwist(0, {Vector3::Constant(NAN), Vector3::Zero()}), std::invalid_argument);
}

TEST(Damping, leavesACarriedRopeItsShape) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  rod->settle(settling());
  const std::vector<Vector3> before = positions(*rod);
  const Vector3 velocity(0.0, 0.1, 0.0);
  for (int particle : {0, 27}) {
    rod->setTwist(particle, {velocity, Vector3::Zero()});
  }
  for (int i = 0; i < 1000; ++i) {
    rod->step(0.01, 2);
  }
  const std::vector<Vector3> after = positions(*rod);
  for (int i = 0; i < 28; ++i) {
    EXPECT_LT((after[i] - before[i] - 10.0 * velocity).norm(), 1e-3) << "segment " << i;
  }
}

double energy(const Rod& rod) {
  const RodParameters& p = rod.parameters();
  const std::vector<Vector3> x = positions(rod);
  const std::vector<Vector3> v = velocities(rod);
  std::vector<double> q(4 * p.segments);
  rod.orientations(0, q.data());
  double sum = 0.0;
  for (int i = 0; i < p.segments; ++i) {
    sum += p.segmentMass() * (0.5 * v[i].squaredNorm() - p.gravity.dot(x[i]));
    if (i > 0) {
      const Quaternion a(Eigen::Map<const Eigen::Vector4d>(&q[4 * (i - 1)]));
      const Quaternion b(Eigen::Map<const Eigen::Vector4d>(&q[4 * i]));
      const double curvature = 2.0 / p.segmentLength() * (b * a.conjugate()).vec().norm();
      sum += 0.5 * p.segmentLength() * p.bendingStiffness() * curvature * curvature;
    }
  }
  return sum;
}

class Energy : public testing::TestWithParam<RodSolver> {};

TEST_P(Energy, doesNotGrowWithoutDamping) {
  RodParameters p = rope();
  p.damping = 0.0;
  p.solver = GetParam();
  Rod rod(p);
  rod.hold(0, Hold::PINNED);  // swings down from level
  const double start = energy(rod);
  const double scale = rod.mass() * 9.81 * p.length;
  for (int i = 0; i < 500; ++i) {
    rod.step(0.01, 10);
    ASSERT_LT(energy(rod), start + 1e-3 * scale) << "step " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(BothSolvers, Energy, testing::Values(RodSolver::DIRECT, RodSolver::GAUSS_SEIDEL),
                         [](const testing::TestParamInfo<RodSolver>& info) {
                           return info.param == RodSolver::DIRECT ? "direct" : "gaussSeidel";
                         });

TEST(FreeRod, fallsFreelyWhateverItsDamping) {
  for (int substeps : {1, 2, 10}) {
    Rod rod(rope());
    for (int i = 0; i < 100; ++i) {
      rod.step(0.01, substeps);
    }
    for (const Vector3& v : velocities(rod)) {
      EXPECT_NEAR((v - Vector3(0.0, 0.0, -9.81)).norm(), 0.0, 1e-9) << substeps << " substeps";
    }
  }
}

TEST(Settling, waitsUntilNothingTurns) {
  RodParameters p = rope();
  p.gravity.setZero();
  Rod rod(p);
  const Vector3 axis = Vector3::UnitY();
  rod.hold(0, Hold::CLAMPED);
  rod.hold(27, Hold::CLAMPED);
  rod.setTwist(27, {Vector3::Zero(), 0.5 * axis});
  for (int i = 0; i < 200; ++i) {
    rod.step(0.01, 2);  // to 1 rad
  }
  SettleOptions options = settling();
  options.speed_tolerance = 1e-9;
  ASSERT_TRUE(rod.settle(options));
  rod.step(0.01, 2);
  // The free length is that from grip to grip.
  const double expected = p.torsionStiffness() / p.segmentLength() / 27.0;
  EXPECT_NEAR(rod.wrench(27).torque.dot(axis) / -expected, 1.0, 1e-6);
}

//! A straight rope in weightlessness, clamped at both ends.
class Twisted : public testing::TestWithParam<RodSolver> {
 protected:
  Twisted() : parameters_(rope()) {
    parameters_.gravity.setZero();
    parameters_.solver = GetParam();
    rod_ = std::make_unique<Rod>(parameters_);
    rod_->hold(0, Hold::CLAMPED);
    rod_->hold(27, Hold::CLAMPED);
  }

  void turn(double turns) {
    constexpr double kSpeed = 2.0 * M_PI;  // rad/s
    rod_->setTwist(27, {Vector3::Zero(), std::copysign(kSpeed, turns) * Vector3::UnitY()});
    advance(static_cast<int>(std::lround(100.0 * std::abs(turns))));
    rod_->setTwist(27, Twist());
    advance(100);
  }

  //! As a part of linear theory's for one turn.
  double torque() const {
    const double per_turn = parameters_.torsionStiffness() / (27.0 * parameters_.segmentLength()) * 2.0 * M_PI;
    return -rod_->wrench(27).torque.y() / per_turn;
  }

  RodParameters parameters_;
  std::unique_ptr<Rod> rod_;

 private:
  void advance(int steps) {
    for (int i = 0; i < steps; ++i) {
      rod_->step(0.01, GetParam() == RodSolver::DIRECT ? 2 : 40);
    }
  }
};

TEST_P(Twisted, resistsInProportionToItsTurns) {
  // A joint is twisted by 0.07 and 1.6 rad, by just less and just more than half a turn, and by 260 degrees.
  const double soft = GetParam() == RodSolver::DIRECT ? 1e-3 : 0.06;  // the sweep's own softness
  double before = 0.0;
  for (double turns : {0.3, 7.0, 13.4, 13.6, 20.0, -20.0, 0.0}) {
    turn(turns - before);
    EXPECT_NEAR(torque(), turns, soft * std::max(std::abs(turns), 0.01)) << turns << " turns";
    before = turns;
  }
}

TEST_P(Twisted, slipsBeyondATurnPerJoint) {
  turn(30.0);
  EXPECT_LT(std::abs(torque()), 27.0);
}

TEST_P(Twisted, countsTheTurnsOfEachCopy) {
  turn(20.0);
  rod_->addCopy(27, Vector3(0.0, -0.01, 0.0));
  rod_->addCopy(27, Vector3(0.0, -0.02, 0.0));
  ASSERT_TRUE(rod_->settle(settling(GetParam() == RodSolver::DIRECT ? 2 : 40)));
  std::vector<double> twists(27);
  for (int copy = 0; copy < 3; ++copy) {
    rod_->twists(copy, twists.data());
    for (double twist : twists) {
      EXPECT_NEAR(twist, 2.0 * M_PI * 20.0 / 27.0, 0.3) << "copy " << copy;
    }
  }
}

TEST_P(Twisted, forgetsItsTurnsWhereItIsLaidOut) {
  turn(20.0);
  rod_->layOut();
  rod_->step(0.01, 2);
  std::vector<double> twists(27);
  rod_->twists(0, twists.data());
  for (double twist : twists) {
    EXPECT_LT(std::abs(twist), M_PI);
  }
}

INSTANTIATE_TEST_SUITE_P(BothSolvers, Twisted, testing::Values(RodSolver::DIRECT, RodSolver::GAUSS_SEIDEL),
                         [](const testing::TestParamInfo<RodSolver>& info) {
                           return info.param == RodSolver::DIRECT ? "direct" : "gaussSeidel";
                         });

TEST(Fold, leavesNoTwistBehind) {
  // Two links, the second of which turns all the way round in a plane, through the first.
  RodParameters p = rope(2);
  p.gravity.setZero();
  Rod rod(p);
  rod.hold(0, Hold::CLAMPED);
  rod.hold(1, Hold::CLAMPED);
  rod.setTwist(1, {Vector3::Zero(), 2.02 * M_PI * Vector3::UnitX()});  // never just in the fold
  double twist = 1.0;
  for (int i = 0; i < 100; ++i) {
    rod.step(0.01, 2);
    rod.twists(0, &twist);
    ASSERT_NEAR(twist, 0.0, 1e-6) << "step " << i;
  }
}

//! A rope drawn taut, a little farther than it reaches, and slack again.
class TautRope : public testing::TestWithParam<std::tuple<int, int, Hold>> {};

TEST_P(TautRope, restsAndRecovers) {
  const auto [segments, substeps, hold] = GetParam();
  const RodParameters p = rope(segments);
  const double reach = p.length - p.segmentLength();
  auto rod = hangingRope(p, 0.9 * reach, hold);
  ASSERT_TRUE(rod->settle(settling()));
  const auto draw = [&rod, &p, n = substeps](double speed, int steps) {
    rod->setTwist(p.segments - 1, {Vector3(0.0, speed, 0.0), Vector3::Zero()});
    for (int i = 0; i < steps; ++i) {
      rod->step(0.01, n);
    }
  };
  const auto fastest = [&rod] {
    double highest = 0.0;
    for (const Vector3& v : velocities(*rod)) {
      highest = std::max(highest, v.norm());
    }
    return highest;
  };
  draw(0.15 * reach, 100);  // to 1.05 of its reach
  draw(0.0, 100);
  EXPECT_LT(fastest(), 0.01);
  draw(-0.35 * reach, 100);
  draw(0.0, 500);
  EXPECT_LT(fastest(), 1e-6);
  EXPECT_LT(std::abs(rod->stretch()), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Resolutions, TautRope,
                         testing::Combine(testing::Values(28, 100), testing::Values(2, 10),
                                          testing::Values(Hold::CLAMPED, Hold::PINNED)));

TEST(FreeRod, keepsItsMomentum) {
  RodParameters p = rope();
  p.gravity.setZero();
  p.damping = 5.0;
  Rod rod(p);
  rod.hold(5, Hold::CLAMPED);
  rod.setTwist(5, {Vector3(0.3, 0.0, 0.2), Vector3(0.0, 0.5, 1.0)});
  for (int i = 0; i < 50; ++i) {
    rod.step(0.01, 5);
  }
  rod.release(5);
  const auto momentum = [&] {
    Vector3 linear = Vector3::Zero();
    for (const Vector3& v : velocities(rod)) {
      linear += p.segmentMass() * v;
    }
    return linear;
  };
  const Vector3 before = momentum();
  for (int i = 0; i < 200; ++i) {
    rod.step(0.01, 5);
  }
  EXPECT_LT((momentum() - before).norm(), 1e-9 * before.norm());
}

TEST(Steps, areRefusedWhereTheyCannotBe) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  const std::vector<Vector3> before = positions(*rod);
  for (double time_step : {0.0, -0.01, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(rod->step(time_step, 2), std::invalid_argument);
    EXPECT_THROW(rod->settle({time_step, 2, 1e-4, 60.0}), std::invalid_argument);
  }
  EXPECT_THROW(rod->settle({0.01, 0, 1e-4, 60.0}), std::invalid_argument);
  EXPECT_THROW(rod->settle({0.01, 2, std::nan(""), 60.0}), std::invalid_argument);
  EXPECT_THROW(rod->settle({0.01, 2, 1e-4, -1.0}), std::invalid_argument);
  try {
    rod->step(-0.01, 0);
    FAIL() << "no exception";
  } catch (const ParameterError& error) {
    EXPECT_STREQ(error.what(),
                 "time_step: -0.01 - must be a finite number > 0 [s]\nsubsteps: 0 - must be a whole number >= 1");
  }
  EXPECT_EQ(positions(*rod), before);
}

TEST(State, thatIsNotFiniteIsReported) {
  RodParameters p = rope();
  p.gravity = Vector3(0.0, 0.0, -1e300);
  Rod rod(p);
  rod.hold(0, Hold::CLAMPED);
  try {
    for (int i = 0; i < 1000; ++i) {
      rod.step(10.0, 1);
    }
    FAIL() << "no exception";
  } catch (const NonFiniteState& error) {
    EXPECT_EQ(error.copy, 0);
    EXPECT_GE(error.particle, 0);
    EXPECT_GE(error.step, 1);
  }
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
