#include "deformable_manipulation/pbd/rod_equilibrium.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "natural_shape.h"
#include "rod_derivative.h"
#include "rod_equilibrium_kernel.h"
#include "rod_masses.h"
#include "rod_pieces.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// Rotation about the own axis costs nothing where no hold is clamped. This fraction of a joint's
// torsional stiffness makes the matrix regular and leaves the equilibrium where it is.
constexpr double kSpinFraction = 1e-7;

// A slack rod's points move at most a few times as fast as its holds. Much more: it swings freely.
constexpr double kLargestResponse = 1e3;

constexpr double kReach = 1.0 - 1e-9;         // of the free length, where the rod does not stretch
constexpr double kFarFromEquilibrium = 0.05;  // of the rod's length
constexpr double kOtherTurns = M_PI;          // rad

bool sameHolds(const std::vector<HeldPoint>& a, const std::vector<HeldPoint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const HeldPoint& x, const HeldPoint& y) {
    return x.particle == y.particle && x.type == y.type;
  });
}

}  // namespace

RodEquilibriumLanes::RodEquilibriumLanes(int segments, int spans, int holds)
    : orientation(4 * kLanes * segments),
      twist(kLanes * (segments - 1)),
      force(3 * kLanes * spans),
      reach(3 * kLanes * spans),
      last_reach(3 * kLanes * spans),
      response(9 * kLanes * holds * (segments + 1)),
      change(kLanes),
      unstable(kLanes),
      tangent(3 * kLanes * segments),
      inverse_pivot(6 * kLanes * segments),
      coupling(9 * kLanes * segments),
      correction(3 * kLanes * segments),
      force_response(9 * kLanes * segments * spans),
      closure(kLanes * 3 * spans * (6 * spans + 1)) {}

struct RodEquilibrium::State {
  RodParameters parameters;
  std::vector<HeldPoint> holds;
  std::vector<unsigned char> clamped;
  std::vector<int> span_of_joint;
  std::vector<RodSpan> spans;
  std::vector<int> held;
  std::shared_ptr<const RodPieces> pieces;
  std::shared_ptr<const NaturalJoints> natural;
  std::shared_ptr<const SegmentMasses> masses;
  std::vector<double> lean_weight, half_length, flexural, torsional, extension;
  RodEquilibriumInput input;

  std::vector<RodEquilibriumLanes> groups;
  std::vector<ResponseStatus> status;   // of each copy
  std::vector<Vector3> first_position;  // of each copy's first held segment
  std::vector<double> shape;            // points of a copy as found
  std::vector<double> present;          // points of all copies as simulated
  std::vector<Vector3> held_positions;  // [copies x holds] m
  bool elsewhere = false;               // whether they are other holds than the simulated ones
  bool turned = false;                  // see EquilibriumOptions
  int iterations = 0;

  void configure(const Rod& rod);
  void describeMaterial();
  void describeHolds();
  void connect();
  void update(const Rod& rod, int copies, const EquilibriumOptions& options);
  void hold(int slot, int copy);
  void startFrom(const Rod& rod, int slot, int copy);
  bool solve(const Rod& rod, int first, int last, const EquilibriumOptions& options);
  void search(RodEquilibriumLanes& lanes, int copies, const EquilibriumOptions& options);
  ResponseStatus judge(const Rod& rod, int copy, const EquilibriumOptions& options);
  bool isTwistedAs(const Rod& rod, int copy) const;
  bool stretches() const { return parameters.stretch == Stretch::FROM_MODULI; }
  bool outOfReach(int copy) const;
  bool swingsFreely(int copy) const;
  void points(int copy, double* to) const;
  Vector3 jointForce(int joint, int copy) const;

  Vector3 vector(AlignedArray RodEquilibriumLanes::*array, int item, int copy) const {
    const double* at = &(groups[copy / kLanes].*array)[3 * kLanes * item + copy % kLanes];
    return {at[0], at[kLanes], at[2 * kLanes]};
  }
  void setVector(AlignedArray RodEquilibriumLanes::*array, int item, int slot, const Vector3& value) {
    double* at = &(groups[slot / kLanes].*array)[3 * kLanes * item + slot % kLanes];
    for (int axis = 0; axis < 3; ++axis) {
      at[axis * kLanes] = value[axis];
    }
  }
  void setOrientation(int segment, int slot, const double* xyzw) {
    double* at = &groups[slot / kLanes].orientation[4 * kLanes * segment + slot % kLanes];
    for (int i = 0; i < 4; ++i) {
      at[i * kLanes] = xyzw[i];
    }
  }
  Vector3 tangentOf(int segment, int copy) const {
    const double* at = &groups[copy / kLanes].orientation[4 * kLanes * segment + copy % kLanes];
    return Quaternion(at[3 * kLanes], at[0], at[kLanes], at[2 * kLanes]) * Vector3::UnitX();
  }
};

RodEquilibrium::RodEquilibrium() : state_(new State) {}
RodEquilibrium::RodEquilibrium(const RodEquilibrium& other) : state_(new State(*other.state_)) {}
RodEquilibrium& RodEquilibrium::operator=(const RodEquilibrium& other) {
  *state_ = *other.state_;
  return *this;
}
RodEquilibrium::~RodEquilibrium() = default;

int RodEquilibrium::copyCount() const { return static_cast<int>(state_->status.size()); }
ResponseStatus RodEquilibrium::status(int copy) const { return state_->status.at(static_cast<std::size_t>(copy)); }
int RodEquilibrium::iterations() const { return state_->iterations; }

void RodEquilibrium::points(int copy, double* to) const {
  requireValid(copy);
  state_->points(copy, to);
}

void RodEquilibrium::response(int copy, double* to) const {
  requireValid(copy);
  const AlignedArray& from = state_->groups[copy / kLanes].response;
  for (std::size_t i = copy % kLanes; i < from.size(); i += kLanes) {
    *to++ = from[i];
  }
}

void RodEquilibrium::turningResponse(int copy, double* to) const {
  requireValid(copy);
  RodDerivative derivative(state_->input, state_->groups[copy / kLanes], copy % kLanes);
  const int holds = static_cast<int>(state_->held.size());
  const int points = state_->parameters.segments + 1;
  std::vector<Vector3> changes;
  for (int h = 0; h < holds; ++h) {
    for (int axis = 0; axis < 3; ++axis) {
      derivative.turn(h, Vector3::Unit(axis));
      derivative.pointChanges(changes);
      for (int k = 0; k < 3 * points; ++k) {
        to[3 * (3 * points * h + k) + axis] = changes[k / 3][k % 3];
      }
    }
  }
}

void RodEquilibrium::wrenches(int copy, double* to) const {
  requireValid(copy);
  const RodDerivative derivative(state_->input, state_->groups[copy / kLanes], copy % kLanes);
  for (std::size_t h = 0; h < state_->held.size(); ++h) {
    Eigen::Map<Vector6>(to + 6 * h) = derivative.wrench(static_cast<int>(h)).numbers();
  }
}

void RodEquilibrium::wrenchResponse(int copy, double* to) const {
  requireValid(copy);
  RodDerivative derivative(state_->input, state_->groups[copy / kLanes], copy % kLanes);
  const int holds = static_cast<int>(state_->held.size());
  for (int h = 0; h < holds; ++h) {
    for (int axis = 0; axis < 6; ++axis) {
      if (axis < 3) {
        derivative.displace(h, Vector3::Unit(axis));
      } else {
        derivative.turn(h, Vector3::Unit(axis - 3));
      }
      for (int of = 0; of < holds; ++of) {
        const Vector6 change = derivative.wrenchChange(of).numbers();
        for (int k = 0; k < 6; ++k) {
          to[6 * ((6 * of + k) * holds + h) + axis] = change[k];
        }
      }
    }
  }
}

void RodEquilibrium::requireValid(int copy) const {
  if (status(copy) != ResponseStatus::VALID) {
    throw std::logic_error("the equilibrium of copy " + std::to_string(copy) +
                           " is not known: " + describe(status(copy)));
  }
}

void RodEquilibrium::update(const Rod& rod, int copies, const EquilibriumOptions& options) {
  State& s = *state_;
  s.elsewhere = false;
  s.held_positions.clear();
  for (int copy = 0; copy < copies; ++copy) {
    for (const HeldPoint& held : rod.holds()) {
      s.held_positions.push_back(rod.heldPosition(held, copy));
    }
  }
  s.update(rod, copies, options);
}

void RodEquilibrium::updateElsewhere(const Rod& rod, const std::vector<Vector3>& held,
                                     const EquilibriumOptions& options) {
  State& s = *state_;
  s.elsewhere = true;
  s.held_positions = held;
  s.update(rod, static_cast<int>(held.size() / std::max<std::size_t>(1, rod.holds().size())), options);
}

void RodEquilibrium::State::update(const Rod& rod, int copies, const EquilibriumOptions& options) {
  configure(rod);
  turned = options.turned;
  iterations = 0;
  status.resize(copies, ResponseStatus::NOT_CONVERGED);
  first_position.resize(copies);
  if (held.empty()) {
    std::fill(status.begin(), status.end(), ResponseStatus::NOT_HELD);
    return;
  }
  while (static_cast<int>(groups.size()) < (copies + kLanes - 1) / kLanes) {
    groups.emplace_back(parameters.segments, static_cast<int>(spans.size()), static_cast<int>(held.size()));
  }
  for (int first = 0; first < copies; first += kLanes) {
    const int last = std::min(copies, first + kLanes) - 1;
    for (int slot = first; slot < first + kLanes; ++slot) {
      hold(slot, std::min(slot, last));  // idle lanes repeat a copy, so that none computes nonsense
    }
    selectedRodEquilibriumKernel().follow(input, groups[first / kLanes], last - first + 1);
    if (!solve(rod, first, last, options)) {
      solve(rod, first, last, options);  // those that failed, from the simulated shape
    }
  }
}

//! Finds the equilibria of copies first to last, all in one group. Where the last one is not known it starts from the
//! simulated shape. @return whether all are valid
bool RodEquilibrium::State::solve(const Rod& rod, int first, int last, const EquilibriumOptions& options) {
  for (int slot = first; slot < first + kLanes; ++slot) {
    const int copy = std::min(slot, last);
    if (status[copy] != ResponseStatus::VALID) {
      startFrom(rod, slot, copy);
    }
  }
  search(groups[first / kLanes], last - first + 1, options);
  if (!elsewhere) {
    present.resize(shape.size() * rod.copyCount());
    rod.points(present.data());
  }
  bool all_valid = true;
  for (int copy = first; copy <= last; ++copy) {
    status[copy] = judge(rod, copy, options);
    all_valid = all_valid && status[copy] == ResponseStatus::VALID;
  }
  return all_valid;
}

void RodEquilibrium::State::configure(const Rod& rod) {
  const bool same_holds = sameHolds(holds, rod.holds()) && !held.empty();
  parameters = rod.parameters();
  holds = rod.holds();
  pieces = rod.pieces();
  natural = rod.naturalJoints();
  masses = rod.segmentMasses();
  if (!same_holds) {
    groups.clear();
    status.clear();
    describeHolds();
  }
  describeMaterial();
  connect();
}

void RodEquilibrium::State::describeHolds() {
  const int n = parameters.segments;
  clamped.assign(n, 0);
  span_of_joint.assign(n - 1, -1);
  spans.clear();
  held.clear();
  for (const HeldPoint& point : holds) {
    clamped[point.particle] = point.type == Hold::CLAMPED;
    if (!held.empty()) {
      std::fill(span_of_joint.begin() + held.back(), span_of_joint.begin() + point.particle,
                static_cast<int>(spans.size()));
      spans.push_back({held.back(), point.particle});
    }
    held.push_back(point.particle);
  }
}

void RodEquilibrium::State::describeMaterial() {
  input.segments = parameters.segments;
  flexural.clear();
  torsional.clear();
  extension.clear();
  for (double l : pieces->joint_lengths) {
    flexural.push_back(parameters.bendingStiffness() / l);
    torsional.push_back(parameters.torsionStiffness() / l);
    extension.push_back(stretches() ? l / parameters.axialStiffness() : 0.0);
  }
  const Vector3 weight = parameters.segmentMass() * parameters.gravity;
  std::copy(weight.data(), weight.data() + 3, input.weight);
  half_length.resize(parameters.segments);
  lean_weight.resize(parameters.segments);
  for (int i = 0; i < parameters.segments; ++i) {
    half_length[i] = 0.5 * pieces->lengths[i];
    lean_weight[i] = masses->moment[i] / (half_length[i] * parameters.segmentMass());
  }
  const bool spins = std::none_of(clamped.begin(), clamped.end(), [](unsigned char is) { return is != 0; });
  input.spin_stiffness = spins ? kSpinFraction * parameters.torsionStiffness() / pieces->usual : 0.0;
}

void RodEquilibrium::State::connect() {
  input.clamped = clamped.data();
  input.span_of_joint = span_of_joint.data();
  input.spans = spans.data();
  input.span_count = static_cast<int>(spans.size());
  input.held = held.data();
  input.half_length = half_length.data();
  input.flexural = flexural.data();
  input.torsional = torsional.data();
  input.extension = extension.data();
  input.weights_before = masses->before.data();
  input.lean_weight = lean_weight.data();
  input.natural_ahead = natural->empty() ? nullptr : natural->ahead.data();
  input.natural_behind = natural->behind.data();
  input.natural_twist = natural->twist.data();
  input.held_count = static_cast<int>(held.size());
  shape.resize(3 * (parameters.segments + 1));
}

//! Takes over where the copy is held now.
void RodEquilibrium::State::hold(int slot, int copy) {
  const Vector3* positions = &held_positions[copy * holds.size()];
  if (slot == copy) {
    first_position[copy] = positions[0];
  }
  for (std::size_t i = 0; i < holds.size(); ++i) {
    if (clamped[holds[i].particle]) {
      setOrientation(holds[i].particle, slot, holds[i].pose.orientation.coeffs().data());
    }
    if (i > 0) {
      setVector(&RodEquilibriumLanes::reach, static_cast<int>(i) - 1, slot, positions[i] - positions[i - 1]);
    }
  }
}

//! Begins the search at the simulated shape, with each span's weight shared by its ends.
void RodEquilibrium::State::startFrom(const Rod& rod, int slot, int copy) {
  std::vector<double> orientations(4 * parameters.segments);
  rod.orientations(elsewhere ? 0 : copy, orientations.data());
  for (int i = 0; i < parameters.segments; ++i) {
    if (!clamped[i] || (elsewhere && !turned)) {  // clamped ones are where they are held
      setOrientation(i, slot, &orientations[4 * i]);
    }
  }
  std::vector<double> twists(parameters.segments - 1);
  rod.twists(elsewhere ? 0 : copy, twists.data());
  AlignedArray& twist = groups[slot / kLanes].twist;
  for (std::size_t i = 0; i < twists.size(); ++i) {
    twist[i * kLanes + slot % kLanes] = twists[i];
  }
  const Vector3 weight(input.weight[0], input.weight[1], input.weight[2]);
  for (std::size_t span = 0; span < spans.size(); ++span) {
    const double joints = masses->before[spans[span].last] - masses->before[spans[span].first];
    const Vector3 reach = vector(&RodEquilibriumLanes::reach, static_cast<int>(span), slot);
    const Vector3 half = 0.5 * joints * weight;
    const Vector3 pull = half.norm() / (reach.norm() + 1e-9) * reach;
    setVector(&RodEquilibriumLanes::force, static_cast<int>(span), slot, half + pull);
  }
}

void RodEquilibrium::State::search(RodEquilibriumLanes& lanes, int copies, const EquilibriumOptions& options) {
  const RodEquilibriumKernel kernel = selectedRodEquilibriumKernel();
  const auto moves = [&](double change) { return !(change < options.tolerance) && std::isfinite(change); };
  int steps = 0;
  do {
    kernel.step(input, lanes, copies);
    ++steps;
  } while (steps < options.iterations && std::any_of(lanes.change.begin(), lanes.change.begin() + copies, moves));
  iterations = std::max(iterations, steps);
  kernel.respond(input, lanes, copies);
  lanes.last_reach = lanes.reach;
}

ResponseStatus RodEquilibrium::State::judge(const Rod& rod, int copy, const EquilibriumOptions& options) {
  const RodEquilibriumLanes& lanes = groups[copy / kLanes];
  if (outOfReach(copy)) {
    return ResponseStatus::OUT_OF_REACH;
  }
  if (!(lanes.change[copy % kLanes] < options.tolerance)) {
    return ResponseStatus::NOT_CONVERGED;
  }
  if (lanes.unstable[copy % kLanes] != 0.0 || swingsFreely(copy)) {
    return ResponseStatus::UNSTABLE;
  }
  if (elsewhere) {
    return ResponseStatus::VALID;
  }
  if (!isTwistedAs(rod, copy)) {
    return ResponseStatus::OTHER_SHAPE;
  }
  points(copy, shape.data());
  double farthest = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    farthest = std::max(farthest, std::abs(shape[i] - present[copy * shape.size() + i]));
  }
  return farthest < kFarFromEquilibrium * parameters.length ? ResponseStatus::VALID : ResponseStatus::OTHER_SHAPE;
}

//! Whether it has the turns of the simulated rod: it misses those that a hold makes while nobody asks for the shape.
bool RodEquilibrium::State::isTwistedAs(const Rod& rod, int copy) const {
  std::vector<double> twists(parameters.segments - 1);
  rod.twists(copy, twists.data());
  const double* at = &groups[copy / kLanes].twist[copy % kLanes];
  double difference = 0.0;
  for (std::size_t i = 0; i < twists.size(); ++i) {
    difference += at[i * kLanes] - twists[i];
  }
  return std::abs(difference) < kOtherTurns;
}

bool RodEquilibrium::State::outOfReach(int copy) const {
  if (stretches()) {
    return false;
  }
  for (std::size_t span = 0; span < spans.size(); ++span) {
    const double longest = pieces->between(spans[span].first, spans[span].last);
    if (!(vector(&RodEquilibriumLanes::reach, static_cast<int>(span), copy).norm() < kReach * longest)) {
      return true;
    }
  }
  return false;
}

bool RodEquilibrium::State::swingsFreely(int copy) const {
  const AlignedArray& response = groups[copy / kLanes].response;
  for (std::size_t i = copy % kLanes; i < response.size(); i += kLanes) {
    if (!(std::abs(response[i]) < kLargestResponse)) {
      return true;
    }
  }
  return false;
}

void RodEquilibrium::State::points(int copy, double* to) const {
  const int n = parameters.segments;
  const auto write = [to](int point, const Vector3& x) { std::copy(x.data(), x.data() + 3, to + 3 * point); };
  const auto opening = [&](int joint) {  // of an extensible rod, between two segments
    const Vector3 d = tangentOf(joint, copy);
    return Vector3(extension[joint] * d.dot(jointForce(joint, copy)) * d);
  };
  Vector3 end = first_position[copy] + half_length[held.front()] * tangentOf(held.front(), copy);
  for (int i = held.front(); i + 1 < n; ++i) {
    const Vector3 gap = opening(i);
    write(i + 1, end + 0.5 * gap);
    end += gap + pieces->lengths[i + 1] * tangentOf(i + 1, copy);
  }
  write(n, end);
  end = first_position[copy] - half_length[held.front()] * tangentOf(held.front(), copy);
  for (int i = held.front(); i > 0; --i) {
    const Vector3 gap = opening(i - 1);
    write(i, end - 0.5 * gap);
    end -= gap + pieces->lengths[i - 1] * tangentOf(i - 1, copy);
  }
  write(0, end);
}

//! [N] on the joint's first segment.
Vector3 RodEquilibrium::State::jointForce(int joint, int copy) const {
  const Vector3 weight(input.weight[0], input.weight[1], input.weight[2]);
  const double before = masses->before[joint + 1];
  const int span = span_of_joint[joint];
  if (span >= 0) {
    return vector(&RodEquilibriumLanes::force, span, copy) - (before - masses->before[spans[span].first + 1]) * weight;
  }
  return (joint < held.front() ? -before : masses->before.back() - before) * weight;
}

}  // namespace pbd
}  // namespace deformable_manipulation
