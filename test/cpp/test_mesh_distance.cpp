// Meshes as obstacles from C++: poses and copies, identities, and that warm calls allocate nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

#include "allocations.h"
#include "deformable_manipulation/distance/mesh_obstacle.h"
#include "deformable_manipulation/distance/minimum_distance.h"

namespace deformable_manipulation {
namespace distance {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

//! A ball of radius 1 m from rings of triangles.
struct Ball {
  std::vector<Vector3> vertices;
  Triangles triangles;

  explicit Ball(int rings) {
    const int sectors = 2 * rings;
    for (int r = 0; r <= rings; ++r) {
      for (int s = 0; s < sectors; ++s) {
        const double polar = r == rings ? 0.0 : M_PI * (1.0 - double(r) / rings), azimuth = 2.0 * M_PI * s / sectors;
        const double across = r == 0 || r == rings ? 0.0 : std::sin(polar);  // the poles are welded
        vertices.push_back({across * std::cos(azimuth), across * std::sin(azimuth), std::cos(polar)});
      }
    }
    for (int r = 0; r < rings; ++r) {
      for (int s = 0; s < sectors; ++s) {
        const int a = r * sectors + s, b = r * sectors + (s + 1) % sectors;
        triangles.push_back({a, b, a + sectors});
        triangles.push_back({b, b + sectors, a + sectors});
      }
    }
  }
};

//! A level square fabric of 2 m, centred above the origin.
struct Fabric {
  static constexpr int kCells = 14;
  std::vector<double> points;
  Triangles triangles;

  Fabric(int copies, double height) {
    for (int c = 0; c < copies; ++c) {
      for (int i = 0; i <= kCells; ++i) {
        for (int j = 0; j <= kCells; ++j) {
          points.insert(points.end(), {2.0 * i / kCells - 1.0, 2.0 * j / kCells - 1.0, height + 0.01 * c});
        }
      }
    }
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        const int a = i * (kCells + 1) + j, b = a + kCells + 1;
        triangles.push_back({a, b, a + 1});
        triangles.push_back({a + 1, b, b + 1});
      }
    }
  }

  ObjectView view(int copies) const {
    const int count = (kCells + 1) * (kCells + 1);
    return {points.data(), copies, count, triangles.data(), static_cast<int>(triangles.size())};
  }
};

std::shared_ptr<MeshObstacle> ball(int rings, const Vector3& at = Vector3::Zero()) {
  const Ball mesh(rings);
  return std::make_shared<MeshObstacle>(mesh.vertices, mesh.triangles, at);
}

TEST(MeshDistance, ofAllCopiesAboveAndThroughABall) {
  const auto obstacle = ball(40);
  EXPECT_EQ(obstacle->warnings(), std::vector<std::string>{"160 triangles without area are dropped"});
  MinimumDistance distance({obstacle}, 0.001, 0.1);
  const Fabric above(13, 1.2), through(13, 0.3);
  for (int c = 0; c < 13; ++c) {
    EXPECT_NEAR(distance.compute(above.view(13)).minimum[c], 0.199 + 0.01 * c, 1e-9);
    // The deepest point is near the axis, and the facets are up to 0.4 % within the ball.
    EXPECT_NEAR(distance.compute(through.view(13)).minimum[c], -0.701 + 0.01 * c, 0.005);
  }
}

TEST(MeshDistance, followsThePose) {
  const auto obstacle = ball(20);
  MinimumDistance distance({obstacle}, 0.0, 0.0);
  const Fabric fabric(1, 1.5);
  for (double height : {0.0, 0.1, -4.0, 0.3}) {
    obstacle->setPose(Vector3(0.0, 0.0, height), pbd::Quaternion::Identity(),
                      {Vector3(0.0, 0.0, 2.0), Vector3::Zero()});
    const Distances& result = distance.compute(fabric.view(1));
    EXPECT_NEAR(result.minimum[0], 0.5 - height, 1e-9);
    EXPECT_EQ(result.features[0].obstacle_velocity, Vector3(0.0, 0.0, 2.0));
  }
  EXPECT_THROW(obstacle->setPose(Vector3(NAN, 0.0, 0.0), pbd::Quaternion::Identity()), std::invalid_argument);
}

TEST(MeshDistance, allocatesNothingOnceWarm) {
  const auto obstacle = ball(40);
  MinimumDistance distance({obstacle}, 0.001, 0.1);
  const Fabric above(13, 1.1), through(13, 0.2), lower(13, 0.15);
  for (const Fabric* fabric : {&above, &through, &lower, &above, &through, &lower}) {
    distance.compute(fabric->view(13));
  }
  for (const Fabric* fabric : {&through, &above, &lower}) {
    const long before = test::allocations();
    distance.compute(fabric->view(13));
    EXPECT_EQ(test::allocations() - before, 0);
  }
}

TEST(MeshDistance, numbersElementsByThemselves) {
  MinimumDistance distance({ball(10), ball(10, Vector3(0.0, 0.0, -0.01))}, 0.0, 0.5);
  const Fabric fabric(2, 1.2);
  const Distances first = distance.compute(fabric.view(2));
  std::set<std::int64_t> numbers;
  for (int i = 0; i < first.offsets[1]; ++i) {
    EXPECT_TRUE(numbers.insert(first.features[i].identity).second);
  }
  const Distances& second = distance.compute(fabric.view(2));
  for (std::size_t i = 0; i < first.features.size(); ++i) {
    EXPECT_EQ(second.features[i].identity, first.features[i].identity);
  }
}

TEST(Surface, withoutTrianglesIsRefused) {
  MinimumDistance distance({ball(10)}, 0.0, 0.0);
  const Fabric fabric(1, 1.2);
  ObjectView view = fabric.view(1);
  view.triangle_count = 0;
  EXPECT_THROW(distance.compute(view), std::invalid_argument);
}

}  // namespace
}  // namespace distance
}  // namespace deformable_manipulation
