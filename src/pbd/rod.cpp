#include "deformable_manipulation/pbd/rod.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "deformable_manipulation/pbd/rod_equilibrium.h"
#include "deformable_manipulation/pbd/rod_rest_shapes.h"
#include "lane_groups.h"
#include "reference_motion.h"
#include "rod_kernel.h"
#include "rod_layout.h"
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

// Of a segment's length: points nearer than that have no direction.
constexpr double kLeastChord = 1e-3;

// Of the inertia of a free segment: torques do not turn a clamped one.
constexpr double kClampedInertia = 1e30;

// Of the inertia of a segment: a joint that is stiffer than this times inertia / h^2 is rigid, and
// the inertia would be lost in the rounding of the stiffness. Steel in segments of 2 mm has 1e9.
constexpr double kRigidStiffness = 1e12;

Quaternion read4(const AlignedArray& array, int item, int lane) {
  const double* at = array.data() + 4 * kLanes * item + lane;
  return {at[3 * kLanes], at[0], at[kLanes], at[2 * kLanes]};
}

void write4(AlignedArray& array, int item, int lane, const Quaternion& value) {
  for (int i = 0; i < 4; ++i) {
    array[(4 * item + i) * kLanes + lane] = value.coeffs()[i];
  }
}

Vector3 tangent(const Quaternion& orientation) { return orientation * Vector3::UnitX(); }

}  // namespace

struct Rod::State {
  explicit State(int segments) : groups(RodLanes(segments)) {}

  LaneGroups<RodLanes, HeldSegment> groups;
  std::vector<double> inverse_mass, inverse_transverse, inverse_axial;
  std::vector<double> transverse_inertia, inertia_excess;
  std::vector<unsigned char> joint_active;
  std::vector<double> linear_rate, angular_rate;
  std::vector<double> reference_velocity, reference_angular_velocity;
  AlignedArray workspace;  // [threads x rodWorkspaceSize()]
  RodSubstepInput input;
  RodSubstep solve;
  std::shared_ptr<ThreadPool> pool;    // shared with clones
  std::vector<SegmentMotion> motions;  // [N] scratch
  RodEquilibrium equilibrium;

  //! Points the kernel's input at this state's arrays.
  void connect() {
    input.inverse_mass = inverse_mass.data();
    input.inverse_transverse = inverse_transverse.data();
    input.inverse_axial = inverse_axial.data();
    input.transverse_inertia = transverse_inertia.data();
    input.inertia_excess = inertia_excess.data();
    input.joint_active = joint_active.data();
    input.linear_rate = linear_rate.data();
    input.angular_rate = angular_rate.data();
    input.reference_velocity = reference_velocity.data();
    input.reference_angular_velocity = reference_angular_velocity.data();
  }
};

Rod::Rod(const RodParameters& parameters) : parameters_(checked(parameters)), state_(new State(parameters_.segments)) {
  const int n = parameters_.segments;
  State& s = *state_;
  s.linear_rate.resize(n);
  s.angular_rate.resize(n);
  s.reference_velocity.resize(3 * n);
  s.reference_angular_velocity.resize(3 * n);
  s.motions.resize(n);
  s.input = RodSubstepInput{};
  s.pool = std::make_shared<ThreadPool>(parameters_.threads);
  s.solve = selectedRodKernel().gauss_seidel;
  if (parameters_.solver == RodSolver::DIRECT) {
    s.solve = selectedRodKernel().direct;
    s.workspace.resize(parameters_.threads * rodWorkspaceSize(n));
  }
  holdsChanged();
  layOut();
}

Rod::Rod(const Rod& other) : Body(other), parameters_(other.parameters_), state_(new State(*other.state_)) {}

Rod::~Rod() = default;

std::unique_ptr<Body> Rod::clone() const { return std::unique_ptr<Body>(new Rod(*this)); }

void Rod::setMaterial(const std::vector<MaterialParameter>& parameters) {
  static constexpr std::pair<const char*, double RodParameters::*> kKeys[] = {
      {"young_modulus", &RodParameters::young_modulus},
      {"torsion_modulus", &RodParameters::torsion_modulus},
      {"damping", &RodParameters::damping},
      {"drag_coefficient", &RodParameters::drag_coefficient},
      {"bending_retardation_time", &RodParameters::bending_retardation_time},
      {"torsion_retardation_time", &RodParameters::torsion_retardation_time}};
  RodParameters changed = parameters_;
  ParameterCheck check;
  for (const MaterialParameter& parameter : parameters) {
    const auto* found = std::find_if(std::begin(kKeys), std::end(kKeys),
                                     [&](const auto& known) { return parameter.key == known.first; });
    if (found == std::end(kKeys)) {
      check.require(false, parameter.key, parameter.value,
                    "young_modulus, torsion_modulus, damping, drag_coefficient, bending_retardation_time or "
                    "torsion_retardation_time");
    } else {
      changed.*found->second = parameter.value;
    }
  }
  changed.check(check);
  check.throwIfAny();
  parameters_ = changed;
}

std::vector<MaterialParameter> Rod::dampings() const {
  return {{"damping", parameters_.damping},
          {"drag_coefficient", parameters_.drag_coefficient},
          {"bending_retardation_time", parameters_.bending_retardation_time},
          {"torsion_retardation_time", parameters_.torsion_retardation_time}};
}

std::vector<double> Rod::arcLengths() const {
  std::vector<double> arc_lengths;
  for (int i = 0; i < pointCount(); ++i) {
    arc_lengths.push_back(i * parameters_.segmentLength());
  }
  return arc_lengths;
}

double Rod::freeLength(int particle, int other) const {
  requireParticle(particle);
  requireParticle(other);
  return std::abs(particle - other) * parameters_.segmentLength();
}

Pose Rod::pose(int particle) const {
  requireParticle(particle);
  return {state_->groups.read(&RodLanes::position, particle), read4(state_->groups[0].orientation, particle, 0)};
}

void Rod::holdsChanged() {
  State& s = *state_;
  const int n = parameters_.segments;
  s.inverse_mass.assign(n, 1.0 / parameters_.segmentMass());
  s.inverse_transverse.assign(n, 1.0 / parameters_.transverseInertia());
  s.inverse_axial.assign(n, 1.0 / parameters_.axialInertia());
  s.transverse_inertia.assign(n, parameters_.transverseInertia());
  s.inertia_excess.assign(n, parameters_.axialInertia() - parameters_.transverseInertia());
  s.joint_active.assign(n - 1, 1);
  s.groups.resize(*this);
  for (const HeldPoint& held : holds()) {
    s.inverse_mass[held.particle] = 0.0;
    if (held.type == Hold::CLAMPED) {
      s.inverse_transverse[held.particle] = 0.0;
      s.inverse_axial[held.particle] = 0.0;
      s.transverse_inertia[held.particle] *= kClampedInertia;
      s.inertia_excess[held.particle] = 0.0;
    }
  }
  for (int j = 0; j + 1 < n; ++j) {
    s.joint_active[j] = s.inverse_mass[j] > 0.0 || s.inverse_mass[j + 1] > 0.0;
  }
}

void Rod::resizeCopies() { state_->groups.resize(*this); }

void Rod::assignCopy(int to, int from) { state_->groups.assign(to, from); }

void Rod::layOut() {
  const std::vector<Pose> segments = layOutRod(parameters_, holds());
  for (std::size_t copy = 0; copy < state_->groups.size() * kLanes; ++copy) {
    placeCopy(static_cast<int>(copy), segments);
  }
  state_->groups.fill(&RodLanes::multiplier, 0.0);
  state_->groups.fill(&RodLanes::twist, 0.0);
  stop();
}

void Rod::placeCopy(int copy, const std::vector<Pose>& segments) {
  RodLanes& lanes = state_->groups.of(copy);
  const int lane = copy % kLanes;
  for (int i = 0; i < parameters_.segments; ++i) {
    write3(lanes.position, i, lane, segments[i].position);
    write3(lanes.previous_position, i, lane, segments[i].position);
    write4(lanes.orientation, i, lane, segments[i].orientation);
    write4(lanes.previous_orientation, i, lane, segments[i].orientation);
  }
}

void Rod::setShape(const double* points) {
  std::vector<Pose> segments(parameters_.segments);
  Quaternion frame = pose(0).orientation;
  for (int i = 0; i < parameters_.segments; ++i) {
    const Eigen::Map<const Vector3> from(points + 3 * i);
    const Eigen::Map<const Vector3> to(points + 3 * (i + 1));
    frame = Quaternion::FromTwoVectors(tangent(frame), to - from) * frame;
    frame.normalize();
    segments[i] = {0.5 * (from + to), frame};
  }
  placeCopy(0, segments);
  state_->groups.fill(&RodLanes::multiplier, 0.0);
  state_->groups.fill(&RodLanes::twist, 0.0);
  stop();
}

//! The frame of the first clamped hold runs along the rod, so that the rod is not twisted there.
void Rod::placeState(const double* points, const double* velocities) {
  const int n = parameters_.segments;
  const auto row = [](const double* from, int i) { return Eigen::Map<const Vector3>(from + 3 * i); };
  std::vector<Vector3> directions(n);
  for (int i = 0; i < n; ++i) {
    directions[i] = row(points, i + 1) - row(points, i);
    if (directions[i].norm() < kLeastChord * parameters_.segmentLength()) {
      throw std::invalid_argument("points " + std::to_string(i) + " and " + std::to_string(i + 1) + " coincide");
    }
  }
  setShape(points);
  const auto clamped =
      std::find_if(holds().begin(), holds().end(), [](const HeldPoint& held) { return held.type == Hold::CLAMPED; });
  const int start = clamped != holds().end() ? clamped->particle : 0;
  Quaternion frame = clamped != holds().end() ? clamped->pose.orientation : pose(0).orientation;
  const auto carry = [&](int i) {
    frame = (Quaternion::FromTwoVectors(tangent(frame), directions[i]) * frame).normalized();
    write4(state_->groups[0].orientation, i, 0, frame);
    write4(state_->groups[0].previous_orientation, i, 0, frame);
  };
  carry(start);
  const Quaternion middle = frame;
  for (int i = start + 1; i < n; ++i) {
    carry(i);
  }
  frame = middle;
  for (int i = start - 1; i >= 0; --i) {
    carry(i);
  }
  closeGaps();
  for (int i = 0; i < n; ++i) {
    const Vector3 spreading = row(velocities, i + 1) - row(velocities, i);
    write3(state_->groups[0].velocity, i, 0, 0.5 * (row(velocities, i) + row(velocities, i + 1)));
    write3(state_->groups[0].angular_velocity, i, 0,
           Vector3(directions[i].cross(spreading) / directions[i].squaredNorm()));
  }
}

//! Brings the segments end to end by substeps so short that nothing else happens.
void Rod::closeGaps() {
  constexpr double kAtOnce = 1e-7;  // s
  constexpr int kMost = 2000;       // the direct solver needs a few, sweeps many
  for (int i = 0; i < kMost && std::abs(stretch()) > 1e-9; ++i) {
    step(kAtOnce, 1);
    stop();
  }
  state_->groups.fill(&RodLanes::multiplier, 0.0);
}

void Rod::stop() {
  state_->groups.fill(&RodLanes::velocity, 0.0);
  state_->groups.fill(&RodLanes::angular_velocity, 0.0);
}

void Rod::displace(int particle, const Vector3& by) { state_->groups.displace(&RodLanes::position, particle, by); }

void Rod::beginStep(double h) {
  const RodParameters& p = parameters_;
  RodSubstepInput& in = state_->input;
  const double h2 = h * h;
  const double l = p.segmentLength();
  in.segments = p.segments;
  in.h = h;
  in.segment_length = l;
  std::copy(p.gravity.data(), p.gravity.data() + 3, in.gravity);
  in.drag = p.dragPerDistance();
  in.inertia_ratio = p.axialInertia() / p.transverseInertia() - 1.0;
  describeJoints(h);
  in.axial_compliance =
      p.stretch == Stretch::FROM_MODULI ? l / (p.axialStiffness() * h2) : axialCompliance(p.segments) / p.segmentMass();
  in.floor_compliance = kFloorCompliance / p.segmentMass();
  updateReferenceMotion();
  dampTowardsReference(h);
  state_->connect();
}

void Rod::describeJoints(double h) {
  const RodParameters& p = parameters_;
  RodSubstepInput& in = state_->input;
  const double h2 = h * h;
  const double l = p.segmentLength();
  const double rigid = kRigidStiffness * std::min(p.axialInertia(), p.transverseInertia());
  in.bending_compliance = l / (p.bendingStiffness() * h2);
  in.torsion_compliance = l / (p.torsionStiffness() * h2);
  in.bending_stiffness = std::min(1.0 / in.bending_compliance, rigid);
  in.torsion_stiffness = std::min(1.0 / in.torsion_compliance, rigid);
  in.viscous = p.bending_retardation_time > 0.0 || p.torsion_retardation_time > 0.0;
  const JointViscosity viscosity = jointViscosity(p, h);
  in.bending_viscosity = std::min(viscosity.bending * in.bending_stiffness, rigid);
  in.torsion_viscosity = std::min(viscosity.torsion * in.torsion_stiffness, rigid);
  const JointViscosity swept = sweptViscosity(p, h);
  in.bending_elasticity = 1.0 / (1.0 + swept.bending);
  in.torsion_elasticity = 1.0 / (1.0 + swept.torsion);
  in.bending_compliance *= in.bending_elasticity;
  in.torsion_compliance *= in.torsion_elasticity;
}

void Rod::updateReferenceMotion() {
  State& s = *state_;
  const RodParameters& p = parameters_;
  if (!holds().empty()) {
    carriedMotion(holds(), p.segments, s.reference_velocity.data(), s.reference_angular_velocity.data());
    return;
  }
  for (int i = 0; i < p.segments; ++i) {
    const RodLanes& lanes = s.groups[0];
    s.motions[i] = {read3(lanes.position, i, 0), tangent(read4(lanes.orientation, i, 0)), read3(lanes.velocity, i, 0),
                    read3(lanes.angular_velocity, i, 0)};
  }
  rigidMotion(s.motions, p.segmentMass(), p.transverseInertia(), p.axialInertia(), s.reference_velocity.data(),
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

double Rod::stretch() const {
  const double l = parameters_.segmentLength();
  double length = l;
  for (int i = 1; i < parameters_.segments; ++i) {
    const Pose before = pose(i - 1);
    const Pose after = pose(i);
    const Vector3 gap = (after.position - 0.5 * l * tangent(after.orientation)) -
                        (before.position + 0.5 * l * tangent(before.orientation));
    length += l + gap.norm();
  }
  return length / parameters_.length - 1.0;
}

Wrench Rod::wrench(int particle, int copy) const {
  held(particle);
  const RodLanes& lanes = state_->groups.of(copy);
  const int lane = copy % kLanes;
  const double per_h2 = state_->input.h > 0.0 ? 1.0 / (state_->input.h * state_->input.h) : 0.0;
  const double half = 0.5 * parameters_.segmentLength();
  const Vector3 d = tangent(read4(lanes.orientation, particle, lane));
  Wrench wrench;
  wrench.force = parameters_.segmentMass() * parameters_.gravity;
  for (int side : {-1, 0}) {  // the joints before and after the segment
    const int joint = particle + side;
    if (joint < 0 || joint + 1 >= parameters_.segments) {
      continue;
    }
    const Vector3 force = per_h2 * read3(lanes.multiplier, 2 * joint, lane);
    const Vector3 torque = per_h2 * read3(lanes.multiplier, 2 * joint + 1, lane);
    wrench.force += (side == 0 ? 1.0 : -1.0) * force;
    wrench.torque += half * d.cross(force) + (side == 0 ? 1.0 : -1.0) * torque;
  }
  return wrench;
}

ResponseStatus Rod::response(double* to) {
  RodEquilibrium& equilibrium = state_->equilibrium;
  equilibrium.update(*this, 1);
  if (equilibrium.status(0) == ResponseStatus::VALID) {
    equilibrium.response(0, to);
  }
  return equilibrium.status(0);
}

bool Rod::turningResponse(double* to) const {
  state_->equilibrium.turningResponse(0, to);
  return true;
}

bool Rod::wrenchResponse(double* to) const {
  state_->equilibrium.wrenchResponse(0, to);
  return true;
}

std::unique_ptr<RestShapes> Rod::restShapes(const std::vector<HeldPoint>& agents) const {
  return std::make_unique<RodRestShapes>(*this, agents);
}

void Rod::points(double* to) const {
  const int n = parameters_.segments;
  const double half = 0.5 * parameters_.segmentLength();
  for (int copy = 0; copy < copyCount(); ++copy) {
    const RodLanes& lanes = state_->groups.of(copy);
    const int lane = copy % kLanes;
    Vector3 before = Vector3::Zero();
    for (int i = 0; i <= n; ++i, to += 3) {
      Vector3 point = before;
      if (i < n) {
        const Vector3 x = read3(lanes.position, i, lane);
        const Vector3 reach = half * tangent(read4(lanes.orientation, i, lane));
        point = i > 0 ? Vector3(0.5 * (before + x - reach)) : Vector3(x - reach);
        before = x + reach;
      }
      std::copy(point.data(), point.data() + 3, to);
    }
  }
}

void Rod::positions(int copy, double* to) const { state_->groups.unpack(&RodLanes::position, copy, to); }

void Rod::velocities(int copy, double* to) const { state_->groups.unpack(&RodLanes::velocity, copy, to); }

bool Rod::orientations(int copy, double* to) const {
  state_->groups.unpack(&RodLanes::orientation, copy, to);
  return true;
}

void Rod::twists(int copy, double* to) const { state_->groups.unpack(&RodLanes::twist, copy, to); }

int Rod::firstNonFinite(int copy) const {
  const RodLanes& lanes = state_->groups.of(copy);
  const int lane = copy % kLanes;
  for (int i = 0; i < parameters_.segments; ++i) {
    const double sum = read3(lanes.position, i, lane).sum() + read3(lanes.velocity, i, lane).sum() +
                       read4(lanes.orientation, i, lane).coeffs().sum() + read3(lanes.angular_velocity, i, lane).sum();
    if (!std::isfinite(sum)) {
      return i;
    }
  }
  return -1;
}

double Rod::highestSpeed() const {
  double highest = 0.0;
  for (int copy = 0; copy < copyCount(); ++copy) {
    for (int i = 0; i < parameters_.segments; ++i) {
      const double turning =
          parameters_.segmentLength() * state_->groups.read(&RodLanes::angular_velocity, i, copy).norm();
      highest = std::max({highest, state_->groups.read(&RodLanes::velocity, i, copy).norm(), turning});
    }
  }
  return highest;
}

}  // namespace pbd
}  // namespace deformable_manipulation
