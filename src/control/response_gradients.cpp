#include "deformable_manipulation/control/response_gradients.h"

namespace deformable_manipulation {
namespace control {

void takeResponseGradients(const ObservationView& observation, int leader, bool nearest_only, Features& features) {
  using Response = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  const distance::Distances& distances = *observation.distances;
  features.take(distances, observation.agents, nearest_only);
  for (int m = 0; m < features.size(); ++m) {
    for (int agent = 0; agent < observation.agents; ++agent) {
      const distance::Feature& feature = distances.features[m];
      for (int k = 0; k < 3 && agent != leader; ++k) {
        const long point = static_cast<long>(agent) * observation.points + feature.vertices[k];
        const Response response(observation.sensitivities + 9 * point);
        features.gradient(m, agent) += feature.weights[k] * (response.transpose() * features.normal[m]);
      }
    }
  }
  features.completeLeader(leader);
}

}  // namespace control
}  // namespace deformable_manipulation
