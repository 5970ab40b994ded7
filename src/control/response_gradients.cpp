#include "deformable_manipulation/control/response_gradients.h"

namespace deformable_manipulation {
namespace control {

void takeResponseGradients(const ChosenFeatures& chosen, const Response& response, int leader, Features& features) {
  using Derivative = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  features.take(chosen, response.agents);
  const distance::Feature* first = chosen.first();
  for (int m = 0; m < features.size(); ++m) {
    for (int agent = 0; agent < response.agents; ++agent) {
      for (int k = 0; k < 3 && agent != leader; ++k) {
        const long point = static_cast<long>(agent) * response.points + first[m].vertices[k];
        const Derivative derivative(response.derivatives + 9 * point);
        features.gradient(m, agent) += first[m].weights[k] * (derivative.transpose() * features.normal[m]);
      }
    }
  }
  features.completeLeader(leader);
  if (response.turns == nullptr) {
    return;
  }
  features.takeTurns();
  for (int m = 0; m < features.size(); ++m) {
    for (int agent = 0; agent < response.agents; ++agent) {
      for (int k = 0; k < 3; ++k) {
        const long point = static_cast<long>(agent) * response.points + first[m].vertices[k];
        features.turn(m, agent) +=
            first[m].weights[k] * (Derivative(response.turns + 9 * point).transpose() * features.normal[m]);
      }
    }
  }
}

}  // namespace control
}  // namespace deformable_manipulation
