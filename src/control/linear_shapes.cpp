#include "deformable_manipulation/control/linear_shapes.h"

#include <algorithm>
#include <utility>

namespace deformable_manipulation {
namespace control {

void LinearShapes::setResponse(std::vector<Vector3> held, const std::vector<double>& response) {
  held_ = std::move(held);
  response_ = response;
  points_ = static_cast<int>(response.size() / (9 * held_.size()));
}

void LinearShapes::readPoints(int shape, double* to) const {
  using Derivative = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  std::copy_n(present_, 3 * points_, to);
  const std::size_t agents = held_.size();
  for (std::size_t agent = 0; agent < agents; ++agent) {
    const Vector3 step = moved_[shape * agents + agent] - held_[agent];
    for (int point = 0; point < points_; ++point) {
      const Derivative derivative(&response_[9 * (agent * points_ + point)]);
      Eigen::Map<Vector3>(to + 3 * point) += derivative * step;
    }
  }
}

void LinearShapes::response(int /*shape*/, double* to) const { std::copy(response_.begin(), response_.end(), to); }

}  // namespace control
}  // namespace deformable_manipulation
