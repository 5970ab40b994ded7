#include "object_reader.h"

#include "deformable_manipulation/pbd/fabric.h"
#include "deformable_manipulation/pbd/rod.h"

namespace deformable_manipulation {
namespace {

enum class Kind { ROD, FABRIC };

pbd::RodParameters readRod(const ScenarioSection& object, const ScenarioSection& simulation) {
  pbd::RodParameters rod;
  rod.length = object.number("length");
  rod.radius = object.number("radius");
  rod.density = object.number("density");
  rod.segments = object.integer("segments");
  rod.young_modulus = object.number("young_modulus");
  rod.torsion_modulus = object.number("torsion_modulus");
  rod.stretch = object.choice<pbd::Stretch>("stretch",
                                            {{"zero", pbd::Stretch::ZERO}, {"from_moduli", pbd::Stretch::FROM_MODULI}});
  rod.damping = object.number("damping");
  rod.pose = object.section("pose").pose("position", "orientation");
  rod.gravity = simulation.vector<3>("gravity");
  rod.solver = simulation.choice<pbd::RodSolver>(
      "solver", {{"direct", pbd::RodSolver::DIRECT}, {"gauss_seidel", pbd::RodSolver::GAUSS_SEIDEL}});
  return rod;
}

pbd::FabricParameters readFabric(const ScenarioSection& object, const ScenarioSection& simulation) {
  pbd::FabricParameters fabric;
  const ScenarioSection mesh = object.section("mesh");
  fabric.vertices = mesh.vectors("vertices");
  for (const pbd::Vector3& triangle : mesh.vectors("triangles")) {
    const Eigen::Vector3i corners = triangle.cast<int>();
    fabric.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  fabric.density = object.number("density");
  fabric.thickness = object.number("thickness");
  fabric.stretching_compliance = object.number("stretching_compliance");
  fabric.bending_compliance = object.number("bending_compliance");
  fabric.damping = object.number("damping");
  fabric.pose = object.section("pose").pose("position", "orientation");
  fabric.gravity = simulation.vector<3>("gravity");
  return fabric;
}

struct BodyMaker {
  std::unique_ptr<pbd::Body> operator()(const pbd::RodParameters& rod) const { return std::make_unique<pbd::Rod>(rod); }
  std::unique_ptr<pbd::Body> operator()(const pbd::FabricParameters& fabric) const {
    return std::make_unique<pbd::Fabric>(fabric);
  }
};

struct ShapeMaker {
  ObjectShape operator()(const pbd::RodParameters& rod) const { return {2.0 * rod.radius, {}}; }
  ObjectShape operator()(const pbd::FabricParameters& fabric) const { return {fabric.thickness, fabric.triangles}; }
};

}  // namespace

ObjectParameters readObject(const ScenarioSection& object, const ScenarioSection& simulation) {
  if (object.choice<Kind>("type", {{"rod", Kind::ROD}, {"fabric", Kind::FABRIC}}) == Kind::FABRIC) {
    return readFabric(object, simulation);
  }
  return readRod(object, simulation);
}

std::unique_ptr<pbd::Body> makeBody(const ObjectParameters& parameters) { return std::visit(BodyMaker(), parameters); }

ObjectShape shapeOf(const ObjectParameters& parameters) { return std::visit(ShapeMaker(), parameters); }

}  // namespace deformable_manipulation
