// Planar obstacles: signed distances against a search over all edges and many points.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "deformable_manipulation/distance/minimum_distance.h"
#include "deformable_manipulation/distance/planar_obstacle.h"

namespace deformable_manipulation {
namespace distance {
namespace {

using Ring = std::vector<std::array<double, 2>>;

const Ring kSquare = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};

//! A ring seen whole from the origin.
Ring star(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> radius(0.3, 1.5);
  Ring ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count, r = radius(random);
    ring.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return ring;
}

//! By the winding number and each edge in turn.
double signedDistance(const Ring& ring, double u, double v) {
  double nearest = INFINITY, turns = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::array<double, 2>&a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double du = b[0] - a[0], dv = b[1] - a[1], au = u - a[0], av = v - a[1], bu = u - b[0], bv = v - b[1];
    const double along = std::min(std::max((du * au + dv * av) / (du * du + dv * dv), 0.0), 1.0);
    nearest = std::min(nearest, std::hypot(au - along * du, av - along * dv));
    turns += std::atan2(au * bv - av * bu, au * bu + av * bv);
  }
  return std::fabs(turns) > M_PI ? -nearest : nearest;
}

//! A line of the xy plane with random steps.
std::vector<double> wanderer(std::mt19937& random, int points, double step) {
  std::normal_distribution<double> normal;
  std::vector<double> line;
  double u = normal(random), v = normal(random);
  for (int i = 0; i < points; ++i) {
    line.insert(line.end(), {u, v, 0.3 * i});
    u += step * normal(random);
    v += step * normal(random);
  }
  return line;
}

ObjectView view(const std::vector<double>& points, int copies) {
  ObjectView object;
  object.points = points.data();
  object.copies = copies;
  object.point_count = static_cast<int>(points.size()) / (3 * copies);
  return object;
}

MinimumDistance calculator(const Ring& ring, double band = 0.1) {
  return MinimumDistance({std::make_shared<PlanarObstacle>(ring, "xy")}, 0.0, band);
}

TEST(PlanarObstacle, minimumIsThatOfAllPoints) {
  std::mt19937 random(1);
  for (int scene = 0; scene < 60; ++scene) {
    const Ring ring = star(random, 3 + scene);
    const std::vector<double> line = wanderer(random, 8, 0.3);
    MinimumDistance distance = calculator(ring);
    double least = INFINITY, step = 0.0;
    constexpr int kParts = 200;
    for (std::size_t i = 0; i + 3 < line.size(); i += 3) {
      const double du = line[i + 3] - line[i], dv = line[i + 4] - line[i + 1];
      step = std::max(step, std::hypot(du, dv) / kParts);
      for (int k = 0; k <= kParts; ++k) {
        least = std::min(least, signedDistance(ring, line[i] + du * k / kParts, line[i + 1] + dv * k / kParts));
      }
    }
    const double found = distance.compute(view(line, 1)).minimum[0];
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GE(found, least - 0.5 * step);
  }
}

TEST(PlanarObstacle, witnessesAndNormalsBelongTogether) {
  std::mt19937 random(2);
  for (int scene = 0; scene < 60; ++scene) {
    const Ring ring = star(random, 20);
    const std::vector<double> line = wanderer(random, 10, 0.2);
    MinimumDistance distance = calculator(ring, 0.3);
    for (const Feature& feature : distance.compute(view(line, 1)).features) {
      const double expected = signedDistance(ring, feature.object_point.x(), feature.object_point.y());
      EXPECT_NEAR(feature.distance, expected, 1e-12);
      EXPECT_NEAR(feature.normal.norm(), 1.0, 1e-9);
      EXPECT_TRUE((feature.object_point - feature.obstacle_point).isApprox(expected * feature.normal, 1e-9));
      EXPECT_NEAR(signedDistance(ring, feature.obstacle_point.x(), feature.obstacle_point.y()), 0.0, 1e-12);
    }
  }
}

TEST(PlanarObstacle, resultsDoNotDependOnCallsBefore) {
  std::mt19937 random(3);
  const Ring ring = star(random, 200);
  MinimumDistance used = calculator(ring, 0.2);
  for (int call = 0; call < 20; ++call) {
    std::vector<double> lines = wanderer(random, 12, 0.15);
    const std::vector<double> second = wanderer(random, 12, 0.15);
    lines.insert(lines.end(), second.begin(), second.end());
    MinimumDistance fresh = calculator(ring, 0.2);
    const Distances &a = used.compute(view(lines, 2)), &b = fresh.compute(view(lines, 2));
    ASSERT_EQ(a.minimum, b.minimum);
    ASSERT_EQ(a.offsets, b.offsets);
    for (std::size_t k = 0; k < a.features.size(); ++k) {
      ASSERT_EQ(a.features[k].object_point, b.features[k].object_point);
      ASSERT_EQ(a.features[k].normal, b.features[k].normal);
    }
  }
}

TEST(PlanarObstacle, distanceIsContinuousThroughTheSurface) {
  MinimumDistance distance = calculator(kSquare);
  for (int i = 0; i <= 100; ++i) {
    const double height = 1.05 - 0.005 * i;
    const std::vector<double> line = {0.2, height, 0.0, 0.5, height - 0.01, 0.0, 0.7, height, 0.0};
    EXPECT_NEAR(distance.compute(view(line, 1)).minimum[0], height - 1.01, 1e-12);
  }
}

TEST(PlanarObstacle, surfaceAroundTheObstacleIsAsDeepAsItsCentre) {
  const std::vector<double> corners = {-3.0, -3.0, 0.0, 4.0, -3.0, 1.0, 0.5, 6.0, 2.0};
  const std::array<int, 3> triangle = {0, 1, 2};
  ObjectView object = view(corners, 1);
  object.triangles = &triangle;
  object.triangle_count = 1;
  MinimumDistance distance = calculator(kSquare);
  const Distances& found = distance.compute(object);
  ASSERT_EQ(found.features.size(), 1u);
  EXPECT_NEAR(found.minimum[0], -0.5, 1e-12);
  EXPECT_NEAR(found.features[0].object_point.x(), 0.5, 1e-9);
  EXPECT_NEAR(found.features[0].object_point.y(), 0.5, 1e-9);
}

TEST(PlanarObstacle, holesAreOutside) {
  const Ring hole = {{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}};
  const Ring apart = {{3.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {3.0, 1.0}};
  const auto minimum = [&](double u, double v) {
    MinimumDistance distance({std::make_shared<PlanarObstacle>(std::vector<Ring>{apart, hole, kSquare}, "xy")}, 0.0,
                             0.1);
    return distance.compute(view({u, v, 0.0, u, v, 1.0}, 1)).minimum[0];
  };
  EXPECT_NEAR(minimum(0.5, 0.5), 0.25, 1e-12);
  EXPECT_NEAR(minimum(0.5, 0.1), -0.1, 1e-12);
  EXPECT_NEAR(minimum(0.2, 0.2), -0.05 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(minimum(2.5, 0.5), 0.5, 1e-12);
  EXPECT_NEAR(minimum(3.5, 0.5), -0.5, 1e-12);
}

TEST(PlanarObstacle, ringsMustNotMeet) {
  const Ring touching = {{0.0, 0.5}, {0.5, 0.4}, {0.5, 0.6}};
  EXPECT_THROW(PlanarObstacle(std::vector<Ring>{kSquare, touching}, "xy"), std::invalid_argument);
  EXPECT_THROW(PlanarObstacle(std::vector<Ring>{}, "xy"), std::invalid_argument);
}

TEST(PlanarObstacle, velocityIsThatOfTheMovingObstacleAtItsPoint) {
  auto obstacle = std::make_shared<PlanarObstacle>(kSquare, "xy");
  MinimumDistance distance({obstacle}, 0.0, 0.1);
  const Vector3 translation(1.0, 0.0, 0.0);
  obstacle->setPose(translation, pbd::Quaternion::Identity(), {Vector3(0.1, 0.2, 0.3), Vector3(0.0, 0.0, 2.0)});
  const std::vector<double> line = {1.5, 1.3, 0.0, 1.5, 1.6, 0.0};
  const Feature feature = distance.compute(view(line, 1)).features[0];
  EXPECT_TRUE(feature.obstacle_point.isApprox(Vector3(1.5, 1.0, 0.0), 1e-12));
  EXPECT_TRUE(feature.obstacle_velocity.isApprox(Vector3(0.1 - 2.0, 0.2 + 1.0, 0.3), 1e-12));
}

TEST(PlanarObstacle, mistakesAreReportedAllAtOnce) {
  try {
    PlanarObstacle({{0.0, 0.0}, {1.0, NAN}, {1.0, 1.0}}, "zy", Vector3(INFINITY, 0.0, 0.0),
                   pbd::Quaternion(0.0, 0.0, 0.0, 0.0));
    FAIL();
  } catch (const std::invalid_argument& error) {
    for (const char* part : {"point 1", "plane is 'zy'", "translation", "rotation"}) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part;
    }
  }
  const Ring bow_tie = {{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}};
  EXPECT_THROW(PlanarObstacle(bow_tie, "xy"), std::invalid_argument);
  EXPECT_THROW(PlanarObstacle({{0.0, 0.0}, {1.0, 0.0}}, "xy"), std::invalid_argument);
}

}  // namespace
}  // namespace distance
}  // namespace deformable_manipulation
