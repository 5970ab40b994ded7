// Primitives, clouds, cells and fields: each copy against points and formulas; no memory within a cycle.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "allocations.h"
#include "deformable_manipulation/distance/cloud_obstacle.h"
#include "deformable_manipulation/distance/field_obstacle.h"
#include "deformable_manipulation/distance/mesh_obstacle.h"
#include "deformable_manipulation/distance/minimum_distance.h"
#include "deformable_manipulation/distance/primitive_obstacle.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr int kCopies = 13, kPoints = 46;
constexpr double kRadius = 0.4;  // m, of the ball that all of them are

using Clouds = std::vector<std::shared_ptr<const PointCloud>>;

//! A rope that hangs over the ball, with its copies.
std::vector<double> ropes(double height) {
  std::vector<double> points;
  for (int copy = 0; copy < kCopies; ++copy) {
    for (int i = 0; i < kPoints; ++i) {
      const double along = 2.0 * i / (kPoints - 1) - 1.0;
      points.insert(points.end(), {along, 0.01 * copy, height + 0.3 * along * along + 0.005 * copy * along});
    }
  }
  return points;
}

ObjectView view(const std::vector<double>& points) {
  ObjectView view;
  view.points = points.data();
  view.copies = kCopies;
  view.point_count = kPoints;
  return view;
}

//! The ball as each kind of obstacle, with how far its distances may be off [m].
struct Seen {
  const char* name;
  std::shared_ptr<Obstacle> obstacle;
  double error;
};

std::vector<Seen> balls() {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<float> xyz;
  for (int i = 0; i < 40000; ++i) {
    Eigen::Vector3f point(normal(random), normal(random), normal(random));
    point *= static_cast<float>(kRadius) / point.norm();
    xyz.insert(xyz.end(), {point.x(), point.y(), point.z()});
  }
  std::vector<std::array<int, 3>> cells;
  std::vector<float> values;
  for (int x = -25; x < 25; ++x) {
    for (int y = -25; y < 25; ++y) {
      for (int z = -25; z < 25; ++z) {
        values.push_back(static_cast<float>(0.04 * Vector3(x, y, z).norm() - kRadius));
        if (0.02 * Vector3(x + 0.5, y + 0.5, z + 0.5).norm() <= kRadius) {
          cells.push_back({x, y, z});
        }
      }
    }
  }
  const std::size_t count = xyz.size() / 3, half = count / 2;
  const auto cloud = std::make_shared<PointCloud>(xyz.data(), count);
  const Clouds halves = {std::make_shared<PointCloud>(xyz.data(), half),
                         std::make_shared<PointCloud>(xyz.data() + 3 * half, count - half)};
  return {{"sphere", PrimitiveObstacle::sphere(kRadius), 1e-9},
          {"cloud", std::make_shared<CloudObstacle>(Clouds{cloud}, 0.0), 0.005},
          {"two clouds", std::make_shared<CloudObstacle>(halves, 0.0), 0.005},
          {"cells", MeshObstacle::ofCells(cells, 0.02), 0.02},
          {"field",
           std::make_shared<FieldObstacle>(values, std::array<int, 3>{50, 50, 50}, Vector3::Constant(-1.0),
                                           Vector3::Constant(0.04), true),
           0.003}};
}

TEST(SeenDistance, isThatOfTheBallInEachKind) {
  const std::vector<double> points = ropes(0.6);
  for (const Seen& seen : balls()) {
    MinimumDistance distance({seen.obstacle}, 0.0, 0.1);
    const Distances& found = distance.compute(view(points));
    for (int copy = 0; copy < kCopies; ++copy) {
      double least = INFINITY;  // between neighbours 0.3 mm apart at most, of which the ball is 0.6 m away
      for (int i = 0; i + 1 < kPoints; ++i) {
        const Vector3 a = view(points).point(copy, i), b = view(points).point(copy, i + 1);
        for (double t = 0.0; t <= 1.0; t += 1.0 / 128.0) {
          least = std::min(least, (a + t * (b - a)).norm() - kRadius);
        }
      }
      EXPECT_NEAR(found.minimum[copy], least, seen.error + 1e-7) << seen.name;
    }
  }
}

TEST(SeenDistance, takesNoMemoryOnceWarm) {
  const std::vector<std::vector<double>> states = {ropes(0.7), ropes(0.5), ropes(0.6)};
  for (const Seen& seen : balls()) {
    MinimumDistance distance({seen.obstacle}, 0.0, 0.2);
    for (int round = 0; round < 2; ++round) {
      for (const std::vector<double>& state : states) {
        distance.compute(view(state));
      }
    }
    for (const std::vector<double>& state : states) {
      const long before = test::allocations();
      distance.compute(view(state));
      EXPECT_EQ(test::allocations() - before, 0) << seen.name;
    }
  }
}

TEST(SeenDistance, anEmptyCloudIsNowhere) {
  const float nowhere[3] = {NAN, 0.0F, 0.0F};
  const Clouds empty = {std::make_shared<PointCloud>(nowhere, 1)};
  const std::vector<double> points = ropes(0.6);
  for (const Clouds& clouds : {empty, Clouds()}) {
    MinimumDistance distance({std::make_shared<CloudObstacle>(clouds, 0.1)}, 0.0, 0.1);
    const Distances& found = distance.compute(view(points));
    EXPECT_EQ(found.features.size(), 0U);
    EXPECT_EQ(found.minimum[kCopies - 1], INFINITY);
  }
  EXPECT_THROW(CloudObstacle({nullptr}, 0.1), std::invalid_argument);
}

TEST(SeenDistance, isThatOfTheObstacleThatTookThePlace) {
  const std::vector<double> points = ropes(0.6);
  MinimumDistance distance({PrimitiveObstacle::sphere(0.1), PrimitiveObstacle::sphere(0.2)}, 0.0, 0.1);
  const double before = distance.compute(view(points)).minimum[0];
  distance.replace(1, PrimitiveObstacle::sphere(kRadius));
  EXPECT_NEAR(distance.compute(view(points)).minimum[0], before + 0.2 - kRadius, 1e-12);
  EXPECT_THROW(distance.replace(2, PrimitiveObstacle::sphere(0.1)), std::invalid_argument);
  EXPECT_THROW(distance.replace(0, nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace distance
}  // namespace deformable_manipulation
