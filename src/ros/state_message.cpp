#include "state_message.h"

#include <algorithm>

#include "object_kinds.h"

namespace deformable_manipulation {
namespace {

template <typename Vector>
void append(std::vector<double>& to, const Vector& vector) {
  to.insert(to.end(), vector.data(), vector.data() + vector.size());
}

template <typename Message>
void assign(const pbd::Vector3& from, Message& to) {
  to.x = from.x();
  to.y = from.y();
  to.z = from.z();
}

//! Particles that an agent's grip holds besides the one at its point.
void fillFurtherParticles(const pbd::Simulation& simulation, int agent, ObjectState& message) {
  const int grip = simulation.particleOf(agent);
  for (const pbd::HeldPoint& held : simulation.body().holds()) {
    if (held.grip == grip && !held.leads()) {
      message.further_particles.push_back(held.particle);
      message.further_agents.push_back(agent);
    }
  }
}

void fillAgents(const pbd::Simulation& simulation, ObjectState& message) {
  message.agents.clear();
  message.agent_particles.clear();
  message.further_particles.clear();
  message.further_agents.clear();
  message.agent_positions.clear();
  message.agent_orientations.clear();
  message.agent_velocities.clear();
  message.agent_angular_velocities.clear();
  for (std::size_t i = 0; i < simulation.agents().size(); ++i) {
    const int agent = static_cast<int>(i);
    const pbd::Pose& pose = simulation.pose(agent);
    const pbd::Twist& twist = simulation.twist(agent);
    message.agents.push_back(simulation.agents()[i].name);
    message.agent_particles.push_back(simulation.particleOf(agent));
    append(message.agent_positions, pose.position);
    append(message.agent_orientations, pose.orientation.coeffs());
    append(message.agent_velocities, twist.linear);
    append(message.agent_angular_velocities, twist.angular);
    fillFurtherParticles(simulation, agent, message);
  }
}

void fillCopies(const pbd::Simulation& simulation, ObjectState& message) {
  message.displaced_agents.assign(1, -1);
  message.displacements.assign(3, 0.0);
  message.copy_ready.assign(1, true);
  for (const pbd::PerturbedCopy& copy : simulation.body().copies()) {
    message.displaced_agents.push_back(simulation.agentOf(copy.particle));
    append(message.displacements, copy.present);
    message.copy_ready.push_back(copy.ready());
  }
}

}  // namespace

void fillState(const pbd::Simulation& simulation, const ros::Time& stamp, const std::string& frame,
               ObjectState& message) {
  const pbd::Body& body = simulation.body();
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.cycle = simulation.cycle();
  message.reset_count = simulation.resetCount();
  message.object_type = objectKind(body.kind()).type;
  message.particle_count = body.particleCount();
  message.point_count = body.pointCount();
  fillAgents(simulation, message);
  fillCopies(simulation, message);
  message.points.resize(3 * body.pointCount() * body.copyCount());
  simulation.points(message.points.data());
  message.correction.clear();
  if (simulation.correction() != nullptr) {
    message.correction = simulation.correction()->field();
  }
  message.velocities.resize(3 * body.particleCount());
  body.velocities(0, message.velocities.data());
  message.orientations.resize(4 * body.particleCount());
  if (!body.orientations(0, message.orientations.data())) {
    message.orientations.clear();
  }
}

pbd::ResponseStatus fillSensitivities(pbd::Simulation& simulation, ObjectState& message) {
  message.sensitivities.resize(9 * simulation.agents().size() * simulation.body().pointCount());
  const pbd::ResponseStatus status = simulation.response(message.sensitivities.data());
  if (status != pbd::ResponseStatus::VALID) {
    message.sensitivities.clear();
  }
  return status;
}

void fillTurningSensitivities(const pbd::Simulation& simulation, ObjectState& message) {
  message.turning_sensitivities.resize(message.sensitivities.size());
  if (message.sensitivities.empty() || !simulation.turningResponse(message.turning_sensitivities.data())) {
    message.turning_sensitivities.clear();
  }
}

void fillWrenches(const pbd::Simulation& simulation, ObjectState& message) {
  const std::size_t agents = simulation.agents().size();
  message.wrenches.resize(6 * agents * simulation.body().copyCount());
  simulation.wrenches(message.wrenches.data());
  message.wrench_sensitivities.resize(36 * agents * agents);
  if (message.sensitivities.empty() || !simulation.wrenchResponse(message.wrench_sensitivities.data())) {
    message.wrench_sensitivities.clear();
  }
}

geometry_msgs::WrenchStamped toWrench(const pbd::Wrench& wrench, const ros::Time& stamp, const std::string& frame) {
  geometry_msgs::WrenchStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  assign(wrench.force, message.wrench.force);
  assign(wrench.torque, message.wrench.torque);
  return message;
}

geometry_msgs::PoseStamped toPose(const pbd::Pose& pose, const ros::Time& stamp, const std::string& frame) {
  geometry_msgs::PoseStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  assign(pose.position, message.pose.position);
  assign(pose.orientation.vec(), message.pose.orientation);
  message.pose.orientation.w = pose.orientation.w();
  return message;
}

}  // namespace deformable_manipulation
