// Distances of future shapes from an obstacle on a path.

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "deformable_manipulation/control/measured_obstacle.h"
#include "deformable_manipulation/control/obstacle_forecast.h"
#include "deformable_manipulation/distance/planar_obstacle.h"

namespace deformable_manipulation {
namespace control {
namespace {

using pbd::Quaternion;

constexpr int POINTS = 9;
constexpr double MARGIN = 0.01;  // [m]

Quaternion turned(double angle) { return Quaternion(Eigen::AngleAxisd(angle, Vector3(1.0, 2.0, -1.0).normalized())); }

//! On its way from one pose to another, at constant velocity.
PosePath path() {
  PosePath path;
  path.begin = 1.0;
  path.step = 0.5;
  for (int k = 0; k < 5; ++k) {
    path.poses.push_back({Vector3(0.1 * k, -0.05 * k, 0.2 * k), turned(0.3 * k)});
  }
  return path;
}

std::shared_ptr<distance::PlanarObstacle> block() {
  const std::vector<std::array<double, 2>> corners{{-0.3, -0.2}, {0.3, -0.2}, {0.3, 0.2}, {-0.3, 0.2}};
  return std::make_shared<distance::PlanarObstacle>(corners, "yz");
}

std::vector<double> polylines(int copies) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> noise(-0.1, 0.1);
  std::vector<double> points;
  for (int copy = 0; copy < copies; ++copy) {
    for (int k = 0; k < POINTS; ++k) {
      for (const double coordinate : {0.1, 0.2 * (k - 4), 0.6}) {
        points.push_back(coordinate + noise(generator));
      }
    }
  }
  return points;
}

TEST(PosePath, IsStraightInBetweenAndStandsBeforeAndAfter) {
  const PosePath way = path();
  EXPECT_LT((way.at(0.0).position - way.poses.front().position).norm(), 1e-15);
  EXPECT_LT((way.at(9.0).position - way.poses.back().position).norm(), 1e-15);
  EXPECT_LT((way.at(1.75).position - Vector3(0.15, -0.075, 0.3)).norm(), 1e-12);
  EXPECT_LT(way.at(1.75).orientation.angularDistance(turned(0.45)), 1e-9);
  PosePath one;
  one.poses.resize(1);
  one.poses[0].position = Vector3(1.0, 2.0, 3.0);
  EXPECT_EQ(one.at(-4.0).position, one.poses[0].position);
  EXPECT_EQ(one.at(4.0).position, one.poses[0].position);
}

//! The reference puts the obstacle where it is at each time.
TEST(ObstacleForecast, IsTheDistanceFromTheObstacleWhereItIsThen) {
  const std::vector<double> times{0.0, 1.2, 1.5, 2.4, 5.0};
  const auto copies = static_cast<int>(times.size());
  const std::vector<double> points = polylines(copies);
  const Pose place{Vector3(0.3, -0.1, 0.05), turned(0.7)};
  const auto standing = block();
  standing->setPose(place.position, place.orientation);
  using Obstacles = std::vector<std::shared_ptr<distance::Obstacle>>;
  ObstacleForecast forecast(std::make_shared<distance::MinimumDistance>(Obstacles{standing}, MARGIN, 0.0), place,
                            path());
  distance::ObjectView object;
  object.points = points.data();
  object.copies = copies;
  object.point_count = POINTS;
  const std::vector<distance::Feature> features = forecast.compute(object, times, 0.0);
  const auto moving = block();
  distance::MinimumDistance reference({moving}, MARGIN, 0.0);
  object.copies = 1;
  for (int copy = 0; copy < copies; ++copy) {
    const Pose then = path().at(times[copy]);
    moving->setPose(then.position, then.orientation);
    object.points = points.data() + 3 * POINTS * copy;
    const distance::Feature expected = reference.compute(object).features.front();
    if (expected.distance < 0.0) {
      continue;  // see KeepsTheSide
    }
    EXPECT_NEAR(features[copy].distance, expected.distance, 1e-9);
    EXPECT_LT((features[copy].normal - expected.normal).norm(), 1e-7);
    EXPECT_LT((features[copy].object_point - expected.object_point).norm(), 1e-7);
    EXPECT_LT((features[copy].obstacle_point - expected.obstacle_point).norm(), 1e-7);
    EXPECT_EQ(features[copy].vertices, expected.vertices);
  }
}

//! A block rises into a line from below, near its end: the nearest way out is to the side.
TEST(ObstacleForecast, KeepsTheSide) {
  PosePath rise;
  rise.poses = {Pose(), {Vector3(0.0, 0.0, 0.6), Quaternion::Identity()}};
  using Obstacles = std::vector<std::shared_ptr<distance::Obstacle>>;
  ObstacleForecast forecast(std::make_shared<distance::MinimumDistance>(Obstacles{block()}, MARGIN, 0.0), Pose(), rise);
  const std::vector<double> line{0.0, 0.25, 0.3, 0.0, 1.0, 0.3};
  std::vector<double> points = line;
  points.insert(points.end(), line.begin(), line.end());
  distance::ObjectView object;
  object.points = points.data();
  object.copies = 2;
  object.point_count = 2;
  const std::vector<distance::Feature> features = forecast.compute(object, {0.0, 0.5}, 0.0);
  EXPECT_NEAR(features[0].distance, 0.1 - MARGIN, 1e-9);
  EXPECT_NEAR(features[1].distance, 0.1 - 0.3 - MARGIN, 1e-9);
  for (const distance::Feature& feature : features) {
    EXPECT_LT((feature.normal - Vector3::UnitZ()).norm(), 1e-9);
  }
}

TEST(ObstacleForecast, APathNeedsAPose) {
  using Obstacles = std::vector<std::shared_ptr<distance::Obstacle>>;
  const auto distance = std::make_shared<distance::MinimumDistance>(Obstacles{block()}, MARGIN, 0.0);
  EXPECT_THROW(ObstacleForecast(distance, Pose(), PosePath()), std::invalid_argument);
}

//! A block that is measured as it moves and turns at constant velocity.
MeasuredObstacle measured(double seconds, double leap = 0.0) {
  using Obstacles = std::vector<std::shared_ptr<distance::Obstacle>>;
  const auto distance = std::make_shared<distance::MinimumDistance>(Obstacles{block()}, MARGIN, 0.0);
  const PosePath standing{0.0, 1.0, {Pose()}};
  MeasuredObstacle obstacle(ObstacleForecast(distance, Pose(), standing), 0);
  for (int k = 0; k <= 100; ++k) {
    const double time = 0.01 * k * seconds;
    obstacle.observe(time, {Vector3(0.0, 0.1 * time + (k == 100 ? leap : 0.0), 0.2 * time), turned(0.3 * time)});
  }
  return obstacle;
}

distance::Feature nearest(MeasuredObstacle& obstacle, const std::vector<double>& points, double time, double doubt) {
  distance::ObjectView object;
  object.points = points.data();
  object.copies = 1;
  object.point_count = POINTS;
  return obstacle.compute(object, {time}, doubt).front();
}

TEST(MeasuredObstacle, GoesOnWithItsVelocity) {
  const std::vector<double> points = polylines(1);
  MeasuredObstacle obstacle = measured(2.0);
  const auto moving = block();
  distance::MinimumDistance reference({moving}, MARGIN, 0.0);
  distance::ObjectView object;
  object.points = points.data();
  object.copies = 1;
  object.point_count = POINTS;
  for (const double time : {2.0, 2.1, 2.2, 2.5, 4.0}) {
    moving->setPose(Vector3(0.0, 0.1 * time, 0.2 * time), turned(0.3 * time));
    const double expected = reference.compute(object).features.front().distance;
    if (expected > 0.0) {
      EXPECT_NEAR(nearest(obstacle, points, time, 0.0).distance, expected, 1e-3) << time;
    }
  }
}

TEST(MeasuredObstacle, DoubtGrowsWithItsWay) {
  const std::vector<double> points = polylines(1);
  MeasuredObstacle obstacle = measured(2.0);
  const auto loss = [&](double time) {
    return nearest(obstacle, points, time, 0.0).distance - nearest(obstacle, points, time, 0.5).distance;
  };
  EXPECT_NEAR(loss(2.0), 0.0, 1e-12);
  EXPECT_GT(loss(3.0), 0.5 * 0.1);
  EXPECT_GT(loss(4.0), 1.5 * loss(3.0));
}

TEST(MeasuredObstacle, ThatLeapsIsAtRest) {
  const std::vector<double> points = polylines(1);
  MeasuredObstacle obstacle = measured(2.0, 0.5);
  const double now = nearest(obstacle, points, 2.0, 0.5).distance;
  EXPECT_NEAR(nearest(obstacle, points, 4.0, 0.5).distance, now, 1e-12);
}

}  // namespace
}  // namespace control
}  // namespace deformable_manipulation
