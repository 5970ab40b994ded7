#pragma once

#include <vector>

#include "lanes.h"

namespace deformable_manipulation {
namespace pbd {

//! State of eight copies of a fabric. Layout: [vertex][axis][lane]. Lanes without a copy hold anything.
struct FabricLanes {
  FabricLanes(int vertices, int edges)
      : position(3 * kLanes * vertices),
        previous_position(position.size()),
        velocity(position.size()),
        rest_length(kLanes * edges),
        finite(kLanes) {}

  AlignedArray position;           // m
  AlignedArray previous_position;  // m
  AlignedArray velocity;           // m/s
  AlignedArray rest_length;        // [edges x lane] m, of the hinges and then the boundary edges, as adapted
  AlignedArray finite;             // [lane] 0 if the copy's state was finite after the last call, else not a number

  static constexpr AlignedArray FabricLanes::*kArrays[] = {&FabricLanes::position, &FabricLanes::previous_position,
                                                           &FabricLanes::velocity, &FabricLanes::rest_length};
};

//! An edge as a spring. An end moves by its gain times the edge's excess of length.
struct StretchConstraint {
  double rest_length;  // m
  double gain[2];
  double yield;         // elongation in equilibrium as a part of the excess that is corrected
  double most_adapted;  // m, by which the adapted rest length may differ
};

//! An edge between two triangles: a spring that also resists folding. A vertex moves by its gain times the fold, the
//! sum of the vertices by their weights; as these sum to zero, positions count from the first vertex, and its weight is
//! not needed. That of the third vertex is 1.
struct HingeConstraint {
  StretchConstraint stretch;
  double weight_of_end;       // the second vertex
  double weight_of_opposite;  // the fourth vertex
  double weight_of_stretch;   // change of the fold by the correction of the stretch
  double gain[4];
  int at[4];   // vertices' places in the arrays: both ends of the edge, then those opposite
  bool waits;  // the hinge before moves an end of the edge
};

//! An edge on the boundary.
struct BoundaryConstraint {
  StretchConstraint stretch;
  int at[2];
};

//! A held vertex during one substep.
struct HeldVertex {
  alignas(64) double position[3 * kLanes];  // m, at the end of the substep, one per lane
  int vertex;
};

//! Numbers that describe what a hinge and a boundary edge do in a substep (see FabricInput::recorded).
constexpr int kRecordedOfHinge = 6 * kLanes;
constexpr int kRecordedOfBoundary = 3 * kLanes;

//! What substeps need besides the state.
struct FabricInput {
  int vertices;
  double h;                  // s
  double gravity[3];         // m/s^2
  const double* decay;       // [N] what damping leaves of the velocity in a substep
  const double* carried;     // [N x 3] m/s, added to it: the part of the motion that is not damped
  double carried_change[3];  // m/s, of that in each substep
  const HingeConstraint* hinges;
  int hinge_count;
  const BoundaryConstraint* boundaries;
  int boundary_count;
  const HeldVertex* held;  // [substeps x held_stride]
  int held_count;
  int held_stride;
  double adaptation;  // part of the error of the lengths that a call takes off the rest lengths
  double* recorded;   // excess of length [m] along each edge, then fold [m], of the last substep
};

//! Substeps of the first copies of eight: predict, solve the constraints, update velocities.
using FabricAdvance = void (*)(const FabricInput&, int copies, int substeps, FabricLanes&);

//! The substeps compiled for one instruction set.
struct FabricKernel {
  const char* instruction_set;
  FabricAdvance advance;
};

namespace portable {
FabricKernel fabricKernel();
}
namespace avx2 {
FabricKernel fabricKernel();
}
namespace avx512 {
FabricKernel fabricKernel();
}

//! The kernel for selectedInstructionSet().
const FabricKernel& selectedFabricKernel();

//! The kernels that this processor runs, slowest first.
std::vector<FabricKernel> availableFabricKernels();

}  // namespace pbd
}  // namespace deformable_manipulation
