#include "deformable_manipulation/pbd/fabric.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <utility>

#include "fabric_constraints.h"
#include "fabric_kernel.h"
#include "fabric_layout.h"
#include "fabric_mesh.h"
#include "fabric_response.h"
#include "fabric_weights.h"
#include "lane_groups.h"
#include "reference_motion.h"
#include "surface_distance.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// Times the compliance of the material: less is none that could be seen.
constexpr double kTrueStiffness = 1.05;
constexpr int kMostSubsteps = 10000;

//! 1/s. Rest lengths adapt slowly, for they must not feed energy into vibrations faster than damping takes it away.
double adaptationRate(double damping) { return std::min(1.0, 0.1 * damping); }

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
        groups(FabricLanes(static_cast<int>(p.vertices.size()), static_cast<int>(edges.size()))),
        decay(p.vertices.size()),
        carried(3 * p.vertices.size()),
        pool(std::make_shared<ThreadPool>(p.threads)),
        motions(p.vertices.size()) {
    selectedFabricKernel();  // the first time, that reads the environment
    recorded.emplace_back(constraints.recordedSize());
  }

  std::vector<MeshEdge> edges;
  SurfaceDistance distances;
  std::vector<double> masses, inverse_mass;
  FabricConstraints constraints;
  double constraints_for = 0.0;  // s, substep for which the constraints' gains are up to date; 0: none
  LaneGroups<FabricLanes, HeldVertex> groups;
  Eigen::MatrixXd weights;                              // [N x holds] how each vertex goes with the holds
  std::vector<std::vector<double>> distances_of_holds;  // [holds x N] m, unless straight
  std::vector<double> decay, carried;
  std::vector<double> shape;           // [N x 3] m, for the response
  std::vector<double> forces;          // [N x 3] N, at held vertices, likewise
  std::vector<AlignedArray> recorded;  // [groups] of the last substep
  FabricInput input{};
  std::shared_ptr<ThreadPool> pool;  // shared with clones
  std::vector<PointMotion> motions;  // [N] scratch
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

double Fabric::effectiveCompliance(double substep) const {
  FabricConstraints constraints = state_->constraints;
  std::vector<double> inverse_mass(state_->masses.size());
  std::transform(state_->masses.begin(), state_->masses.end(), inverse_mass.begin(), [](double m) { return 1.0 / m; });
  constraints.update(inverse_mass, parameters_.stretching_compliance, parameters_.bending_compliance,
                     parameters_.damping, substep);
  return constraints.stretchingCompliance();
}

int Fabric::substepsForStiffness(double time_step, int least, int most) const {
  const auto soft = [&](int substeps) {
    return effectiveCompliance(time_step / substeps) > kTrueStiffness * parameters_.stretching_compliance;
  };
  if (!soft(least) || soft(most)) {
    return soft(least) ? most : least;
  }
  int too_few = least;
  for (int enough = most; enough - too_few > 1;) {
    const int middle = too_few + (enough - too_few) / 2;
    (soft(middle) ? too_few : enough) = middle;
    most = enough;
  }
  return most;
}

std::string Fabric::softness(double time_step, int substeps) const {
  const double material = parameters_.stretching_compliance;
  const double effective = effectiveCompliance(time_step / substeps);
  if (effective <= kTrueStiffness * material) {
    return "";
  }
  std::ostringstream text;
  text << std::setprecision(3) << "object.stretching_compliance: with " << substeps
       << " substeps this mesh behaves like one of " << effective << " m/N instead of " << material << " m/N.";
  const int enough = substepsForStiffness(time_step, substeps, kMostSubsteps);
  if (effectiveCompliance(time_step / enough) <= kTrueStiffness * material) {
    text << " simulation.substeps: " << enough << " keeps the true stiffness and takes "
         << static_cast<double>(enough) / substeps << " times as long; a coarser mesh needs fewer.";
  } else {
    text << " More simulation.substeps or a coarser mesh bring it closer to that.";
  }
  return text.str();
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

Pose Fabric::undeformedPose(int particle) const {
  requireParticle(particle);
  const Pose& pose = parameters_.pose;
  return {pose.position + pose.orientation * parameters_.vertices[particle], pose.orientation};
}

double Fabric::mass() const { return std::accumulate(state_->masses.begin(), state_->masses.end(), 0.0); }

double Fabric::stretch() const {
  std::vector<Vector3> vertices(parameters_.vertices.size());
  positions(0, vertices.front().data());
  return meanElongation(state_->edges, vertices);
}

Pose Fabric::pose(int particle) const {
  requireParticle(particle);
  return {state_->groups.read(&FabricLanes::position, particle), Quaternion::Identity()};
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
  s.groups.resize(*this);
}

void Fabric::resizeCopies() {
  state_->groups.resize(*this);
  state_->recorded.resize(state_->groups.size(), state_->recorded.front());
}

void Fabric::assignCopy(int to, int from) { state_->groups.assign(to, from); }

void Fabric::layOut() {
  State& s = *state_;
  const std::vector<Vector3> vertices = layOutFabric(parameters_, s.edges, holds(), s.weights);
  for (FabricLanes& lanes : s.groups.all()) {
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

void Fabric::placeState(const double* points, const double* velocities) {
  FabricLanes& lanes = state_->groups[0];
  for (int i = 0; i < pointCount(); ++i) {
    write3(lanes.position, i, 0, Eigen::Map<const Vector3>(points + 3 * i));
    write3(lanes.previous_position, i, 0, Eigen::Map<const Vector3>(points + 3 * i));
    write3(lanes.velocity, i, 0, Eigen::Map<const Vector3>(velocities + 3 * i));
  }
}

void Fabric::stop() { state_->groups.fill(&FabricLanes::velocity, 0.0); }

void Fabric::displace(int particle, const Vector3& by) {
  state_->groups.displace(&FabricLanes::position, particle, by);
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
      s.motions[i] = {s.masses[i], s.groups.read(&FabricLanes::position, i), s.groups.read(&FabricLanes::velocity, i)};
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
  if (state_->groups.note(*this, [](const HeldPoint& held, HeldVertex* to) { to->vertex = held.particle; })) {
    endStep();
  }
}

void Fabric::endStep() {
  State& s = *state_;
  const int substeps = s.groups.pending();
  s.groups.advance(*this, *s.pool, [&](int, int group, int copies) {
    FabricInput input = s.input;
    input.held = s.groups.held(0, group, *this);
    input.recorded = s.recorded[group].data();
    input.adaptation = 1.0 - std::exp(-substeps * s.input.h * adaptationRate(parameters_.damping));
    selectedFabricKernel().advance(input, copies, substeps, s.groups[group]);
  });
  for (std::size_t i = 0; i < s.carried.size(); ++i) {
    s.carried[i] += substeps * s.input.carried_change[i % 3];
  }
}

Wrench Fabric::wrench(int particle, int copy) const {
  held(particle);
  Wrench wrench;
  wrench.force = state_->masses[particle] * parameters_.gravity +
                 state_->constraints.force(particle, state_->recorded[copy / kLanes].data() + copy % kLanes);
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

bool Fabric::turningResponse(double* to) const { return response_ != nullptr && response_->turns(to); }

bool Fabric::wrenchResponse(double* to) const {
  State& s = *state_;
  if (response_ == nullptr) {
    return false;
  }
  s.forces.assign(s.shape.size(), 0.0);
  for (const HeldPoint& held : holds()) {
    Eigen::Map<Vector3>(&s.forces[3 * held.particle]) = wrench(held.particle).force;
  }
  return response_->wrenches(s.constraints, s.shape.data(), s.forces.data(), to);
}

void Fabric::points(double* to) const {
  for (int copy = 0; copy < copyCount(); ++copy, to += 3 * pointCount()) {
    positions(copy, to);
  }
}

void Fabric::positions(int copy, double* to) const { state_->groups.unpack(&FabricLanes::position, copy, to); }

void Fabric::velocities(int copy, double* to) const { state_->groups.unpack(&FabricLanes::velocity, copy, to); }

bool Fabric::orientations(int, double*) const { return false; }

int Fabric::firstNonFinite(int copy) const {
  const FabricLanes& lanes = state_->groups.of(copy);
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
      highest = std::max(highest, state_->groups.read(&FabricLanes::velocity, i, copy).norm());
    }
  }
  return highest;
}

}  // namespace pbd
}  // namespace deformable_manipulation
