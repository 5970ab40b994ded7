// Perturbed copies.

#include <gtest/gtest.h>

#include <cmath>

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
  ASSERT_TRUE(rod->settle(settling()));
  Rod displaced(p);
  displaced.hold(0, Hold::CLAMPED, gripAt(p, Vector3::Zero()));
  displaced.hold(27, Hold::CLAMPED, gripAt(p, Vector3(0.0, 1.5, 0.0) + displacement));
  displaced.layOut();
  ASSERT_TRUE(displaced.settle(settling()));
  EXPECT_LT(difference(*rod, 1, displaced, 0), 1e-4);
}

TEST(Copies, startWithoutAJump) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  rod->settle(settling());
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
  rod->settle(settling());
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
  rod->settle(settling());
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

TEST(Copies, areTheSameForAnyNumberOfThreads) {
  for (RodSolver solver : {RodSolver::DIRECT, RodSolver::GAUSS_SEIDEL}) {
    std::vector<std::unique_ptr<Rod>> rods;
    for (int threads : {1, 3}) {
      RodParameters p = rope();
      p.solver = solver;
      p.threads = threads;
      rods.push_back(hangingRope(p, 1.5, Hold::CLAMPED));
      for (int i = 0; i < 20; ++i) {  // three groups of lanes
        rods.back()->addCopy(27, Vector3(0.01 * std::cos(i), 0.03 * std::sin(i), 0.02 + 0.005 * i));
      }
      rods.back()->setTwist(27, {Vector3(0.0, -0.1, 0.1), Vector3(0.0, 0.2, 0.0)});
      for (int step = 0; step < 20; ++step) {
        rods.back()->step(0.01, 37);  // more substeps than are done at once
      }
    }
    for (int copy = 0; copy <= 20; ++copy) {
      EXPECT_EQ(positions(*rods[0], copy), positions(*rods[1], copy)) << "copy " << copy;
    }
  }
}

TEST(Copies, goOnByThemselvesInAClone) {
  RodParameters p = rope();
  p.threads = 2;  // shared with the clone
  auto rod = hangingRope(p, 1.5, Hold::CLAMPED);
  for (int i = 0; i < 9; ++i) {
    rod->addCopy(27, Vector3(0.0, 0.0, 0.01 * (i + 1)));
  }
  rod->step(0.01, 2);
  const std::unique_ptr<Body> clone = rod->clone();
  rod->step(0.01, 2);
  rod.reset();
  clone->step(0.01, 2);
  EXPECT_EQ(clone->copyCount(), 10);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
