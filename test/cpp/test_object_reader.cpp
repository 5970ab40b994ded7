// The simulator's objects from the parameter server: of either kind, with every mistake at once.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "../../src/ros/object_kinds.h"
#include "../../src/ros/parameter_value_from_xmlrpc.h"
#include "deformable_manipulation/pbd/fabric_parameters.h"
#include "deformable_manipulation/pbd/object_kinds.h"

namespace deformable_manipulation {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue list(const std::vector<double>& numbers) {
  XmlRpcValue result;
  result.setSize(static_cast<int>(numbers.size()));
  for (int i = 0; i < result.size(); ++i) {
    result[i] = numbers[i];
  }
  return result;
}

XmlRpcValue indices(const std::vector<int>& numbers) {
  XmlRpcValue result;
  result.setSize(static_cast<int>(numbers.size()));
  for (int i = 0; i < result.size(); ++i) {
    result[i] = numbers[i];
  }
  return result;
}

XmlRpcValue pose() {
  XmlRpcValue result;
  result["position"] = list({0.0, 0.0, 1.0});
  result["orientation"] = list({0.0, 0.0, 0.0, 1.0});
  return result;
}

XmlRpcValue fabric() {
  XmlRpcValue result;
  result["type"] = "fabric";
  result["mesh"]["vertices"][0] = list({0.0, 0.0, 0.0});
  result["mesh"]["vertices"][1] = list({1.0, 0.0, 0.0});
  result["mesh"]["vertices"][2] = list({0.0, 2.0, 0.0});
  result["mesh"]["triangles"][0] = indices({0, 1, 2});
  result["density"] = 0.5;
  result["thickness"] = 0.002;
  result["stretching_compliance"] = 1e-5;
  result["bending_compliance"] = 1e4;
  result["damping"] = 5.0;
  result["pose"] = pose();
  return result;
}

XmlRpcValue rod() {
  XmlRpcValue result;
  result["type"] = "rod";
  result["length"] = 2.0;
  result["radius"] = 0.01;
  result["density"] = 1000.0;
  result["segments"] = 10;
  result["young_modulus"] = 1e7;
  result["torsion_modulus"] = 4e6;
  result["stretch"] = "zero";
  result["damping"] = 10.0;
  result["drag_coefficient"] = 1.2;
  result["bending_retardation_time"] = 0.05;
  result["torsion_retardation_time"] = 0.0;
  result["pose"] = pose();
  return result;
}

XmlRpcValue simulation() {
  XmlRpcValue result;
  result["gravity"] = list({0.0, 0.0, -9.81});
  result["solver"] = "direct";
  return result;
}

std::unique_ptr<pbd::Body> read(const XmlRpcValue& object) {
  pbd::ParameterCheck check;
  const ParameterValue value = toParameterValue(object);
  const ParameterValue settings = toParameterValue(simulation());
  return pbd::makeBody({value, "object", check}, {settings, "simulation", check});
}

std::vector<std::string> mistakesOf(const XmlRpcValue& object) {
  std::vector<std::string> keys;
  try {
    read(object);
  } catch (const pbd::ParameterError& error) {
    for (const pbd::Problem& problem : error.problems()) {
      keys.push_back(problem.key);
    }
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

TEST(ObjectReader, aFabricIsAllThatIsInTheScenario) {
  pbd::ParameterCheck check;
  const ParameterValue value = toParameterValue(fabric());
  const ParameterValue settings = toParameterValue(simulation());
  const pbd::FabricParameters given =
      pbd::FabricParameters::read({value, "object", check}, {settings, "simulation", check});
  check.throwIfAny();
  EXPECT_EQ(given.vertices.size(), 3u);
  EXPECT_EQ(given.vertices[2], pbd::Vector3(0.0, 2.0, 0.0));
  EXPECT_EQ(given.triangles.at(0), (std::array<int, 3>{0, 1, 2}));
  EXPECT_EQ(given.density, 0.5);
  EXPECT_EQ(given.thickness, 0.002);
  EXPECT_EQ(given.stretching_compliance, 1e-5);
  EXPECT_EQ(given.bending_compliance, 1e4);
  EXPECT_EQ(given.damping, 5.0);
  EXPECT_EQ(given.pose.position, pbd::Vector3(0.0, 0.0, 1.0));
  EXPECT_EQ(given.gravity, pbd::Vector3(0.0, 0.0, -9.81));

  const std::unique_ptr<pbd::Body> body = read(fabric());
  EXPECT_STREQ(body->kind(), "fabric");
  EXPECT_EQ(body->particleCount(), 3);
  EXPECT_EQ(body->pointCount(), 3);
  EXPECT_NEAR(body->mass(), 0.5, 1e-12);
  EXPECT_EQ(makeDrawing(value)->triangleCount(), 1);
}

TEST(ObjectReader, aRodIsALine) {
  const std::unique_ptr<pbd::Body> body = read(rod());
  EXPECT_STREQ(body->kind(), "rod");
  EXPECT_EQ(body->particleCount(), 10);
  EXPECT_EQ(makeDrawing(toParameterValue(rod()))->triangleCount(), 0);
}

TEST(ObjectReader, everyKindThatIsSimulatedIsDrawnAndSent) {
  for (const auto& maker : pbd::bodyMakers()) {
    EXPECT_NO_THROW(objectKind(maker.first));
  }
}

TEST(ObjectReader, allMistakesAreToldAtOnce) {
  XmlRpcValue object = fabric();
  object["density"] = "heavy";
  object["mesh"]["vertices"][1] = list({1.0, 0.0});
  object["mesh"]["triangles"] = 3.0;
  object["pose"]["orientation"] = list({0.0});
  const std::vector<std::string> expected = {"object.density", "object.mesh.triangles", "object.mesh.vertices.1",
                                             "object.pose.orientation"};
  EXPECT_EQ(mistakesOf(object), expected);
}

TEST(ObjectReader, unknownKindsAreRefused) {
  XmlRpcValue object = rod();
  object["type"] = "jelly";
  EXPECT_EQ(mistakesOf(object), std::vector<std::string>{"object.type"});
}

}  // namespace
}  // namespace deformable_manipulation
