#include "deformable_manipulation/pbd/fabric_parameters.h"

#include <cmath>

#include "fabric_mesh.h"

namespace deformable_manipulation {
namespace pbd {

FabricParameters FabricParameters::read(const ParameterSection& object, const ParameterSection& simulation) {
  FabricParameters p;
  const ParameterSection mesh = object.section("mesh");
  p.vertices = mesh.vectors("vertices");
  for (const Vector3& triangle : mesh.vectors("triangles")) {
    p.triangles.push_back(
        {static_cast<int>(triangle[0]), static_cast<int>(triangle[1]), static_cast<int>(triangle[2])});
  }
  p.density = object.number("density");
  p.thickness = object.number("thickness");
  p.stretching_compliance = object.number("stretching_compliance");
  p.bending_compliance = object.number("bending_compliance");
  p.damping = object.number("damping");
  p.pose = object.section("pose").pose("position", "orientation");
  p.gravity = simulation.vector<3>("gravity");
  return p;
}

void FabricParameters::check(ParameterCheck& check) const {
  checkMesh(vertices, triangles, check);
  check.positive("density", density, "[kg/m^2]");
  check.positive("thickness", thickness, "[m]");
  checkFabricMaterial(stretching_compliance, bending_compliance, damping, check);
  check.require(threads >= 1 && threads <= 256, "threads", threads, "a whole number from 1 to 256");
  check.require(gravity.allFinite(), "gravity", gravity.norm(), "three finite numbers [m/s^2]");
  check.require(pose.position.allFinite(), "pose.position", pose.position.norm(), "three finite numbers [m]");
  check.require(std::abs(pose.orientation.norm() - 1.0) < 1e-6, "pose.orientation", pose.orientation.norm(),
                "a quaternion of norm 1");
}

void checkFabricMaterial(double stretching_compliance, double bending_compliance, double damping,
                         ParameterCheck& check) {
  check.notNegative("stretching_compliance", stretching_compliance, "[m/N]");
  check.require(bending_compliance >= 0.0, "bending_compliance", bending_compliance,
                "a number >= 0 [1/(N m)], infinity for no bending stiffness");
  check.notNegative("damping", damping, "[1/s]");
}

}  // namespace pbd
}  // namespace deformable_manipulation
