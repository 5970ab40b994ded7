#include "state_message.h"

#include <algorithm>

namespace deformable_manipulation {
namespace {

template <typename Vector>
void append(std::vector<double>& to, const Vector& vector) {
  to.insert(to.end(), vector.data(), vector.data() + vector.size());
}

void fillAgents(const pbd::Simulation& simulation, ObjectState& message) {
  message.agents.clear();
  message.agent_particles.clear();
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
  message.object_type = ObjectState::ROD;
  message.particle_count = body.particleCount();
  message.point_count = body.pointCount();
  fillAgents(simulation, message);
  fillCopies(simulation, message);
  message.points.resize(3 * body.pointCount() * body.copyCount());
  body.points(message.points.data());
  message.velocities.resize(3 * body.particleCount());
  body.velocities(0, message.velocities.data());
  message.orientations.resize(4 * body.particleCount());
  if (!body.orientations(0, message.orientations.data())) {
    message.orientations.clear();
    message.object_type = ObjectState::FABRIC;
  }
}

geometry_msgs::WrenchStamped toWrench(const pbd::Wrench& wrench, const ros::Time& stamp, const std::string& frame) {
  geometry_msgs::WrenchStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.wrench.force.x = wrench.force.x();
  message.wrench.force.y = wrench.force.y();
  message.wrench.force.z = wrench.force.z();
  message.wrench.torque.x = wrench.torque.x();
  message.wrench.torque.y = wrench.torque.y();
  message.wrench.torque.z = wrench.torque.z();
  return message;
}

geometry_msgs::PoseStamped toPose(const pbd::Pose& pose, const ros::Time& stamp, const std::string& frame) {
  geometry_msgs::PoseStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = frame;
  message.pose.position.x = pose.position.x();
  message.pose.position.y = pose.position.y();
  message.pose.position.z = pose.position.z();
  message.pose.orientation.x = pose.orientation.x();
  message.pose.orientation.y = pose.orientation.y();
  message.pose.orientation.z = pose.orientation.z();
  message.pose.orientation.w = pose.orientation.w();
  return message;
}

}  // namespace deformable_manipulation
