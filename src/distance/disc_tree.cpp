#include "disc_tree.h"

namespace deformable_manipulation {
namespace distance {

void DiscNode::set(int slot, const std::vector<Corners<3>>& triangles) {
  Vector3 normals = Vector3::Zero(), sum = Vector3::Zero();
  for (const Corners<3>& t : triangles) {
    normals += (t[1] - t[0]).cross(t[2] - t[0]);
    sum += t[0] + t[1] + t[2];
  }
  const double length = normals.norm();
  const Eigen::Vector3f unit = (length > 0.0 ? Vector3(normals / (length * (1.0 + 1e-7))) : normals).cast<float>();
  const Eigen::Vector3f centre = (sum / (3.0 * triangles.size())).cast<float>();
  const Vector3 normal = unit.cast<double>(), middle = centre.cast<double>();
  double thickness = 0.0, squared_radius = 0.0;
  for (const Corners<3>& t : triangles) {
    for (const Vector3& corner : t) {
      const Vector3 arm = corner - middle;
      const double along = normal.dot(arm);
      thickness = std::max(thickness, std::fabs(along));
      squared_radius = std::max(squared_radius, (arm - along * normal).squaredNorm());
    }
  }
  for (int k = 0; k < 3; ++k) {
    normal_[k][slot] = unit[k];
    centre_[k][slot] = centre[k];
  }
  const float rounding = 4e-7F * centre.lpNorm<1>();
  half_thickness_[slot] = static_cast<float>(thickness) * (1.0F + 1e-6F) + rounding;
  radius_[slot] = static_cast<float>(std::sqrt(squared_radius)) * (1.0F + 1e-6F) + rounding;
}

}  // namespace distance
}  // namespace deformable_manipulation
