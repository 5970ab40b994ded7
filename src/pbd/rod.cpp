#include "deformable_manipulation/pbd/rod.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "deformable_manipulation/pbd/rod_rest_shapes.h"
#include "natural_shape.h"
#include "rod_masses.h"
#include "rod_pieces.h"
#include "rod_state.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// Of the inertia of a free segment: torques do not turn a clamped one.
constexpr double kClampedInertia = 1e30;

}  // namespace

Rod::Rod(const RodParameters& parameters)
    : parameters_(checked(parameters)),
      pieces_(std::make_shared<RodPieces>(rodPieces(parameters_))),
      natural_(std::make_shared<NaturalJoints>(pbd::naturalJoints(parameters_))),
      masses_(std::make_shared<SegmentMasses>(pbd::segmentMasses(parameters_, *pieces_))),
      state_(new State(parameters_.segments)) {
  const int n = parameters_.segments;
  State& s = *state_;
  for (std::vector<double>* each :
       {&s.inverse_mass, &s.inverse_transverse, &s.inverse_axial, &s.transverse_inertia, &s.inertia_excess,
        &s.inertia_ratio, &s.drag, &s.weight_moment, &s.arm_before, &s.arm_after, &s.offset, &s.linear_rate}) {
    each->resize(n);
  }
  s.angular_rate.resize(n);
  s.joints.resize(n - 1);
  for (int i = 0; i < n; ++i) {
    s.places.push_back(pieces_->equal ? i : pieces_->between(0, i) / pieces_->usual);
  }
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

Rod::Rod(const Rod& other)
    : Body(other),
      parameters_(other.parameters_),
      pieces_(other.pieces_),
      natural_(other.natural_),
      masses_(other.masses_),
      state_(new State(*other.state_)) {}

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

std::vector<double> Rod::arcLengths() const { return pieces_->ends; }

std::vector<double> Rod::jointLengths() const { return pieces_->joint_lengths; }

double Rod::freeLength(int particle, int other) const {
  requireParticle(particle);
  requireParticle(other);
  return std::abs(pieces_->between(particle, other));
}

Pose Rod::pose(int particle) const {
  requireParticle(particle);
  return {centre(particle, 0), read4(state_->groups[0].orientation, particle, 0)};
}

void Rod::holdsChanged() {
  State& s = *state_;
  const RodParameters& p = parameters_;
  const int n = p.segments;
  placeMasses();
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

//! Masses and inertias of all segments, about where their positions are: the centre of mass, or the centre if held.
void Rod::placeMasses() {
  State& s = *state_;
  const RodParameters& p = parameters_;
  std::vector<double> before = s.offset;
  for (int i = 0; i < p.segments; ++i) {
    const double mass = masses_->relative[i] * p.segmentMass();
    const auto holds_it = [i](const HeldPoint& held) { return held.particle == i; };
    const bool is_held = std::any_of(holds().begin(), holds().end(), holds_it);
    s.offset[i] = is_held ? 0.0 : masses_->moment[i] / mass;
    s.weight_moment[i] = is_held ? masses_->moment[i] : 0.0;
    s.arm_before[i] = 0.5 * pieces_->lengths[i] + s.offset[i];
    s.arm_after[i] = 0.5 * pieces_->lengths[i] - s.offset[i];
    const double axial = p.axialInertia() * pieces_->share(i);
    const double transverse = p.transverseInertia() + (masses_->inertia[i] - mass * s.offset[i] * s.offset[i]);
    s.inverse_mass[i] = 1.0 / mass;
    s.inverse_transverse[i] = 1.0 / transverse;
    s.inverse_axial[i] = 1.0 / axial;
    s.transverse_inertia[i] = transverse;
    s.inertia_excess[i] = axial - transverse;
    s.inertia_ratio[i] = axial / transverse - 1.0;
    if (s.offset[i] != before[i]) {
      shiftPositions(i, s.offset[i] - before[i]);
    }
  }
}

//! Moves the position of a segment along its tangent, in all copies; the segment stays where it is.
void Rod::shiftPositions(int segment, double by) {
  for (std::size_t copy = 0; copy < state_->groups.size() * kLanes; ++copy) {
    RodLanes& lanes = state_->groups.of(static_cast<int>(copy));
    const int lane = copy % kLanes;
    const Vector3 shift = by * tangent(read4(lanes.orientation, segment, lane));
    const Vector3 turning = read3(lanes.angular_velocity, segment, lane).cross(shift);
    write3(lanes.position, segment, lane, read3(lanes.position, segment, lane) + shift);
    write3(lanes.velocity, segment, lane, read3(lanes.velocity, segment, lane) + turning);
  }
}

//! [m] The centre of a segment.
Vector3 Rod::centre(int segment, int copy) const {
  const RodLanes& lanes = state_->groups.of(copy);
  const Vector3 position = read3(lanes.position, segment, copy % kLanes);
  const double offset = state_->offset[segment];
  return offset == 0.0 ? position : position - offset * tangent(read4(lanes.orientation, segment, copy % kLanes));
}

void Rod::resizeCopies() { state_->groups.resize(*this); }

void Rod::assignCopy(int to, int from) { state_->groups.assign(to, from); }

double Rod::stretch() const {
  const std::vector<double>& lengths = pieces_->lengths;
  double length = lengths[0];
  for (int i = 1; i < parameters_.segments; ++i) {
    const Pose before = pose(i - 1);
    const Pose after = pose(i);
    const Vector3 gap = (after.position - 0.5 * lengths[i] * tangent(after.orientation)) -
                        (before.position + 0.5 * lengths[i - 1] * tangent(before.orientation));
    length += lengths[i] + gap.norm();
  }
  return length / parameters_.length - 1.0;
}

Wrench Rod::wrench(int particle, int copy) const {
  held(particle);
  const RodLanes& lanes = state_->groups.of(copy);
  const int lane = copy % kLanes;
  const double per_h2 = state_->input.h > 0.0 ? 1.0 / (state_->input.h * state_->input.h) : 0.0;
  const double half = 0.5 * pieces_->lengths[particle];
  const Vector3 d = tangent(read4(lanes.orientation, particle, lane));
  Wrench wrench;
  wrench.force = masses_->relative[particle] * parameters_.segmentMass() * parameters_.gravity;
  wrench.torque = masses_->moment[particle] * d.cross(parameters_.gravity);
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
  if (gripCount() < static_cast<int>(holds().size())) {
    return ResponseStatus::NOT_AVAILABLE;
  }
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
  for (int copy = 0; copy < copyCount(); ++copy) {
    const RodLanes& lanes = state_->groups.of(copy);
    const int lane = copy % kLanes;
    Vector3 before = Vector3::Zero();
    for (int i = 0; i <= n; ++i, to += 3) {
      Vector3 point = before;
      if (i < n) {
        const Vector3 x = centre(i, copy);
        const Vector3 reach = 0.5 * pieces_->lengths[i] * tangent(read4(lanes.orientation, i, lane));
        point = i > 0 ? Vector3(0.5 * (before + x - reach)) : Vector3(x - reach);
        before = x + reach;
      }
      std::copy(point.data(), point.data() + 3, to);
    }
  }
}

void Rod::positions(int copy, double* to) const {
  for (int i = 0; i < parameters_.segments; ++i) {
    Eigen::Map<Vector3>(to + 3 * i) = centre(i, copy);
  }
}

void Rod::velocities(int copy, double* to) const {
  const RodLanes& lanes = state_->groups.of(copy);
  const int lane = copy % kLanes;
  state_->groups.unpack(&RodLanes::velocity, copy, to);
  for (int i = 0; i < parameters_.segments; ++i) {
    if (state_->offset[i] != 0.0) {
      const Vector3 arm = state_->offset[i] * tangent(read4(lanes.orientation, i, lane));
      Eigen::Map<Vector3>(to + 3 * i) -= read3(lanes.angular_velocity, i, lane).cross(arm);
    }
  }
}

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
      const double turning = pieces_->lengths[i] * state_->groups.read(&RodLanes::angular_velocity, i, copy).norm();
      highest = std::max({highest, state_->groups.read(&RodLanes::velocity, i, copy).norm(), turning});
    }
  }
  return highest;
}

}  // namespace pbd
}  // namespace deformable_manipulation
