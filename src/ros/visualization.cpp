#include "visualization.h"

#include <tf2_msgs/TFMessage.h>

#include <algorithm>

namespace deformable_manipulation {
namespace {

constexpr std::chrono::microseconds kPeriod(40000);
constexpr std::chrono::microseconds kPeriodPerTriangle(30);

}  // namespace

Visualization::Visualization(ros::NodeHandle& node, std::unique_ptr<ObjectDrawing> drawing, const std::string& leader,
                             std::string tf_prefix)
    : object_(std::move(drawing), leader),
      trails_(leader),
      tf_prefix_(std::move(tf_prefix)),
      markers_(node.advertise<visualization_msgs::MarkerArray>("markers", 4)),
      transforms_(node.advertise<tf2_msgs::TFMessage>("/tf", 10)),
      period_(std::max(kPeriod, kPeriodPerTriangle * object_.triangleCount())) {}

void Visualization::show(const ObjectState& state) {
  trails_.add(state);  // every state, so that a trail does not depend on the machine's speed
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < period_) {
    return;
  }
  last_ = now;
  if (markers_.getNumSubscribers() > 0) {
    markers_.publish(object_.draw(state));
    markers_.publish(trails_.draw());
  }
  // Whoever has a transform already complains when it comes again.
  const std::uint32_t listeners = transforms_.getNumSubscribers();
  if (listeners > 0 && (state.header.stamp != transforms_stamp_ || listeners != listeners_)) {
    transforms_stamp_ = state.header.stamp;
    sendTransforms(state);
  }
  listeners_ = listeners;
}

void Visualization::sendTransforms(const ObjectState& state) {
  tf2_msgs::TFMessage message;
  for (std::size_t i = 0; i < state.agents.size(); ++i) {
    geometry_msgs::TransformStamped transform;
    transform.header = state.header;
    transform.child_frame_id = tf_prefix_ + state.agents[i];
    const double* p = &state.agent_positions[3 * i];
    const double* q = &state.agent_orientations[4 * i];
    transform.transform.translation.x = p[0];
    transform.transform.translation.y = p[1];
    transform.transform.translation.z = p[2];
    transform.transform.rotation.x = q[0];
    transform.transform.rotation.y = q[1];
    transform.transform.rotation.z = q[2];
    transform.transform.rotation.w = q[3];
    message.transforms.push_back(transform);
  }
  transforms_.publish(message);
}

}  // namespace deformable_manipulation
