#include "deformable_manipulation/distance/feature_tracker.h"

#include <algorithm>
#include <tuple>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kReach = 2.0;  // lengths of an element that a feature may slide from one call to the next

std::int64_t identityOfElement(const Feature& feature, const ObjectView& object) {
  std::int64_t identity = feature.obstacle;
  for (int k = 0; k < (object.triangles == nullptr ? 1 : 3); ++k) {
    identity = identity * object.point_count + feature.vertices[k];
  }
  return identity;
}

//! Where the material point of a feature is now.
Vector3 presentPoint(const Feature& feature, const ObjectView& object) {
  Vector3 point = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    point += feature.weights[k] * object.point(0, feature.vertices[k]);
  }
  return point;
}

double squaredLength(const Feature& feature, const ObjectView& object) {
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vector3 side = object.point(0, feature.vertices[k]) - object.point(0, feature.vertices[(k + 1) % 3]);
    longest = std::max(longest, side.squaredNorm());
  }
  return longest;
}

bool exists(const Feature& feature, const ObjectView& object) {
  return *std::max_element(feature.vertices.begin(), feature.vertices.end()) < object.point_count;
}

}  // namespace

void FeatureTracker::follow(const ObjectView& object, Selection selection, Distances* distances) {
  Feature* const begin = distances->features.data();
  Feature* const end = begin + distances->features.size();
  if (selection == Selection::ELEMENTS) {
    std::for_each(begin, end, [&](Feature& feature) { feature.identity = identityOfElement(feature, object); });
    return;
  }
  number(object, begin, begin + distances->offsets[1]);
}

void FeatureTracker::number(const ObjectView& object, Feature* begin, Feature* end) {
  candidates_.clear();
  for (std::size_t before = 0; before < last_.size(); ++before) {
    const Feature& old = last_[before];
    if (!exists(old, object)) {
      continue;
    }
    const Vector3 point = presentPoint(old, object);
    const double length = squaredLength(old, object);
    for (const Feature* feature = begin; feature != end; ++feature) {
      const double squared = (feature->object_point - point).squaredNorm();
      const double reach = kReach * kReach * std::max(length, squaredLength(*feature, object));
      if (feature->obstacle == old.obstacle && squared <= reach) {
        candidates_.push_back({squared, static_cast<int>(feature - begin), static_cast<int>(before)});
      }
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.squared, a.now, a.before) < std::tie(b.squared, b.now, b.before);
  });
  taken_.assign(last_.size(), 0);
  for (const Candidate& candidate : candidates_) {
    if (begin[candidate.now].identity < 0 && !taken_[candidate.before]) {
      begin[candidate.now].identity = last_[candidate.before].identity;
      taken_[candidate.before] = 1;
    }
  }
  for (Feature* feature = begin; feature != end; ++feature) {
    feature->identity = feature->identity < 0 ? next_++ : feature->identity;
  }
  last_.assign(begin, end);
}

}  // namespace distance
}  // namespace deformable_manipulation
