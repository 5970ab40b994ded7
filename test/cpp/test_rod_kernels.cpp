// The kernels compiled for several instruction sets.

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "../../src/pbd/rod_kernel.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

constexpr int kSegments = 12;
constexpr double kMass = 0.005;
constexpr double kTransverse = 3e-6;
constexpr double kAxial = 3e-8;

//! A rod of eight different shapes, clamped at its first segment and pinned at its last.
class RodInput {
 public:
  RodInput(bool viscous, bool natural) {
    inverse_mass_.front() = inverse_mass_.back() = 0.0;
    inverse_transverse_.front() = inverse_axial_.front() = 0.0;
    transverse_inertia_.front() = 1e30 * kTransverse;
    inertia_excess_.front() = 0.0;
    held_[0].clamped = true;
    held_[0].orientation[3] = 1.0;
    held_[1].segment = kSegments - 1;
    in_.segments = kSegments;
    in_.h = 0.002;
    in_.segment_length = 0.1;
    in_.gravity[2] = -9.81;
    in_.inertia_ratio = ratio_.data();
    drag_.assign(kSegments, viscous ? 0.5 : 0.0);
    in_.drag = drag_.data();
    in_.weight_moment = zero_.data();
    in_.arm_before = before_.data();
    in_.arm_after = after_.data();
    in_.plain = !natural;
    if (natural) {
      describeNaturalShape();
    }
    in_.viscous = viscous;
    for (int j = 0; j + 1 < kSegments; ++j) {
      describeJoint(j, viscous, natural && j < 3 ? 0.6 : 1.0);
    }
    in_.joints = joints_.data();
    in_.floor_compliance = 1e-6;
    in_.inverse_mass = inverse_mass_.data();
    in_.inverse_transverse = inverse_transverse_.data();
    in_.inverse_axial = inverse_axial_.data();
    in_.transverse_inertia = transverse_inertia_.data();
    in_.inertia_excess = inertia_excess_.data();
    in_.joint_active = active_.data();
    in_.linear_rate = in_.angular_rate = rate_.data();
    in_.reference_velocity = in_.reference_angular_velocity = zero_.data();
    in_.held = held_;
    in_.held_count = 2;
    in_.workspace = workspace_.data();
  }

  //! The input of a substep, in the course of which the ends approach each other.
  const RodSubstepInput& at(int substep) {
    for (int lane = 0; lane < kLanes; ++lane) {
      held_[1].position[lane] = 0.1 * (kSegments - 1) - 5e-4 * substep;
      held_[1].position[kLanes + lane] = 2e-5 * lane * substep;
    }
    return in_;
  }

 private:
  //! @param share of a segment's length over which it bends
  void describeJoint(int j, bool viscous, double share) {
    const double h2 = in_.h * in_.h;
    JointStiffness& joint = joints_[j];
    joint.bending_stiffness = 0.03 * h2 / (share * in_.segment_length);
    joint.torsion_stiffness = 0.02 * h2 / (share * in_.segment_length);
    joint.bending_viscosity = joint.torsion_viscosity = 3.0 * joint.bending_stiffness;
    joint.bending_elasticity = joint.torsion_elasticity = viscous ? 0.25 : 1.0;
    joint.bending_compliance = joint.bending_elasticity / joint.bending_stiffness;
    joint.torsion_compliance = joint.torsion_elasticity / joint.torsion_stiffness;
    joint.axial_compliance = 1e-3;
  }

  //! Bent and twisted by nature, with a heavy segment in the middle.
  void describeNaturalShape() {
    before_[6] = 0.0505;
    after_[6] = 0.0495;
    inverse_mass_[6] *= 0.3;
    for (int j = 0; j + 1 < kSegments; ++j) {
      ahead_.insert(ahead_.end(), {std::cos(0.03), std::sin(0.03), 0.0});
      behind_.insert(behind_.end(),
                     {std::cos(0.03), -std::sin(0.03) * std::cos(0.02), std::sin(0.03) * std::sin(0.02)});
    }
    in_.natural_ahead = ahead_.data();
    in_.natural_behind = behind_.data();
    in_.natural_twist = natural_twist_.data();
    in_.bending_over_torsion = 1.5;
  }

  std::vector<double> ahead_, behind_;
  std::vector<double> natural_twist_ = std::vector<double>(kSegments - 1, 0.02);
  std::vector<double> inverse_mass_ = std::vector<double>(kSegments, 1.0 / kMass);
  std::vector<double> inverse_transverse_ = std::vector<double>(kSegments, 1.0 / kTransverse);
  std::vector<double> inverse_axial_ = std::vector<double>(kSegments, 1.0 / kAxial);
  std::vector<double> transverse_inertia_ = std::vector<double>(kSegments, kTransverse);
  std::vector<double> inertia_excess_ = std::vector<double>(kSegments, kAxial - kTransverse);
  std::vector<double> ratio_ = std::vector<double>(kSegments, kAxial / kTransverse - 1.0);
  std::vector<double> before_ = std::vector<double>(kSegments, 0.05);
  std::vector<double> after_ = std::vector<double>(kSegments, 0.05);
  std::vector<double> drag_;
  std::vector<double> rate_ = std::vector<double>(kSegments, 0.95 / 0.002);
  std::vector<double> zero_ = std::vector<double>(3 * kSegments, 0.0);
  std::vector<unsigned char> active_ = std::vector<unsigned char>(kSegments - 1, 1);
  AlignedArray workspace_ = AlignedArray(rodWorkspaceSize(kSegments));
  HeldSegment held_[2] = {};
  std::vector<JointStiffness> joints_ = std::vector<JointStiffness>(kSegments - 1);
  RodSubstepInput in_{};
};

RodLanes startingLanes() {
  RodLanes lanes(kSegments);
  for (int i = 0; i < kSegments; ++i) {
    for (int lane = 0; lane < kLanes; ++lane) {
      lanes.position[(3 * i) * kLanes + lane] = 0.1 * i;
      lanes.position[(3 * i + 2) * kLanes + lane] = 0.001 * lane * std::sin(i);
      lanes.velocity[(3 * i + 1) * kLanes + lane] = 0.1 * std::cos(i + lane);
      lanes.angular_velocity[(3 * i + 1) * kLanes + lane] = std::sin(3 * i);
      lanes.orientation[(4 * i + 3) * kLanes + lane] = 1.0;
    }
  }
  return lanes;
}

void expectNear(const AlignedArray& a, const AlignedArray& b, double tolerance, const std::string& what) {
  double scale = 0.0;
  for (double value : b) {
    scale = std::max(scale, std::abs(value));
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(a[i], b[i], tolerance * scale) << what << " " << i;
  }
}

class Kernels : public testing::TestWithParam<std::tuple<RodSubstep RodKernel::*, bool, bool>> {
 protected:
  static RodLanes run(const RodKernel& kernel, int copies) {
    const auto [substep_of, viscous, natural] = GetParam();
    RodInput rod(viscous, natural);
    RodLanes lanes = startingLanes();
    const int substeps = natural ? 30 : 400;  // where curvature lets it snap aside, rounding soon decides how
    for (int substep = 0; substep < substeps; ++substep) {
      (kernel.*substep_of)(rod.at(substep), copies, lanes);
    }
    return lanes;
  }
};

TEST_P(Kernels, agreeForEveryInstructionSet) {
  const std::vector<RodKernel> kernels = availableRodKernels();
  const RodLanes expected = run(kernels[0], kLanes);
  if (!std::get<2>(GetParam())) {
    EXPECT_LT(expected.position[(3 * 6 + 2) * kLanes], -0.05);  // the middle has come down
  }
  for (const RodKernel& kernel : kernels) {
    const RodLanes lanes = run(kernel, kLanes);
    expectNear(lanes.position, expected.position, 1e-9, kernel.instruction_set + std::string(" position"));
    expectNear(lanes.orientation, expected.orientation, 1e-9, kernel.instruction_set + std::string(" orientation"));
    expectNear(lanes.velocity, expected.velocity, 1e-7, kernel.instruction_set + std::string(" velocity"));
    expectNear(lanes.twist, expected.twist, 1e-7, kernel.instruction_set + std::string(" twist"));
    expectNear(lanes.multiplier, expected.multiplier, 1e-7, kernel.instruction_set + std::string(" multiplier"));
  }
}

TEST_P(Kernels, leaveTheOtherLanesOfTheirPacksFinite) {
  for (const RodKernel& kernel : availableRodKernels()) {
    const RodLanes all = run(kernel, kLanes);
    for (int copies = 1; copies < kLanes; ++copies) {
      const RodLanes some = run(kernel, copies);
      for (std::size_t i = 0; i < all.position.size(); ++i) {
        ASSERT_TRUE(std::isfinite(some.position[i]));
        if (static_cast<int>(i % kLanes) < copies) {
          ASSERT_EQ(some.position[i], all.position[i]) << kernel.instruction_set << " " << copies << " copies";
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothSolvers, Kernels,
                         testing::Combine(testing::Values(&RodKernel::direct, &RodKernel::gauss_seidel),
                                          testing::Bool(), testing::Bool()),
                         [](const testing::TestParamInfo<Kernels::ParamType>& info) {
                           const bool direct = std::get<0>(info.param) == &RodKernel::direct;
                           return std::string(direct ? "direct" : "gauss_seidel") +
                                  (std::get<1>(info.param) ? "_viscous" : "") +
                                  (std::get<2>(info.param) ? "_natural" : "");
                         });

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
