#include "deformable_manipulation/control/features.h"

#include <algorithm>

namespace deformable_manipulation {
namespace control {

void Features::take(const distance::Distances& distances, int agents, bool nearest_only) {
  const int count = std::min(distances.offsets[1], nearest_only ? 1 : distances.offsets[1]);
  agents_ = agents;
  distance.clear();
  normal.clear();
  obstacle_velocity.clear();
  identity.clear();
  for (int m = 0; m < count; ++m) {
    distance.push_back(distances.features[m].distance);
    normal.push_back(distances.features[m].normal);
    obstacle_velocity.push_back(distances.features[m].obstacle_velocity);
    identity.push_back(distances.features[m].identity);
  }
  disturbance.assign(count, 0.0);
  gradients_.assign(static_cast<std::size_t>(count) * agents, Vector3::Zero());
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
