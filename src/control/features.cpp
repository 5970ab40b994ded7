#include "deformable_manipulation/control/features.h"

#include <algorithm>

namespace deformable_manipulation {
namespace control {

int ChosenFeatures::count() const { return std::min(most, distances.offsets[copy + 1] - distances.offsets[copy]); }

void Features::clear() {
  distance.clear();
  normal.clear();
  obstacle_velocity.clear();
  identity.clear();
  disturbance.clear();
  parting.clear();
  gradients_.clear();
  turns_.clear();
}

void Features::take(const ChosenFeatures& chosen, int agents) {
  const int count = chosen.count();
  clear();
  agents_ = agents;
  for (int m = 0; m < count; ++m) {
    const distance::Feature& feature = chosen.first()[m];
    distance.push_back(feature.distance);
    normal.push_back(feature.normal);
    obstacle_velocity.push_back(feature.obstacle_velocity);
    identity.push_back(feature.identity);
  }
  disturbance.assign(count, 0.0);
  parting.assign(count, 0.0);
  gradients_.assign(static_cast<std::size_t>(count) * agents, Vector3::Zero());
}

void Features::add(double signed_distance, const Vector3& direction, std::int64_t of,
                   const std::vector<Vector3>& gradients) {
  distance.push_back(signed_distance);
  normal.push_back(direction);
  obstacle_velocity.push_back(Vector3::Zero());
  identity.push_back(of);
  disturbance.push_back(0.0);
  parting.push_back(0.0);
  gradients_.insert(gradients_.end(), gradients.begin(), gradients.end());
}

void Features::completeLeader(int leader) {
  for (int m = 0; m < size(); ++m) {
    Vector3 rest = normal[m];
    for (int agent = 0; agent < agents_; ++agent) {
      if (agent != leader) {
        rest -= gradient(m, agent);
      }
    }
    gradient(m, leader) = rest;
  }
}

}  // namespace control
}  // namespace deformable_manipulation
