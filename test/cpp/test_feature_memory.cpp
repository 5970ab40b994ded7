// Nearest points of a node that take turns.

#include <gtest/gtest.h>

#include <vector>

#include "deformable_manipulation/control/feature_memory.h"

namespace deformable_manipulation {
namespace control {
namespace {

const std::vector<Vector3> HERE{Vector3(0.0, 0.0, 1.0), Vector3(0.0, 1.0, 1.0)};

//! Two agents; the second one moves a part of the feature.
Features nearest(std::int64_t identity, double distance, double part = 1.0 / 3.0) {
  Features features;
  features.take({distance::Distances{{}, {0, 0}, {}}}, 2);
  features.add(distance, Vector3::UnitZ(), identity, {(1.0 - part) * Vector3::UnitZ(), part * Vector3::UnitZ()});
  return features;
}

TEST(FeatureMemory, WhatWasNearestStays) {
  FeatureMemory memory;
  Features features = nearest(7, 0.3);
  memory.recall(1.0, HERE.data(), features);
  EXPECT_EQ(features.size(), 1);
  features = nearest(8, 0.2, 0.6);
  memory.recall(1.01, HERE.data(), features);
  ASSERT_EQ(features.size(), 2);
  EXPECT_EQ(features.identity[0], 8);  // the nearest is the first
  EXPECT_EQ(features.identity[1], 7);
  EXPECT_NEAR(features.distance[1], 0.3002, 1e-15);
  EXPECT_EQ(features.normal[1], Vector3::UnitZ());
  EXPECT_EQ(features.gradient(1, 1), 1.0 / 3.0 * Vector3::UnitZ());
}

TEST(FeatureMemory, ItMovesWithTheHeldPoints) {
  FeatureMemory memory;
  Features features = nearest(7, 0.3);
  memory.recall(1.0, HERE.data(), features);
  const std::vector<Vector3> higher{HERE[0] + Vector3(0.1, 0.0, 0.03), HERE[1] + Vector3(0.0, 0.1, -0.06)};
  features = nearest(8, 0.2, 0.6);
  memory.recall(1.01, higher.data(), features);
  ASSERT_EQ(features.size(), 2);
  EXPECT_NEAR(features.distance[1], 0.3002 + 2.0 / 3.0 * 0.03 - 1.0 / 3.0 * 0.06, 1e-15);
}

TEST(FeatureMemory, WhatIsFoundAgainIsKnownOnce) {
  FeatureMemory memory;
  Features features = nearest(7, 0.3);
  memory.recall(1.0, HERE.data(), features);
  features = nearest(7, 0.25);
  memory.recall(1.01, HERE.data(), features);
  ASSERT_EQ(features.size(), 1);
  EXPECT_EQ(features.distance[0], 0.25);
}

TEST(FeatureMemory, APointThatNeighboursShareIsKnownOnce) {
  FeatureMemory memory;
  Features features = nearest(7, 0.3);
  memory.recall(1.0, HERE.data(), features);
  features = nearest(8, 0.3);
  memory.recall(1.01, HERE.data(), features);
  EXPECT_EQ(features.size(), 1);
}

TEST(FeatureMemory, ItForgets) {
  for (const double later : {1.2, 0.5}) {  // after a while, and when time was set back
    FeatureMemory memory;
    Features features = nearest(7, 0.3);
    memory.recall(1.0, HERE.data(), features);
    features = nearest(8, 0.2, 0.6);
    memory.recall(later, HERE.data(), features);
    EXPECT_EQ(features.size(), 1) << "at " << later;
  }
  FeatureMemory memory;
  Features features = nearest(7, 0.3);
  memory.recall(1.0, HERE.data(), features);
  memory.reset();
  features = nearest(8, 0.2, 0.6);
  memory.recall(1.01, HERE.data(), features);
  EXPECT_EQ(features.size(), 1);
}

}  // namespace
}  // namespace control
}  // namespace deformable_manipulation
