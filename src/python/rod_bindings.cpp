#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "deformable_manipulation/pbd/rod.h"
#include "deformable_manipulation/pbd/rod_equilibrium.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

std::unique_ptr<Rod> makeRod(double length, double radius, double density, int segments, double young_modulus,
                             double torsion_modulus, const std::string& stretch, double damping,
                             double drag_coefficient, double bending_retardation_time, double torsion_retardation_time,
                             const Eigen::Vector2d& natural_curvature, double natural_twist,
                             const std::vector<Vector3>& natural_points,
                             const std::vector<std::pair<double, double>>& point_masses,
                             const std::vector<std::pair<int, std::optional<double>>>& grips, const std::string& solver,
                             int threads, const Vector3& gravity, const Vector3& position, const Vector4& orientation) {
  RodParameters p;
  p.length = length;
  p.radius = radius;
  p.density = density;
  p.segments = segments;
  p.young_modulus = young_modulus;
  p.torsion_modulus = torsion_modulus;
  p.stretch = choose<Stretch>("stretch", stretch, {{"zero", Stretch::ZERO}, {"from_moduli", Stretch::FROM_MODULI}});
  p.damping = damping;
  p.drag_coefficient = drag_coefficient;
  p.bending_retardation_time = bending_retardation_time;
  p.torsion_retardation_time = torsion_retardation_time;
  p.natural_shape = {natural_curvature, natural_twist, natural_points};
  for (const auto& [at, mass] : point_masses) {
    p.point_masses.push_back({at, mass});
  }
  for (const auto& [particle, held] : grips) {
    p.grips.push_back({particle, held});
  }
  p.solver =
      choose<RodSolver>("solver", solver, {{"gauss_seidel", RodSolver::GAUSS_SEIDEL}, {"direct", RodSolver::DIRECT}});
  p.threads = threads;
  p.gravity = gravity;
  p.pose = {position, toQuaternion(orientation)};
  return std::make_unique<Rod>(p);
}

void requireCopy(const RodEquilibrium& equilibrium, int copy) {
  if (copy < 0 || copy >= equilibrium.copyCount()) {
    throw py::index_error("the equilibria of " + std::to_string(equilibrium.copyCount()) + " copies are known");
  }
}

//! An equilibrium with the sizes of the rod that it was found for.
struct BoundEquilibrium {
  RodEquilibrium equilibrium;
  int holds = 0;
  int points = 0;

  void update(const Rod& rod, int copies, double tolerance, int iterations) {
    if (copies < 1 || copies > rod.copyCount()) {
      throw py::value_error("copies is " + std::to_string(copies) + "; it must be 1 to " +
                            std::to_string(rod.copyCount()));
    }
    if (!(tolerance > 0.0 && tolerance <= 0.01)) {
      throw py::value_error("tolerance is " + std::to_string(tolerance) + "; it must be > 0 and <= 0.01");
    }
    if (iterations < 1 || iterations > 1000) {
      throw py::value_error("iterations is " + std::to_string(iterations) + "; it must be 1 to 1000");
    }
    holds = static_cast<int>(rod.holds().size());
    points = rod.pointCount();
    equilibrium.update(rod, copies, {tolerance, iterations});
  }
};

}  // namespace

void bindRod(py::module_& module) {
  py::class_<Rod, Body>(
      module, "Rod",
      "A rope or rod of rigid segments with zero-stretch bending-twisting joints (Deul et al. 2018)\n"
      "and small substeps. The particles are the segments, the points their N + 1 ends.\n\n"
      "length, radius [m], density [kg/m^3], young_modulus, torsion_modulus [Pa], damping [1/s] of\n"
      "motion relative to the held points, drag_coefficient across the axis in still air, "
      "retardation times [s] of bending and twist (viscosity\n"
      "over stiffness), natural_curvature (2,) about the segments' y and z axes [1/m], natural_twist\n"
      "[rad/m], natural_points (K, 3) [m] in place of the curvature, point_masses: pairs of the place\n"
      "along the rod [m] and the mass [kg]; grips: pairs of a held segment and the length [m] that its\n"
      "gripper keeps straight, None for a segment of the usual length; gravity (3,) [m/s^2]; stretch 'zero' or "
      "'from_moduli';\n"
      "solver 'direct' or 'gauss_seidel'; threads that advance the copies, eight each. Undeformed it "
      "lies along the x axis of the pose given by\n"
      "position (3,) [m] and orientation (4,). Raises ParameterError.")
      .def(py::init(&makeRod), py::kw_only(), py::arg("length"), py::arg("radius"), py::arg("density"),
           py::arg("segments"), py::arg("young_modulus"), py::arg("torsion_modulus"), py::arg("stretch"),
           py::arg("damping"), py::arg("drag_coefficient") = 0.0, py::arg("bending_retardation_time") = 0.0,
           py::arg("torsion_retardation_time") = 0.0, py::arg("natural_curvature") = Eigen::Vector2d::Zero().eval(),
           py::arg("natural_twist") = 0.0, py::arg("natural_points") = std::vector<Vector3>(),
           py::arg("point_masses") = std::vector<std::pair<double, double>>(),
           py::arg("grips") = std::vector<std::pair<int, std::optional<double>>>(), py::arg("solver"),
           py::arg("threads") = 1, py::arg("gravity"), py::arg("position") = Vector3::Zero().eval(),
           py::arg("orientation") = Vector4(0.0, 0.0, 0.0, 1.0))
      .def_property_readonly("arc_lengths", &Rod::arcLengths, "Of the segments' ends (N + 1,) [m].")
      .def_property_readonly("joint_lengths", &Rod::jointLengths,
                             "Length of the rod that bends in each joint (N - 1,) [m].");
}

void bindRestShapes(py::module_& module) {
  py::class_<RestShapes, std::shared_ptr<RestShapes>>(
      module, "RestShapes", "Shapes in which an object would rest if its agents held it elsewhere than they do.");
}

void bindEquilibrium(py::module_& module) {
  py::class_<BoundEquilibrium>(
      module, "RodEquilibrium",
      "The quasi-static equilibrium of a rod's copies by Newton's method, and its exact derivative with respect to\n"
      "each held point by implicit differentiation. Each update starts from the last one.")
      .def(py::init<>())
      .def("update", &BoundEquilibrium::update, py::arg("rod"), py::arg("copies") = 1, py::arg("tolerance") = 1e-5,
           py::arg("iterations") = 20, py::call_guard<py::gil_scoped_release>(),
           "Finds the equilibria of the first copies at their present holds. tolerance: of the last Newton step,\n"
           "turns [rad] and relative forces.")
      .def_property_readonly(
          "iterations", [](const BoundEquilibrium& e) { return e.equilibrium.iterations(); },
          "Newton steps of the last update.")
      .def(
          "valid",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            return e.equilibrium.status(copy) == ResponseStatus::VALID;
          },
          py::arg("copy") = 0, "Whether the equilibrium of a copy was found.")
      .def(
          "status",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            return describe(e.equilibrium.status(copy));
          },
          py::arg("copy") = 0, "'valid', or why the equilibrium of a copy is not known.")
      .def(
          "points",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            Array array({e.points, 3});
            e.equilibrium.points(copy, array.mutable_data());
            return array;
          },
          py::arg("copy") = 0, "Points (P, 3) [m] of a copy in equilibrium.")
      .def(
          "response",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            Array array({e.holds, e.points, 3, 3});
            e.equilibrium.response(copy, array.mutable_data());
            return array;
          },
          py::arg("copy") = 0, "d point / d held point, (H, P, 3, 3), holds in the order of their particles.")
      .def(
          "turning_response",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            Array array({e.holds, e.points, 3, 3});
            e.equilibrium.turningResponse(copy, array.mutable_data());
            return array;
          },
          py::arg("copy") = 0, "d point / d turn about the held point [m/rad], (H, P, 3, 3).")
      .def(
          "wrenches",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            Array array({e.holds, 6});
            e.equilibrium.wrenches(copy, array.mutable_data());
            return array;
          },
          py::arg("copy") = 0, "Force [N] and torque about the held point [N m] on each agent, (H, 6).")
      .def(
          "wrench_response",
          [](const BoundEquilibrium& e, int copy) {
            requireCopy(e.equilibrium, copy);
            Array array({e.holds, 6, e.holds, 6});
            e.equilibrium.wrenchResponse(copy, array.mutable_data());
            return array;
          },
          py::arg("copy") = 0, "d wrench / d held point and turn about it, (H, 6, H, 6).");
}

}  // namespace pbd
}  // namespace deformable_manipulation
