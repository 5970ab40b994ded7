#include "deformable_manipulation/pbd/fabric.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "fabric_constraints.h"
#include "fabric_kernel.h"
#include "fabric_layout.h"
#include "fabric_mesh.h"
#include "fabric_response.h"
#include "fabric_weights.h"
#include "reference_motion.h"
#include "surface_distance.h"
#include "thread_pool.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// Substeps that the threads do before they wait for each other.
constexpr int kSubstepsAtOnce = 16;

//! 1/s. Rest lengths adapt slowly, for they must not feed energy into vibrations faster than damping takes it away.
double adaptationRate(double damping) { return std::min(1.0, 0.1 * damping); }

FabricParameters checked(const FabricParameters& parameters) {
  ParameterCheck check;
  parameters.check(check);
  check.throwIfAny();
  return parameters;
}

//! [N] kg: a third of the mass of each triangle goes to each of its corners.
std::vector<double> lumpedMasses(const FabricParameters& p) {
  std::vector<double> masses(p.vertices.size(), 0.0);
  for (const Triangle& triangle : p.triangles) {
    for (int vertex : triangle) {
      masses[vertex] += p.density * triangleArea(p.vertices, triangle) / 3.0;
    }
  }
  return masses;
}

}  // namespace

struct Fabric::State {
  explicit State(const FabricParameters& p)
      : edges(meshEdges(p.vertices, p.triangles)),
        distances(p.vertices, p.triangles, edges),
        masses(lumpedMasses(p)),
        constraints(p.vertices, edges),
        decay(p.vertices.size()),
        carried(3 * p.vertices.size()),
        pool(std::make_shared<ThreadPool>(p.threads)),
        motions(p.vertices.size()) {
    selectedFabricKernel();  // the first time, that reads the environment
    recorded.emplace_back(constraints.recordedSize());
    groups.emplace_back(static_cast<int>(p.vertices.size()), static_cast<int>(edges.size()));
  }

  std::vector<MeshEdge> edges;
  SurfaceDistance distances;
  std::vector<double> masses, inverse_mass;
  FabricConstraints constraints;
  double constraints_for = 0.0;  // s, substep for which the constraints' gains are up to date; 0: none
  std::vector<FabricLanes> groups;
  Eigen::MatrixXd weights;                              // [N x holds] how each vertex goes with the holds
  std::vector<std::vector<double>> distances_of_holds;  // [holds x N] m, unless straight
  std::vector<double> decay, carried;
  std::vector<double> shape;           // [N x 3] m, for the response
  std::vector<HeldVertex> held;        // [kSubstepsAtOnce x groups x holds]
  int pending = 0;                     // substeps that are noted in it and still to be done
  std::vector<AlignedArray> recorded;  // [groups] of the last substep
  FabricInput input{};
  std::shared_ptr<ThreadPool> pool;  // shared with clones
  std::vector<PointMotion> motions;  // [N] scratch

  HeldVertex* heldIn(int substep, std::size_t group, std::size_t holds) {
    return held.data() + (substep * groups.size() + group) * holds;
  }
};

Fabric::Fabric(const FabricParameters& parameters) : parameters_(checked(parameters)), state_(new State(parameters_)) {
  holdsChanged();
  layOut();
}

Fabric::Fabric(const Fabric& other) : Body(other), parameters_(other.parameters_), state_(new State(*other.state_)) {}

Fabric::~Fabric() = default;

std::unique_ptr<Body> Fabric::clone() const { return std::unique_ptr<Body>(new Fabric(*this)); }

void Fabric::setMaterial(const std::vector<MaterialParameter>& parameters) {
  const FabricParameters& p = parameters_;
  std::pair<const char*, double> values[] = {{"stretching_compliance", p.stretching_compliance},
                                             {"bending_compliance", p.bending_compliance},
                                             {"damping", p.damping}};
  ParameterCheck check;
  for (const MaterialParameter& parameter : parameters) {
    const auto found = std::find_if(std::begin(values), std::end(values),
                                    [&](const auto& value) { return value.first == parameter.key; });
    check.require(found != std::end(values), parameter.key, parameter.value,
                  "stretching_compliance, bending_compliance or damping");
    if (found != std::end(values)) {
      found->second = parameter.value;
    }
  }
  checkFabricMaterial(values[0].second, values[1].second, values[2].second, check);
  check.throwIfAny();
  parameters_.stretching_compliance = values[0].second;
  parameters_.bending_compliance = values[1].second;
  parameters_.damping = values[2].second;
  state_->constraints_for = 0.0;
}

double Fabric::freeLength(int particle, int other) const {
  requireParticle(particle);
  requireParticle(other);
  const State& s = *state_;
  if (s.distances.straight()) {
    return s.distances.straightBetween(particle, other);
  }
  for (std::size_t h = 0; h < holds().size(); ++h) {
    if (holds()[h].particle == particle || holds()[h].particle == other) {
      return s.distances_of_holds[h][holds()[h].particle == particle ? other : particle];
    }
  }
  return s.distances.from(particle)[other];
}

double Fabric::mass() const { return std::accumulate(state_->masses.begin(), state_->masses.end(), 0.0); }

double Fabric::stretch() const {
  std::vector<Vector3> vertices(parameters_.vertices.size());
  positions(0, vertices.front().data());
  return meanElongation(state_->edges, vertices);
}

Pose Fabric::pose(int particle) const {
  requireParticle(particle);
  return {read3(state_->groups[0].position, particle, 0), Quaternion::Identity()};
}

void Fabric::holdsChanged() {
  State& s = *state_;
  s.inverse_mass.clear();
  for (double mass : s.masses) {
    s.inverse_mass.push_back(1.0 / mass);
  }
  std::vector<int> held;
  s.distances_of_holds.clear();
  for (const HeldPoint& hold : holds()) {
    held.push_back(hold.particle);
    s.inverse_mass[hold.particle] = 0.0;
    if (!s.distances.straight()) {
      s.distances_of_holds.push_back(s.distances.from(hold.particle));
    }
  }
  if (!held.empty()) {
    s.weights = holdWeights(parameters_.vertices, s.edges, held);
  }
  s.constraints_for = 0.0;
  response_.reset();
  resizeHeld();
}

void Fabric::resizeCopies() {
  const std::size_t groups = (copyCount() + kLanes - 1) / kLanes;
  while (state_->groups.size() > groups) {
    state_->groups.pop_back();
  }
  while (state_->groups.size() < groups) {
    state_->groups.push_back(state_->groups.front());
  }
  state_->recorded.resize(groups, state_->recorded.front());
  resizeHeld();
}

void Fabric::resizeHeld() { state_->held.resize(kSubstepsAtOnce * state_->groups.size() * holds().size()); }

void Fabric::assignCopy(int to, int from) {
  FabricLanes& target = state_->groups[to / kLanes];
  const FabricLanes& source = state_->groups[from / kLanes];
  for (AlignedArray FabricLanes::*array :
       {&FabricLanes::position, &FabricLanes::previous_position, &FabricLanes::velocity, &FabricLanes::rest_length}) {
    copyLane(target.*array, to % kLanes, source.*array, from % kLanes);
  }
}

void Fabric::layOut() {
  State& s = *state_;
  const std::vector<Vector3> vertices = layOutFabric(parameters_, s.edges, holds(), s.weights);
  for (FabricLanes& lanes : s.groups) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      for (int lane = 0; lane < kLanes; ++lane) {
        write3(lanes.position, static_cast<int>(i), lane, vertices[i]);
      }
    }
    lanes.previous_position = lanes.position;
    s.constraints.restLengths(lanes.rest_length);
  }
  for (AlignedArray& recorded : s.recorded) {
    std::fill(recorded.begin(), recorded.end(), 0.0);
  }
  stop();
}

void Fabric::stop() {
  for (FabricLanes& lanes : state_->groups) {
    std::fill(lanes.velocity.begin(), lanes.velocity.end(), 0.0);
  }
}

void Fabric::beginStep(double h) {
  State& s = *state_;
  if (s.constraints_for != h) {
    s.constraints.update(s.inverse_mass, parameters_.stretching_compliance, parameters_.bending_compliance,
                         parameters_.damping, h);
    s.constraints_for = h;
  }
  const double decay = std::exp(-parameters_.damping * h);
  for (std::size_t i = 0; i < s.decay.size(); ++i) {
    s.decay[i] = s.inverse_mass[i] > 0.0 ? decay : 1.0;
  }
  updateCarriedMotion();
  for (std::size_t i = 0; i < s.carried.size(); ++i) {
    s.carried[i] *= 1.0 - s.decay[i / 3];
  }
  FabricInput& in = s.input;
  in.vertices = particleCount();
  in.h = h;
  for (int axis = 0; axis < 3; ++axis) {
    in.gravity[axis] = parameters_.gravity[axis];
    // The rigid motion of a free fabric gains speed in each substep.
    in.carried_change[axis] = holds().empty() ? (1.0 - decay) * h * parameters_.gravity[axis] : 0.0;
  }
  in.decay = s.decay.data();
  in.carried = s.carried.data();
  in.hinges = s.constraints.hinges().data();
  in.hinge_count = static_cast<int>(s.constraints.hinges().size());
  in.boundaries = s.constraints.boundaries().data();
  in.boundary_count = static_cast<int>(s.constraints.boundaries().size());
  in.held_count = static_cast<int>(holds().size());
  in.held_stride = static_cast<int>(s.groups.size() * holds().size());
}

//! The motion that is not damped: that of the holds, blended, or the own rigid one of a free fabric.
void Fabric::updateCarriedMotion() {
  State& s = *state_;
  if (holds().empty()) {
    for (int i = 0; i < particleCount(); ++i) {
      s.motions[i] = {s.masses[i], read3(s.groups[0].position, i, 0), read3(s.groups[0].velocity, i, 0)};
    }
    rigidMotion(s.motions, s.carried.data());
    return;
  }
  std::fill(s.carried.begin(), s.carried.end(), 0.0);
  for (std::size_t h = 0; h < holds().size(); ++h) {
    for (std::size_t i = 0; i < s.carried.size(); ++i) {
      s.carried[i] += s.weights(static_cast<int>(i / 3), static_cast<int>(h)) * holds()[h].twist.linear[i % 3];
    }
  }
}

void Fabric::substep() {
  State& s = *state_;
  for (std::size_t group = 0; group < s.groups.size(); ++group) {
    HeldVertex* to = s.heldIn(s.pending, group, holds().size());
    for (const HeldPoint& held : holds()) {
      to->vertex = held.particle;
      for (int lane = 0; lane < kLanes; ++lane) {
        const int copy = static_cast<int>(group) * kLanes + lane;
        const Vector3 position = heldPosition(held, copy < copyCount() ? copy : 0);
        for (int axis = 0; axis < 3; ++axis) {
          to->position[axis * kLanes + lane] = position[axis];
        }
      }
      ++to;
    }
  }
  if (++s.pending == kSubstepsAtOnce) {
    endStep();
  }
}

void Fabric::endStep() {
  State& s = *state_;
  if (s.pending == 0) {
    return;
  }
  s.pool->run(static_cast<int>(s.groups.size()), [&](int, int group) {
    FabricInput input = s.input;
    input.held = s.heldIn(0, group, holds().size());
    input.recorded = s.recorded[group].data();
    input.adaptation = 1.0 - std::exp(-s.pending * s.input.h * adaptationRate(parameters_.damping));
    const int copies = std::min(copyCount() - group * kLanes, kLanes);
    selectedFabricKernel().advance(input, copies, s.pending, s.groups[group]);
  });
  for (std::size_t i = 0; i < s.carried.size(); ++i) {
    s.carried[i] += s.pending * s.input.carried_change[i % 3];
  }
  s.pending = 0;
}

Wrench Fabric::wrench(int particle) const {
  held(particle);
  Wrench wrench;
  wrench.force = state_->masses[particle] * parameters_.gravity +
                 state_->constraints.force(particle, state_->recorded.front().data());
  return wrench;
}

ResponseStatus Fabric::response(double* to) {
  State& s = *state_;
  if (holds().empty()) {
    return ResponseStatus::NOT_HELD;
  }
  if (s.constraints_for == 0.0) {
    return ResponseStatus::NOT_CONVERGED;
  }
  if (!response_) {
    response_ = std::make_unique<FabricResponse>(particleCount(), s.constraints, holds());
    s.shape.resize(3 * static_cast<std::size_t>(particleCount()));
  }
  positions(0, s.shape.data());
  return response_->compute(s.constraints, s.shape.data(), to);
}

void Fabric::points(double* to) const {
  for (int copy = 0; copy < copyCount(); ++copy, to += 3 * pointCount()) {
    positions(copy, to);
  }
}

void Fabric::positions(int copy, double* to) const {
  unpack(state_->groups[copy / kLanes].position, copy % kLanes, to);
}

void Fabric::velocities(int copy, double* to) const {
  unpack(state_->groups[copy / kLanes].velocity, copy % kLanes, to);
}

bool Fabric::orientations(int, double*) const { return false; }

int Fabric::firstNonFinite(int copy) const {
  const FabricLanes& lanes = state_->groups[copy / kLanes];
  if (lanes.finite[copy % kLanes] == 0.0) {
    return -1;
  }
  for (int i = 0; i < particleCount(); ++i) {
    if (!std::isfinite(read3(lanes.position, i, copy % kLanes).sum() + read3(lanes.velocity, i, copy % kLanes).sum())) {
      return i;
    }
  }
  return -1;
}

double Fabric::highestSpeed() const {
  double highest = 0.0;
  for (int copy = 0; copy < copyCount(); ++copy) {
    for (int i = 0; i < particleCount(); ++i) {
      highest = std::max(highest, read3(state_->groups[copy / kLanes].velocity, i, copy % kLanes).norm());
    }
  }
  return highest;
}

}  // namespace pbd
}  // namespace deformable_manipulation
