// The kernels of the fabric compiled for several instruction sets.

#include <gtest/gtest.h>

#include <cmath>

#include "../../src/pbd/fabric_constraints.h"
#include "fabric_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

constexpr int kSubsteps = 16;

//! A fabric of eight different shapes, held at two corners that approach each other.
class FabricRun {
 public:
  FabricRun()
      : parameters_(sheet(7, 5, 0.1)),
        constraints_(parameters_.vertices, meshEdges(parameters_.vertices, parameters_.triangles)),
        inverse_mass_(35, 100.0),
        decay_(35, 0.99),
        carried_(3 * 35, 1e-3),
        held_(2 * kSubsteps),
        recorded_(constraints_.recordedSize()) {
    inverse_mass_[0] = inverse_mass_[6] = 0.0;
    constraints_.update(inverse_mass_, 1e-4, 1e2, 10.0, kStep);
  }

  FabricLanes run(const FabricKernel& kernel, int copies) {
    FabricLanes lanes(35, static_cast<int>(constraints_.hinges().size() + constraints_.boundaries().size()));
    constraints_.restLengths(lanes.rest_length);
    for (int i = 0; i < 35; ++i) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const Vector3 bump(0.0, 0.0, 0.003 * lane * std::sin(i));
        write3(lanes.position, i, lane, parameters_.vertices[i] + bump);
        write3(lanes.velocity, i, lane, Vector3(0.0, 0.1 * std::cos(i + lane), 0.0));
      }
    }
    for (int call = 0; call < 20; ++call) {
      noteHeld(call);
      kernel.advance(input(), copies, kSubsteps, lanes);
    }
    return lanes;
  }

  const AlignedArray& recorded() const { return recorded_; }

 private:
  static constexpr double kStep = 0.001;

  void noteHeld(int call) {
    for (int substep = 0; substep < kSubsteps; ++substep) {
      for (int i = 0; i < 2; ++i) {
        HeldVertex& held = held_[2 * substep + i];
        held.vertex = 6 * i;
        for (int lane = 0; lane < kLanes; ++lane) {
          held.position[lane] = 0.6 * i * (1.0 - 1e-3 * (call * kSubsteps + substep));
          held.position[kLanes + lane] = 0.0;
          held.position[2 * kLanes + lane] = 0.003 * lane * std::sin(6 * i);
        }
      }
    }
  }

  FabricInput input() {
    FabricInput in{};
    in.vertices = 35;
    in.h = kStep;
    in.gravity[2] = -9.81;
    in.decay = decay_.data();
    in.carried = carried_.data();
    in.carried_change[1] = 1e-4;
    in.hinges = constraints_.hinges().data();
    in.hinge_count = static_cast<int>(constraints_.hinges().size());
    in.boundaries = constraints_.boundaries().data();
    in.boundary_count = static_cast<int>(constraints_.boundaries().size());
    in.held = held_.data();
    in.held_count = 2;
    in.held_stride = 2;
    in.adaptation = 0.05;
    in.recorded = recorded_.data();
    return in;
  }

  FabricParameters parameters_;
  FabricConstraints constraints_;
  std::vector<double> inverse_mass_, decay_, carried_;
  std::vector<HeldVertex> held_;
  AlignedArray recorded_;
};

void expectNear(const AlignedArray& a, const AlignedArray& b, double tolerance, const std::string& what) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(a[i], b[i], tolerance) << what << " " << i;
  }
}

TEST(FabricConstraints, aHingeWaitsForTheOneBeforeIfThatMovesItsEdge) {
  const FabricParameters p = cloth();
  const FabricConstraints constraints(p.vertices, meshEdges(p.vertices, p.triangles));
  const std::vector<HingeConstraint>& hinges = constraints.hinges();
  int waiting = 0;
  for (std::size_t i = 1; i < hinges.size(); ++i) {
    bool moved = false;
    for (int at : hinges[i - 1].at) {
      moved = moved || at == hinges[i].at[0] || at == hinges[i].at[1];
    }
    EXPECT_EQ(hinges[i].waits, moved) << i;
    waiting += moved ? 1 : 0;
  }
  EXPECT_TRUE(hinges.front().waits);
  EXPECT_LT(waiting, 10);
}

TEST(FabricKernels, agreeForEveryInstructionSet) {
  const std::vector<FabricKernel> kernels = availableFabricKernels();
  FabricRun reference;
  const FabricLanes expected = reference.run(kernels[0], kLanes);
  EXPECT_LT(expected.position[(3 * 17 + 2) * kLanes], -0.05);  // the middle has come down
  for (const FabricKernel& kernel : kernels) {
    FabricRun run;
    const FabricLanes lanes = run.run(kernel, kLanes);
    expectNear(lanes.position, expected.position, 1e-9, kernel.instruction_set + std::string(" position"));
    expectNear(lanes.velocity, expected.velocity, 1e-6, kernel.instruction_set + std::string(" velocity"));
    expectNear(run.recorded(), reference.recorded(), 1e-9, kernel.instruction_set + std::string(" recorded"));
  }
}

TEST(FabricKernels, doNotMixCopies) {
  for (const FabricKernel& kernel : availableFabricKernels()) {
    const FabricLanes all = FabricRun().run(kernel, kLanes);
    for (int copies = 1; copies < kLanes; ++copies) {
      const FabricLanes some = FabricRun().run(kernel, copies);
      for (std::size_t i = 0; i < all.position.size(); ++i) {
        ASSERT_TRUE(std::isfinite(some.position[i]));
        if (static_cast<int>(i % kLanes) < copies) {
          ASSERT_EQ(some.position[i], all.position[i]) << kernel.instruction_set << " " << copies << " copies";
        }
      }
    }
  }
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
