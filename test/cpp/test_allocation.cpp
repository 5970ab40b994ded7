// Nothing is allocated inside a step.

#include <gtest/gtest.h>

#include <string>

#include "allocations.h"
#include "fabric_fixture.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

long allocationsIn(Body& body, int substeps) {
  const long before = test::allocations();
  body.step(0.01, substeps);
  return test::allocations() - before;
}

TEST(Allocation, isCounted) {
  const long before = test::allocations();
  const auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  EXPECT_GT(test::allocations() - before, 10);
}

TEST(Allocation, doesNotHappenInAStep) {
  for (RodSolver solver : {RodSolver::DIRECT, RodSolver::GAUSS_SEIDEL}) {
    for (int threads : {1, 2}) {
      for (int copies : {1, 7, 13}) {
        RodParameters p = rope();
        p.solver = solver;
        p.threads = threads;
        const auto rod = hangingRope(p, 1.5, Hold::CLAMPED);
        for (int i = 1; i < copies; ++i) {
          rod->addCopy(27, Vector3(0.0, 0.0, 0.01 * i));
        }
        rod->setTwist(27, {Vector3(0.0, -0.1, 0.0), Vector3(0.0, 0.0, 0.1)});
        for (int substeps : {2, 50}) {
          EXPECT_EQ(allocationsIn(*rod, substeps), 0) << copies << " copies, " << threads << " threads";
        }
      }
    }
  }
}

TEST(Allocation, doesNotHappenInAStepOfAFreeRod) {
  Rod rod(rope());
  EXPECT_EQ(allocationsIn(rod, 2), 0);
}

TEST(Allocation, doesNotHappenInAStepOfAFabric) {
  for (int threads : {1, 2}) {
    for (int copies : {1, 13}) {
      FabricParameters p = cloth();
      p.vertices[20].z() += 0.1;  // not flat: free lengths go along the surface
      p.threads = threads;
      const auto fabric = hangingCloth(p);
      for (int i = 1; i < copies; ++i) {
        fabric->addCopy(224, Vector3(0.0, 0.0, 0.01 * i));
      }
      fabric->setTwist(224, {Vector3(0.0, -0.1, 0.0), Vector3::Zero()});
      for (int substeps : {2, 50}) {
        EXPECT_EQ(allocationsIn(*fabric, substeps), 0) << copies << " copies, " << threads << " threads";
      }
    }
  }
  Fabric free(cloth());
  EXPECT_EQ(allocationsIn(free, 2), 0);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
