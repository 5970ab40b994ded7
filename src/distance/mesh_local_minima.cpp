#include "mesh_local_minima.h"

#include <algorithm>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kLevel = 1e-9;  // m, differences of distance below it count as none
constexpr double kZero = 1e-12;  // weights below it
constexpr int kNotKept = -2;     // in place of a triangle

Vector3 pointOf(const ObjectTree& object, const MeshPlace& place) {
  return weighted<3>(object.corners<3>(place.element), place.weights);
}

bool has(const Triangle& element, const MeshPlace& place) {
  for (int k = 0; k < 3; ++k) {
    if (place.weights[k] > kZero && std::find(element.begin(), element.end(), place.vertices[k]) == element.end()) {
      return false;
    }
  }
  return true;
}

bool isLocalMinimum(const ObjectTree& object, const std::vector<MeshPlace>& places, const MeshPlace& place) {
  const int k = static_cast<int>(std::max_element(place.weights.begin(), place.weights.end()) - place.weights.begin());
  const int point = place.vertices[k];
  for (int i = object.firstOf(point); i < object.firstOf(point + 1); ++i) {
    const int other = object.elementOf(i);
    if (other == place.element || !has(object.element(other), place)) {
      continue;
    }
    const double difference = places[other].distance - place.distance;
    const bool same = difference <= kLevel && other < place.element &&
                      (pointOf(object, places[other]) - pointOf(object, place)).squaredNorm() <= kLevel * kLevel;
    if (difference < -kLevel || same) {
      return false;
    }
  }
  return true;
}

}  // namespace

void keepLocalMinima(const ObjectTree& object, std::vector<MeshPlace>* places) {
  for (MeshPlace& place : *places) {
    // Others are compared with its distance and place, which therefore stay.
    place.triangle = place.known() && isLocalMinimum(object, *places, place) ? place.triangle : kNotKept;
  }
  for (MeshPlace& place : *places) {
    if (place.triangle == kNotKept) {
      place = MeshPlace();
    }
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
