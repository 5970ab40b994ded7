#pragma once

#include <cstddef>
#include <vector>

#include "lanes.h"

namespace deformable_manipulation {
namespace pbd {

//! State of eight copies of a rod. Layout: [segment or joint][component][lane].
struct RodLanes {
  explicit RodLanes(int segments);

  AlignedArray position;              // [N x 3] m, segment centres
  AlignedArray previous_position;     // [N x 3]
  AlignedArray velocity;              // [N x 3] m/s
  AlignedArray orientation;           // [N x 4] quaternion x y z w
  AlignedArray previous_orientation;  // [N x 4]
  AlignedArray angular_velocity;      // [N x 3] rad/s, fixed frame
  AlignedArray multiplier;            // [(N - 1) x 6] force and torque of the second segment on the first, times h^2
  AlignedArray twist;                 // [N - 1] rad, of each joint, up to a turn

  static constexpr AlignedArray RodLanes::*kArrays[] = {&RodLanes::position,
                                                        &RodLanes::previous_position,
                                                        &RodLanes::velocity,
                                                        &RodLanes::orientation,
                                                        &RodLanes::previous_orientation,
                                                        &RodLanes::angular_velocity,
                                                        &RodLanes::multiplier,
                                                        &RodLanes::twist};
};

//! A held segment during one substep.
struct HeldSegment {
  alignas(64) double position[3 * kLanes];  // m, at the end of the substep, one per lane
  int segment;
  bool clamped;
  double orientation[4];  // at the end of the substep, where clamped
};

//! How a joint resists, with the length l of the rod that bends in it.
struct JointStiffness {
  double bending_compliance;  // l / (E I h^2), times bending_elasticity
  double torsion_compliance;  // l / (G J h^2), times torsion_elasticity
  double bending_stiffness;   // E I h^2 / l, as far as the direct solver can tell it from rigid
  double torsion_stiffness;   // G J h^2 / l, likewise
  double bending_viscosity;   // torque per rotation in a substep: retardation time / h
  double torsion_viscosity;   // times the stiffness
  double bending_elasticity;  // elastic part of the resistance: 1 / (1 + retardation time / h)
  double torsion_elasticity;
  double axial_compliance;  // l / (E A h^2)
};

//! What a substep needs besides the state. Compliances and stiffnesses are per joint and include the time step:
//! a multiplier is a force or torque times h^2.
struct RodSubstepInput {
  int segments;
  double h;                                  // s
  double segment_length;                     // m, where all are as long
  double gravity[3];                         // m/s^2
  const JointStiffness* joints;              // [N - 1]
  bool viscous;                              // whether the joints resist their rate of bending or twisting
  double floor_compliance;                   // keeps the joint's matrix regular when both of its segments are held
  const double* inverse_mass;                // [N] 1/kg, zero where held
  const double* inverse_transverse;          // [N] 1/(kg m^2), zero where clamped
  const double* inverse_axial;               // [N] 1/(kg m^2), zero where clamped
  const double* transverse_inertia;          // [N] kg m^2, huge where clamped
  const double* inertia_excess;              // [N] kg m^2, axial - transverse, zero where clamped
  const double* inertia_ratio;               // [N] (axial - transverse) / transverse moment of inertia
  const double* drag;                        // [N] 1/m, speed across the axis that is lost per way through air
  const double* weight_moment;               // [N] kg m, of mass off the centre that a pinned segment turns about
  const double* arm_before;                  // [N] m, from the joint before a segment to its position
  const double* arm_after;                   // [N] m, from there to the joint after it
  bool plain;                                // whether the rod is straight by nature and all arms are half a length
  const double* natural_ahead;               // [(N - 1) x 3] see NaturalJoints; null: straight by nature
  const double* natural_behind;              // [(N - 1) x 3]
  const double* natural_twist;               // [N - 1] rad
  double bending_over_torsion;               // E I / (G J)
  const unsigned char* joint_active;         // [N - 1] false between two held segments
  const double* linear_rate;                 // [N] 1/s, velocity per displacement in a substep: damping / h
  const double* angular_rate;                // [N] 1/s
  const double* reference_velocity;          // [N x 3] m/s, added to it: the part that is not damped
  const double* reference_angular_velocity;  // [N x 3] rad/s
  const HeldSegment* held;
  int held_count;
  double* workspace;  // direct solver: rodWorkspaceSize() numbers, aligned
};

//! Numbers per joint and copy in the direct solver's workspace.
constexpr int kNumbersPerJoint = 45;

//! Enough for one pack of any width: packs use it one after the other.
constexpr std::size_t rodWorkspaceSize(int segments) {
  return static_cast<std::size_t>(segments - 1) * kNumbersPerJoint * kLanes;
}

//! A substep of Algorithm 1 for the first copies of eight: predict, solve the joints, update velocities.
using RodSubstep = void (*)(const RodSubstepInput&, int copies, RodLanes&);

//! The substeps compiled for one instruction set.
struct RodKernel {
  const char* instruction_set;
  RodSubstep gauss_seidel;
  RodSubstep direct;
};

namespace portable {
RodKernel rodKernel();
}
namespace avx2 {
RodKernel rodKernel();
}
namespace avx512 {
RodKernel rodKernel();
}

//! The kernel for selectedInstructionSet().
const RodKernel& selectedRodKernel();

//! The kernels that this processor runs, slowest first.
std::vector<RodKernel> availableRodKernels();

}  // namespace pbd
}  // namespace deformable_manipulation
