// Meshes: what is refused, and the measures of those that are not.

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "../../src/pbd/fabric_constraints.h"
#include "../../src/pbd/fabric_mesh.h"
#include "../../src/pbd/fabric_weights.h"
#include "fabric_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

//! The text of the error, or nothing.
std::string refusal(const FabricParameters& p) {
  try {
    Fabric fabric(p);
    return "";
  } catch (const ParameterError& error) {
    return error.what();
  }
}

void expectRefused(const FabricParameters& p, const std::vector<std::string>& texts) {
  const std::string refused = refusal(p);
  for (const std::string& text : texts) {
    EXPECT_NE(refused.find(text), std::string::npos) << text << "\nis not in:\n" << refused;
  }
}

TEST(FabricMesh, isAccepted) { EXPECT_EQ(refusal(sheet(4, 3, 0.1)), ""); }

TEST(FabricMesh, mayBeTurnedInsideOutInPlaces) {
  FabricParameters p = sheet(4, 3, 0.1);
  std::swap(p.triangles[3][0], p.triangles[3][1]);
  EXPECT_EQ(refusal(p), "");
}

TEST(FabricMesh, isRefusedWithoutTriangles) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.triangles.clear();
  expectRefused(p, {"triangles: none - must be at least one triangle"});
}

TEST(FabricMesh, isRefusedWithVerticesThatAreNotThere) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.triangles[5] = {0, 1, 12};
  p.triangles[6] = {-1, 1, 2};
  expectRefused(p, {"triangle 5 (0, 1, 12)", "triangle 6 (-1, 1, 2)", "vertices 0 to 11"});
}

TEST(FabricMesh, isRefusedWithVerticesThatAreNotFiniteOrNotUsed) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  p.vertices.emplace_back(1.0, 1.0, 1.0);
  expectRefused(p, {"vertex 3 is not finite", "vertex 12 is in no triangle - must be a corner of a triangle; remove"});
}

TEST(FabricMesh, isRefusedWithTrianglesWithoutArea) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.triangles.push_back({0, 1, 2});
  p.triangles.push_back({4, 4, 8});
  expectRefused(p, {"triangle 12 (0, 1, 2) has no area", "triangle 13 (4, 4, 8) has no area"});
}

TEST(FabricMesh, isRefusedWithATriangleTwice) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.triangles.push_back({p.triangles[2][1], p.triangles[2][0], p.triangles[2][2]});
  expectRefused(p, {"triangle 12", "is triangle 2 again", "remove the repetition"});
}

TEST(FabricMesh, isRefusedWithThreeTrianglesAtAnEdge) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.vertices.emplace_back(0.1, 0.1, 0.3);
  p.triangles.push_back({0, 5, 12});
  expectRefused(p, {"the edge from vertex 0 to 5 belongs to triangles 0 1 12", "vertices of their own"});
}

TEST(FabricMesh, isRefusedInPieces) {
  FabricParameters p = sheet(4, 3, 0.1);
  const FabricParameters other = sheet(2, 2, 0.1);
  for (const Vector3& vertex : other.vertices) {
    p.vertices.push_back(vertex + Vector3(0.0, 0.0, 1.0));
  }
  for (const Triangle& t : other.triangles) {
    p.triangles.push_back({t[0] + 12, t[1] + 12, t[2] + 12});
  }
  expectRefused(p, {"a piece that begins with vertex 12 is not connected", "merge vertices"});
}

TEST(FabricMesh, namesAFewProblemsOfAKind) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.vertices.resize(100, Vector3::Zero());
  expectRefused(p, {"vertex 16 is in no triangle", "83 more like the last"});
}

TEST(FabricParameters, areRefusedAllAtOnce) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.density = 0.0;
  p.thickness = -1.0;
  p.stretching_compliance = std::numeric_limits<double>::infinity();
  p.bending_compliance = std::numeric_limits<double>::quiet_NaN();
  p.damping = -1.0;
  p.threads = 0;
  p.gravity.x() = std::numeric_limits<double>::infinity();
  expectRefused(p, {"density: 0", "thickness: -1", "stretching_compliance: inf", "bending_compliance: nan",
                    "infinity for no bending stiffness", "damping: -1", "threads: 0", "gravity: inf"});
}

TEST(FabricParameters, keepTheMaterialWhenTheNewOneIsRefused) {
  Fabric fabric(sheet(4, 3, 0.1));
  EXPECT_THROW(fabric.setMaterial({{"bending_compliance", 1.0}, {"young_modulus", 1.0}, {"damping", -1.0}}),
               ParameterError);
  EXPECT_EQ(fabric.parameters().bending_compliance, 1e3);
  fabric.setMaterial({{"bending_compliance", 1.0}});
  EXPECT_EQ(fabric.parameters().bending_compliance, 1.0);
}

TEST(MeshEdges, haveTheirTrianglesAndAreas) {
  const FabricParameters p = sheet(3, 3, 0.1);
  const std::vector<MeshEdge> edges = meshEdges(p.vertices, p.triangles);
  EXPECT_EQ(edges.size(), 16u);
  double area = 0.0;
  int interior = 0;
  for (const MeshEdge& edge : edges) {
    area += edge.area / 3.0;
    interior += edge.interior() ? 1 : 0;
    EXPECT_NEAR(edge.length, (p.vertices[edge.vertices[0]] - p.vertices[edge.vertices[1]]).norm(), 1e-15);
  }
  EXPECT_EQ(interior, 8);
  EXPECT_NEAR(area, 0.04, 1e-15);
}

TEST(FoldWeights, measureTheAngleOfAFold) {
  const double angle = 0.3;
  std::vector<Vector3> vertices = {{0.0, 0.0, 0.0}, {0.0, 0.2, 0.0}, {-0.1, 0.13, 0.0}, {0.17, 0.05, 0.0}};
  const MeshEdge edge = meshEdges(vertices, {{0, 1, 2}, {0, 3, 1}})[0];
  ASSERT_TRUE(edge.interior());
  const std::array<double, 4> weights = foldWeights(vertices, edge);
  const auto fold = [&] {
    return Vector3(weights[0] * vertices[0] + weights[1] * vertices[1] + weights[2] * vertices[edge.opposite[0]] +
                   weights[3] * vertices[edge.opposite[1]]);
  };
  EXPECT_LT(fold().norm(), 1e-15);
  vertices[3] = Eigen::AngleAxisd(angle, Vector3::UnitY()) * vertices[3];
  EXPECT_NEAR(fold().norm(), 2.0 * 0.2 * std::sin(0.5 * angle), 1e-15);
  const Eigen::AngleAxisd turn(1.1, Vector3(1.0, 2.0, 3.0).normalized());
  const double before = fold().norm();
  for (Vector3& vertex : vertices) {
    vertex = turn * vertex + Vector3(1.0, -2.0, 0.5);
  }
  EXPECT_NEAR(fold().norm(), before, 1e-14);
}

TEST(FoldWeights, giveTheEnergyOfAPlateBentAlongTheMesh) {
  const double spacing = 0.01;
  const double radius = 0.5;
  FabricParameters p = sheet(21, 11, spacing);
  const std::vector<MeshEdge> edges = meshEdges(p.vertices, p.triangles);
  double energy = 0.0;  // of rigidity 1
  for (const MeshEdge& edge : edges) {
    if (edge.interior()) {
      const std::array<double, 4> weights = foldWeights(p.vertices, edge);
      const int at[4] = {edge.vertices[0], edge.vertices[1], edge.opposite[0], edge.opposite[1]};
      Vector3 fold = Vector3::Zero();
      for (int k = 0; k < 4; ++k) {
        const double angle = p.vertices[at[k]].x() / radius;
        fold += weights[k] * Vector3(radius * std::sin(angle), p.vertices[at[k]].y(), radius * std::cos(angle));
      }
      energy += 0.5 * fold.squaredNorm() / edge.area;
    }
  }
  const double bent_area = 19.0 * 10.0 * spacing * spacing;  // of 20 cells' lengths 19 lie between two folds
  EXPECT_NEAR(energy, 0.5 * bent_area / (radius * radius), 0.01 * energy);
}

TEST(IndependentOrder, holdsEverythingOnceAndKeepsNeighboursApart) {
  const FabricParameters p = cloth();
  std::vector<std::vector<int>> items;
  for (const MeshEdge& edge : meshEdges(p.vertices, p.triangles)) {
    items.push_back({edge.vertices[0], edge.vertices[1]});
  }
  const std::vector<int> order = independentOrder(items, static_cast<int>(p.vertices.size()));
  EXPECT_EQ(std::set<int>(order.begin(), order.end()).size(), items.size());
  int near = 0;
  for (std::size_t i = 2; i < order.size(); ++i) {
    std::set<int> vertices;
    for (int k = 0; k < 3; ++k) {
      vertices.insert(items[order[i - k]].begin(), items[order[i - k]].end());
    }
    near += vertices.size() < 6 ? 1 : 0;
  }
  EXPECT_LT(near, static_cast<int>(order.size()) / 50);
}

TEST(HoldWeights, sumToOneAndFollowTheHolds) {
  const FabricParameters p = cloth();
  const std::vector<MeshEdge> edges = meshEdges(p.vertices, p.triangles);
  for (const std::vector<int>& held : std::vector<std::vector<int>>{{7}, {0, 224}, {0, 14, 210, 224}, {3, 4, 100}}) {
    const Eigen::MatrixXd weights = holdWeights(p.vertices, edges, held);
    EXPECT_LT((weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
    for (std::size_t i = 0; i < held.size(); ++i) {
      for (std::size_t j = 0; j < held.size(); ++j) {
        EXPECT_NEAR(weights(held[i], static_cast<int>(j)), i == j ? 1.0 : 0.0, 1e-12);
      }
    }
    EXPECT_LT(weights.cwiseAbs().maxCoeff(), 2.0);
  }
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
