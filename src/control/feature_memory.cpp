#include "deformable_manipulation/control/feature_memory.h"

#include <algorithm>

namespace deformable_manipulation {
namespace control {

namespace {

constexpr double SPAN = 0.1;            // [s] a nearest point that is so old is another one by now
constexpr double TIME_ROUNDING = 1e-6;  // [s] of times, which are whole cycles
constexpr double SLACK = 0.02;          // [m] by which it then counts as farther away: no row ends suddenly
constexpr double SAME = 0.1;  // [1] of gradients and normals: the solution of nearly parallel rows depends on rounding

}  // namespace

//! Whether a row says the same. Its element does not tell: which of two neighbours is found, that share the nearest
//! point, depends on rounding, and controllers in different processes would come to different plans.
bool FeatureMemory::isFoundAgain(const Kept& kept, const Features& features) {
  for (int m = 0; m < features.size(); ++m) {
    double difference = (features.normal[m] - kept.normal).cwiseAbs().maxCoeff();
    for (int agent = 0; agent < features.agents(); ++agent) {
      difference = std::max(difference, (features.gradient(m, agent) - kept.gradients[agent]).cwiseAbs().maxCoeff());
    }
    if (difference < SAME) {
      return true;
    }
  }
  return false;
}

void FeatureMemory::recall(double time, const Vector3* held, Features& features) {
  const auto old = [&](const Kept& kept) {
    return isFoundAgain(kept, features) || time - kept.time > SPAN + TIME_ROUNDING || time < kept.time;
  };
  kept_.erase(std::remove_if(kept_.begin(), kept_.end(), old), kept_.end());
  const int found = features.size();
  for (const Kept& kept : kept_) {
    const double age = (time - kept.time) / SPAN;
    double distance = kept.distance + SLACK * age * age;
    for (int agent = 0; agent < features.agents(); ++agent) {
      distance += kept.gradients[agent].dot(held[agent] - kept.held[agent]);
    }
    features.add(distance, kept.normal, kept.identity, kept.gradients);
  }
  for (int m = 0; m < found; ++m) {
    Kept now{time, features.identity[m], features.distance[m], features.normal[m], {}, {}};
    for (int agent = 0; agent < features.agents(); ++agent) {
      now.gradients.push_back(features.gradient(m, agent));
      now.held.push_back(held[agent]);
    }
    kept_.push_back(std::move(now));
  }
}

}  // namespace control
}  // namespace deformable_manipulation
