#include "deformable_manipulation/pbd/rest_shapes.h"

#include <algorithm>
#include <functional>

namespace deformable_manipulation {
namespace pbd {

void RestShapes::setPresent(const double* points, const double* correction) {
  correction_.clear();
  if (correction == nullptr) {
    placePresent(points);
    return;
  }
  const std::ptrdiff_t numbers = 3 * static_cast<std::ptrdiff_t>(pointCount());
  correction_.assign(correction, correction + numbers);
  model_present_.resize(correction_.size());
  std::transform(points, points + numbers, correction, model_present_.begin(), std::minus<>());
  placePresent(model_present_.data());
}

void RestShapes::points(int shape, double* to) const {
  readPoints(shape, to);
  std::transform(correction_.begin(), correction_.end(), to, to, std::plus<>());
}

}  // namespace pbd
}  // namespace deformable_manipulation
