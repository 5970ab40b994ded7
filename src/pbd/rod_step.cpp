// A rod from one time step to the next: what the kernels get, and when they run.

#include <algorithm>
#include <cmath>

#include "deformable_manipulation/pbd/rod.h"
#include "natural_shape.h"
#include "rod_masses.h"
#include "rod_pieces.h"
#include "rod_state.h"
#include "rod_viscosity.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// Compliances as fractions of the joint's own response to a force. The first one makes up "zero"
// stretch: it keeps the chain's matrix regular where a straight piece is taut between two holds and
// bounds the forces of one that is pulled farther than it reaches; a hanging rope grows by some
// micrometres. As that growth goes with the square of the number of segments, more than kManySegments get less. The
// other one, in all directions, is far below what can be seen.
constexpr double kAxialCompliance = 1e-5;
constexpr double kManySegments = 100.0;
constexpr double kFloorCompliance = 1e-8;

double axialCompliance(int segments) {
  const double coarser = std::min(1.0, kManySegments / segments);
  return kAxialCompliance * coarser * coarser;
}

// Of the inertia of a segment: a joint that is stiffer than this times inertia / h^2 is rigid, and
// the inertia would be lost in the rounding of the stiffness. Steel in segments of 2 mm has 1e9.
constexpr double kRigidStiffness = 1e12;

}  // namespace

void Rod::beginStep(double h) {
  const RodParameters& p = parameters_;
  RodSubstepInput& in = state_->input;
  in.segments = p.segments;
  in.h = h;
  in.segment_length = pieces_->usual;
  std::copy(p.gravity.data(), p.gravity.data() + 3, in.gravity);
  for (int i = 0; i < p.segments; ++i) {
    state_->drag[i] = p.dragPerDistance() * pieces_->share(i) / masses_->relative[i];
  }
  describeJoints(h);
  in.floor_compliance = kFloorCompliance / p.segmentMass();
  updateReferenceMotion();
  dampTowardsReference(h);
  state_->connect();
}

void Rod::describeJoints(double h) {
  const RodParameters& p = parameters_;
  RodSubstepInput& in = state_->input;
  state_->joints.resize(pieces_->joint_lengths.size());
  for (std::size_t j = 0; j < state_->joints.size(); ++j) {
    state_->joints[j] = jointStiffness(static_cast<int>(j), h);
  }
  in.natural_ahead = natural_->empty() ? nullptr : natural_->ahead.data();
  in.natural_behind = natural_->behind.data();
  in.natural_twist = natural_->twist.data();
  const auto is_even = [](double offset) { return offset == 0.0; };
  in.plain = natural_->empty() && pieces_->equal && std::all_of(state_->offset.begin(), state_->offset.end(), is_even);
  in.bending_over_torsion = p.bendingStiffness() / p.torsionStiffness();
  in.viscous = p.bending_retardation_time > 0.0 || p.torsion_retardation_time > 0.0;
}

JointStiffness Rod::jointStiffness(int joint, double h) const {
  const RodParameters& p = parameters_;
  const double h2 = h * h;
  const double l = pieces_->joint_lengths[joint];
  const double shorter = pieces_->shorterAt(joint);
  const double inertia = std::min(p.axialInertia() * (shorter / pieces_->usual), p.transverseInertia(shorter));
  const double rigid = kRigidStiffness * inertia;
  JointStiffness to;
  to.bending_compliance = l / (p.bendingStiffness() * h2);
  to.torsion_compliance = l / (p.torsionStiffness() * h2);
  to.bending_stiffness = std::min(1.0 / to.bending_compliance, rigid);
  to.torsion_stiffness = std::min(1.0 / to.torsion_compliance, rigid);
  const JointViscosity viscosity = jointViscosity(p, h);
  to.bending_viscosity = std::min(viscosity.bending * to.bending_stiffness, rigid);
  to.torsion_viscosity = std::min(viscosity.torsion * to.torsion_stiffness, rigid);
  const JointViscosity swept = sweptViscosity(p, *pieces_, joint, h);
  to.bending_elasticity = 1.0 / (1.0 + swept.bending);
  to.torsion_elasticity = 1.0 / (1.0 + swept.torsion);
  to.bending_compliance *= to.bending_elasticity;
  to.torsion_compliance *= to.torsion_elasticity;
  to.axial_compliance =
      p.stretch == Stretch::FROM_MODULI ? l / (p.axialStiffness() * h2) : axialCompliance(p.segments) / p.segmentMass();
  return to;
}

void Rod::updateReferenceMotion() {
  State& s = *state_;
  const RodParameters& p = parameters_;
  if (!holds().empty()) {
    s.places.resize(p.segments);
    for (int i = 0; i < p.segments; ++i) {
      s.places[i] = pieces_->equal ? i : pieces_->between(0, i) / pieces_->usual;
    }
    carriedMotion(holds(), s.places, s.reference_velocity.data(), s.reference_angular_velocity.data());
    return;
  }
  for (int i = 0; i < p.segments; ++i) {
    const RodLanes& lanes = s.groups[0];
    s.motions[i] = {masses_->relative[i],
                    s.transverse_inertia[i] - p.transverseInertia(),
                    p.axialInertia() * pieces_->share(i),
                    read3(lanes.position, i, 0),
                    tangent(read4(lanes.orientation, i, 0)),
                    read3(lanes.velocity, i, 0),
                    read3(lanes.angular_velocity, i, 0)};
  }
  rigidMotion(s.motions, p.segmentMass(), p.transverseInertia(), s.reference_velocity.data(),
              s.reference_angular_velocity.data());
}

//! v_ref + decay (v - v_ref), with v the displacement over h; held segments are not damped.
void Rod::dampTowardsReference(double h) {
  State& s = *state_;
  const double decay = std::exp(-parameters_.damping * h);
  for (int i = 0; i < parameters_.segments; ++i) {
    const double linear = s.inverse_mass[i] > 0.0 ? decay : 1.0;
    const double angular = s.inverse_transverse[i] > 0.0 ? decay : 1.0;
    s.linear_rate[i] = linear / h;
    s.angular_rate[i] = angular / h;
    for (int axis = 3 * i; axis < 3 * i + 3; ++axis) {
      s.reference_velocity[axis] *= 1.0 - linear;
      s.reference_angular_velocity[axis] *= 1.0 - angular;
    }
  }
}

//! The rigid motion of a free rod gains speed in each substep; such a rod has no copies.
void Rod::letReferenceFall() {
  State& s = *state_;
  const double h = s.input.h;
  for (int i = 0; i < parameters_.segments; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      s.reference_velocity[3 * i + axis] += (1.0 - h * s.linear_rate[i]) * h * parameters_.gravity[axis];
    }
  }
}

void Rod::substep() {
  const auto describe = [](const HeldPoint& held, HeldSegment* to) {
    to->segment = held.particle;
    to->clamped = held.type == Hold::CLAMPED;
    std::copy(held.pose.orientation.coeffs().data(), held.pose.orientation.coeffs().data() + 4, to->orientation);
  };
  if (state_->groups.note(*this, describe)) {
    endStep();
  }
}

void Rod::endStep() {
  State& s = *state_;
  s.groups.advance(*this, *s.pool, [&](int worker, int group, int copies) {
    RodSubstepInput input = s.input;
    input.workspace = s.workspace.data() + worker * (s.workspace.size() / parameters_.threads);
    input.held_count = static_cast<int>(holds().size());
    for (int i = 0; i < s.groups.pending(); ++i) {
      input.held = s.groups.held(i, group, *this);
      if (holds().empty()) {
        letReferenceFall();
      }
      s.solve(input, copies, s.groups[group]);
    }
  });
}

}  // namespace pbd
}  // namespace deformable_manipulation
