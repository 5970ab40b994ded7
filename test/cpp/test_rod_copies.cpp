// Perturbed copies.

#include <gtest/gtest.h>

#include <cmath>

#include "../../src/pbd/rod_kernel.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

TEST(Copies, equalSeparateRuns) {
  const RodParameters p = rope();
  auto together = hangingRope(p, 1.5, Hold::CLAMPED);
  std::vector<std::unique_ptr<Rod>> separate;
  for (int i = 0; i < 12; ++i) {  // more than one group of lanes
    const Vector3 displacement(0.01 * std::cos(i), 0.03 * std::sin(i), 0.02 + 0.005 * i);
    together->addCopy(27, displacement);
    separate.push_back(hangingRope(p, 1.5, Hold::CLAMPED));
    separate.back()->addCopy(27, displacement);
  }
  const Twist twist{Vector3(0.0, -0.1, 0.1), Vector3::Zero()};
  together->setTwist(27, twist);
  for (auto& rod : separate) {
    rod->setTwist(27, twist);
  }
  for (int step = 0; step < 100; ++step) {
    together->step(0.01, 3);
    for (auto& rod : separate) {
      rod->step(0.01, 3);
    }
  }
  for (int i = 0; i < 12; ++i) {
    EXPECT_LT(difference(*together, i + 1, *separate[i], 1), 1e-12) << "copy " << i + 1;
  }
}

TEST(Copies, areTheObjectWithADisplacedHold) {
  const RodParameters p = rope();
  const Vector3 displacement(0.0, -0.1, 0.05);
  auto rod = hangingRope(p, 1.5, Hold::CLAMPED);
  rod->addCopy(27, displacement);
  ASSERT_TRUE(rod->settle(SettleOptions()));
  Rod displaced(p);
  displaced.hold(0, Hold::CLAMPED, gripAt(p, Vector3::Zero()));
  displaced.hold(27, Hold::CLAMPED, gripAt(p, Vector3(0.0, 1.5, 0.0) + displacement));
  displaced.layOut();
  ASSERT_TRUE(displaced.settle(SettleOptions()));
  EXPECT_LT(difference(*rod, 1, displaced, 0), 1e-4);
}

TEST(Copies, startWithoutAJump) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  rod->settle(SettleOptions());
  rod->addCopy(27, Vector3(0.0, 0.0, 0.1));
  EXPECT_EQ(difference(*rod, 0, *rod, 1), 0.0);
  double last = 0.0;
  for (int i = 0; i < 100; ++i) {
    rod->step(0.01, 2);
    const double now = difference(*rod, 0, *rod, 1);
    EXPECT_LT(now - last, 0.03) << "step " << i;
    last = now;
  }
  EXPECT_TRUE(rod->copies()[0].ready());
  EXPECT_NEAR((positions(*rod, 1)[27] - positions(*rod, 0)[27]).z(), 0.1, 1e-12);
}

TEST(Copies, canBeAddedAndRemovedWhileRunning) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  std::vector<int> ids;
  for (int i = 0; i < 9; ++i) {
    ids.push_back(rod->addCopy(i % 2 ? 27 : 0, Vector3(0.0, 0.0, 0.01 * (i + 1))));
  }
  rod->settle(SettleOptions());
  const std::vector<Vector3> fourth = positions(*rod, 4);
  const std::vector<Vector3> ninth = positions(*rod, 9);
  rod->removeCopy(ids[1]);
  EXPECT_EQ(rod->copyCount(), 9);
  EXPECT_EQ(positions(*rod, 3), fourth);
  EXPECT_EQ(positions(*rod, 8), ninth);
  EXPECT_THROW(rod->removeCopy(ids[1]), std::invalid_argument);
  rod->release(27);
  for (const PerturbedCopy& copy : rod->copies()) {
    EXPECT_EQ(copy.particle, 0);
  }
}

TEST(Copies, turnRoundWhereTheyWouldBeOutOfReach) {
  const RodParameters p = rope();
  const double reach = p.segmentLength() * 27;
  auto rod = hangingRope(p, reach - 0.15, Hold::CLAMPED);
  rod->addCopy(27, Vector3(0.0, 0.1, 0.0));
  rod->settle(SettleOptions());
  EXPECT_GT(rod->copies()[0].present.y(), 0.0);
  rod->setTwist(27, {Vector3(0.0, 0.1, 0.0), Vector3::Zero()});
  for (int i = 0; i < 90; ++i) {
    rod->step(0.01, 2);
  }
  rod->setTwist(27, Twist());
  for (int i = 0; i < 100; ++i) {
    rod->step(0.01, 2);
  }
  EXPECT_NEAR(rod->copies()[0].present.y(), -0.1, 1e-12);
  EXPECT_TRUE(rod->copies()[0].ready());
  rod->setTwist(27, {Vector3(0.0, -0.1, 0.0), Vector3::Zero()});
  for (int i = 0; i < 200; ++i) {
    rod->step(0.01, 2);
  }
  EXPECT_NEAR(rod->copies()[0].present.y(), 0.1, 1e-12);
}

TEST(Copies, refuseWhatCannotBe) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  EXPECT_THROW(rod->addCopy(5, Vector3(0.0, 0.0, 0.1)), std::invalid_argument);
  EXPECT_THROW(rod->addCopy(27, Vector3::Zero()), std::invalid_argument);
  EXPECT_THROW(rod->addCopy(27, Vector3(0.0, NAN, 0.0)), std::invalid_argument);
  EXPECT_THROW(rod->addCopy(27, Vector3(0.0, 0.0, 100.0)), std::invalid_argument);
}

TEST(Kernels, agreeForEveryInstructionSet) {
  const std::vector<RodKernel> kernels = availableRodKernels();
  for (bool direct : {false, true}) {
    std::vector<RodLanes> results;
    for (const RodKernel& kernel : kernels) {
      constexpr int n = 12;
      RodLanes lanes(n);
      for (int i = 0; i < n; ++i) {
        for (int lane = 0; lane < kLanes; ++lane) {
          lanes.position[(3 * i) * kLanes + lane] = 0.1 * i;
          lanes.position[(3 * i + 2) * kLanes + lane] = 0.01 * lane * std::sin(i);
          lanes.velocity[(3 * i + 1) * kLanes + lane] = 0.1 * std::cos(i + lane);
          lanes.angular_velocity[(3 * i + 1) * kLanes + lane] = std::sin(3 * i);
          lanes.orientation[(4 * i + 3) * kLanes + lane] = 1.0;
        }
      }
      std::vector<double> inverse_mass(n, 200.0), transverse(n, 3e5), axial(n, 3e7), zero(3 * n, 0.0);
      std::vector<unsigned char> active(n - 1, 1);
      AlignedArray workspace(rodWorkspaceSize(n));
      HeldSegment held{};
      inverse_mass[0] = transverse[0] = axial[0] = 0.0;
      held.clamped = true;
      held.orientation[3] = 1.0;
      RodSubstepInput in{};
      in.segments = n;
      in.h = 0.002;
      in.segment_length = 0.1;
      in.gravity[2] = -9.81;
      in.velocity_decay = 0.99;
      in.inertia_ratio = -0.99;
      in.bending_compliance = 1.0 / (0.1 * 0.01 * in.h * in.h);
      in.torsion_compliance = in.bending_compliance;
      in.floor_compliance = 1e-6;
      in.inverse_mass = inverse_mass.data();
      in.inverse_transverse = transverse.data();
      in.inverse_axial = axial.data();
      in.joint_active = active.data();
      in.reference_velocity = in.reference_angular_velocity = zero.data();
      in.held = &held;
      in.held_count = 1;
      in.workspace = workspace.data();
      for (int step = 0; step < 50; ++step) {
        (direct ? kernel.direct : kernel.gauss_seidel)(in, lanes);
      }
      results.push_back(lanes);
    }
    for (std::size_t k = 1; k < results.size(); ++k) {
      for (std::size_t i = 0; i < results[k].position.size(); ++i) {
        ASSERT_NEAR(results[k].position[i], results[0].position[i], 1e-9) << kernels[k].instruction_set;
      }
    }
    EXPECT_GT(std::abs(results[0].position[(3 * 11 + 2) * kLanes]), 1e-3);  // something has moved
  }
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
