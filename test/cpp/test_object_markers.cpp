// What RViz is told of an object: surfaces of fabrics, outlines of their copies.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "../../src/ros/fabric_drawing.h"
#include "../../src/ros/object_markers.h"
#include "../../src/ros/rod_drawing.h"

namespace deformable_manipulation {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

// A square of two triangles, with a fin on its diagonal.
const std::vector<std::array<int, 3>> kTriangles = {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}};
const std::vector<std::array<int, 3>> kTetrahedron = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};

ObjectState stateOf(const std::vector<double>& points, const std::vector<std::vector<double>>& displacements) {
  ObjectState state;
  state.header.frame_id = "map";
  state.point_count = points.size() / 3;
  state.displaced_agents = {-1};
  state.displacements = {0.0, 0.0, 0.0};
  state.points = points;
  for (const std::vector<double>& displacement : displacements) {
    state.displaced_agents.push_back(0);
    state.displacements.insert(state.displacements.end(), displacement.begin(), displacement.end());
    state.points.insert(state.points.end(), points.begin(), points.end());
  }
  state.agents = {"leader"};
  state.agent_positions = {1.0, 2.0, 3.0};
  return state;
}

const std::vector<double> kFlat = {0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0.5, 0.5, 1};
const std::vector<double> kUpright = {0, 0, 0, 0.25, 0.9, 0, 0.25, 0.9, 1, 0, 0, 1, 0.125, 0.45, 0.5};

std::vector<Marker> markersOf(const MarkerArray& array, const std::string& ns) {
  std::vector<Marker> found;
  std::copy_if(array.markers.begin(), array.markers.end(), std::back_inserter(found),
               [&](const Marker& marker) { return marker.ns == ns; });
  return found;
}

Marker surfaceOf(const std::vector<double>& points) {
  ObjectMarkers markers(std::make_unique<FabricDrawing>(kTriangles), "leader");
  return markersOf(markers.draw(stateOf(points, {})), "object").at(0);
}

TEST(FabricMarkers, theSurfaceHasEveryTriangle) {
  const Marker surface = surfaceOf(kFlat);
  EXPECT_EQ(surface.type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(surface.header.frame_id, "map");
  ASSERT_EQ(surface.points.size(), 9u);
  ASSERT_EQ(surface.colors.size(), 9u);
  EXPECT_EQ(surface.points[1].x, 1.0);
  EXPECT_EQ(surface.points[8].y, 0.5);
}

TEST(FabricMarkers, whatFacesUpwardsOrDownwardsIsBright) {
  const Marker flat = surfaceOf(kFlat);
  std::vector<double> turned = kFlat;
  for (std::size_t i = 0; i < turned.size(); i += 3) {
    std::swap(turned[i], turned[i + 1]);  // the other side faces upwards
  }
  const Marker over = surfaceOf(turned);
  const Marker upright = surfaceOf(kUpright);
  for (int corner = 0; corner < 6; ++corner) {
    EXPECT_EQ(flat.colors[corner].a, 1.0f);
    EXPECT_NEAR(flat.colors[corner].r, over.colors[corner].r, 1e-6);
    EXPECT_LT(upright.colors[corner].r, 0.75f * flat.colors[corner].r);
    EXPECT_GT(upright.colors[corner].r, 0.2f);
  }
}

TEST(FabricMarkers, theLinesAreTheEdgesEachOnce) {
  ObjectMarkers markers(std::make_unique<FabricDrawing>(kTriangles), "leader");
  const Marker lines = markersOf(markers.draw(stateOf(kFlat, {})), "object_lines").at(0);
  EXPECT_EQ(lines.type, Marker::LINE_LIST);
  EXPECT_EQ(lines.points.size(), 2u * 7u);
}

TEST(FabricMarkers, copiesAreOutlinesInTheColourOfTheirAxis) {
  ObjectMarkers markers(std::make_unique<FabricDrawing>(kTriangles), "leader");
  const MarkerArray array = markers.draw(stateOf(kFlat, {{0.1, 0, 0}, {0, 0, -0.1}}));
  const std::vector<Marker> copies = markersOf(array, "copies");
  ASSERT_EQ(copies.size(), 2u);
  EXPECT_EQ(copies[0].id, 1);
  EXPECT_EQ(copies[0].points.size(), 2u * 6u);  // all but the diagonal
  EXPECT_GT(copies[0].color.r, copies[0].color.b);
  EXPECT_GT(copies[1].color.b, copies[1].color.r);
  EXPECT_EQ(markersOf(array, "agents").size(), 1u);
}

TEST(FabricMarkers, closedSurfacesHaveAllTheirEdgesForAnOutline) {
  ObjectMarkers markers(std::make_unique<FabricDrawing>(kTetrahedron), "leader");
  const MarkerArray array = markers.draw(stateOf({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {{0.1, 0, 0}}));
  EXPECT_EQ(markersOf(array, "copies").at(0).points.size(), 2u * 6u);
}

//! The corners of the square, held by the leader: the fin's tip by nobody.
ObjectState heldAtCorners() {
  ObjectState state = stateOf(kFlat, {});
  state.object_type = ObjectState::FABRIC;
  state.agents = {"leader", "assistant"};
  state.agent_positions = {0.0, 0.0, 1.0, 0.5, 0.5, 1.0};
  state.agent_particles = {0, 4};
  state.further_particles = {2, 1, 3};
  state.further_agents = {0, 0, 0};
  return state;
}

TEST(FabricMarkers, barsJoinTheVerticesOfAGripByTheShortestLines) {
  ObjectMarkers markers(std::make_unique<FabricDrawing>(kTriangles), "leader");
  const std::vector<Marker> bars = markersOf(markers.draw(heldAtCorners()), "grips");
  ASSERT_EQ(bars.size(), 1u);
  EXPECT_EQ(bars[0].id, 0);
  EXPECT_EQ(bars[0].action, Marker::ADD);
  ASSERT_EQ(bars[0].points.size(), 2u * 3u);
  double length = 0.0;
  for (std::size_t i = 0; i < bars[0].points.size(); i += 2) {
    length += std::hypot(bars[0].points[i].x - bars[0].points[i + 1].x, bars[0].points[i].y - bars[0].points[i + 1].y);
  }
  EXPECT_NEAR(length, 3.0, 1e-12);  // three sides, not the diagonal
}

TEST(FabricMarkers, barsOfGripsThatLetGoAreDeletedOnce) {
  ObjectMarkers markers(std::make_unique<FabricDrawing>(kTriangles), "leader");
  ObjectState state = heldAtCorners();
  markers.draw(state);
  state.agent_particles[0] = -1;
  state.further_particles.clear();
  state.further_agents.clear();
  const std::vector<Marker> gone = markersOf(markers.draw(state), "grips");
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_EQ(gone[0].action, Marker::DELETE);
  EXPECT_TRUE(markersOf(markers.draw(state), "grips").empty());
}

TEST(FabricMarkers, copiesThatAreGoneAreDeleted) {
  ObjectMarkers markers(std::make_unique<FabricDrawing>(kTriangles), "leader");
  markers.draw(stateOf(kFlat, {{0.1, 0, 0}, {0, 0.1, 0}}));
  const std::vector<Marker> copies = markersOf(markers.draw(stateOf(kFlat, {{0.1, 0, 0}})), "copies");
  ASSERT_EQ(copies.size(), 2u);
  EXPECT_EQ(copies[0].action, Marker::ADD);
  EXPECT_EQ(copies[1].action, Marker::DELETE);
}

TEST(RodMarkers, aLineForTheObjectAndThinOnesForItsCopies) {
  ObjectMarkers markers(std::make_unique<RodDrawing>(0.03), "leader");
  const MarkerArray array = markers.draw(stateOf(kFlat, {{0, 0.1, 0}}));
  const Marker object = markersOf(array, "object").at(0);
  const Marker copy = markersOf(array, "copies").at(0);
  EXPECT_EQ(object.type, Marker::LINE_STRIP);
  EXPECT_EQ(object.points.size(), 5u);
  EXPECT_EQ(object.scale.x, 0.03);
  EXPECT_LT(copy.scale.x, 0.01);
  EXPECT_GT(copy.color.g, copy.color.r);
}

TEST(AgentMarkers, theLeaderIsKnownByItsNameWhereverItStands) {
  ObjectMarkers markers(std::make_unique<RodDrawing>(0.03), "leader");
  for (const std::vector<std::string>& agents : {std::vector<std::string>{"leader", "one"}, {"one", "leader"}}) {
    ObjectState state = stateOf(kFlat, {});
    state.agents = agents;
    state.agent_positions.resize(6, 0.0);
    const std::vector<Marker> balls = markersOf(markers.draw(state), "agents");
    ASSERT_EQ(balls.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(balls[i].color.r > balls[i].color.b, agents[i] == "leader");
    }
  }
}

}  // namespace
}  // namespace deformable_manipulation
