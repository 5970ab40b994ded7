#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

namespace deformable_manipulation {
namespace pbd {

using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Quaternion = Eigen::Quaterniond;

//! How an agent holds a particle.
enum class Hold {
  CLAMPED,  //!< position and orientation follow the agent
  PINNED    //!< the position follows the agent, the orientation is free
};

//! Position [m] and orientation of a held particle in the fixed frame.
struct Pose {
  Vector3 position = Vector3::Zero();
  Quaternion orientation = Quaternion::Identity();
};

//! Linear [m/s] and angular [rad/s] velocity in the fixed frame.
struct Twist {
  Vector3 linear = Vector3::Zero();
  Vector3 angular = Vector3::Zero();
};

//! Force [N] and torque about the held point [N m] that the object exerts on an agent.
struct Wrench {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();

  //! Force, then torque.
  Vector6 numbers() const { return (Vector6() << force, torque).finished(); }
};

//! A material parameter by the name it has in the scenario file.
struct MaterialParameter {
  std::string key;
  double value;
};

//! The pose after a time [s] of constant velocity.
inline Pose moved(const Pose& pose, const Twist& twist, double time) {
  Pose result = pose;
  result.position += time * twist.linear;
  const double angle = time * twist.angular.norm();
  if (angle > 0.0) {
    const Eigen::AngleAxisd rotation(angle, twist.angular.normalized());
    result.orientation = (Quaternion(rotation) * pose.orientation).normalized();
  }
  return result;
}

}  // namespace pbd
}  // namespace deformable_manipulation
