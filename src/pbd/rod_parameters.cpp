#include "deformable_manipulation/pbd/rod_parameters.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "natural_shape.h"
#include "rod_pieces.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

constexpr double kSharpestJoint = 1.0;  // rad; beyond, joints no longer bend and twist as a rod does
constexpr double kAirDensity = 1.2;     // kg/m^3, at sea level and 20 degrees Celsius

double area(double radius) { return M_PI * radius * radius; }

}  // namespace

NaturalShape NaturalShape::read(const ParameterSection& section) {
  return {section.vector<2>("curvature"), section.number("twist"), section.vectors("points")};
}

RodParameters RodParameters::read(const ParameterSection& object, const ParameterSection& simulation) {
  RodParameters p;
  p.length = object.number("length");
  p.radius = object.number("radius");
  p.density = object.number("density");
  p.segments = object.integer("segments");
  p.young_modulus = object.number("young_modulus");
  p.torsion_modulus = object.number("torsion_modulus");
  p.stretch = object.choice<Stretch>("stretch", {{"zero", Stretch::ZERO}, {"from_moduli", Stretch::FROM_MODULI}});
  p.damping = object.number("damping");
  p.drag_coefficient = object.number("drag_coefficient");
  p.bending_retardation_time = object.number("bending_retardation_time");
  p.torsion_retardation_time = object.number("torsion_retardation_time");
  if (object.has("natural_shape")) {
    p.natural_shape = NaturalShape::read(object.section("natural_shape"));
  }
  if (object.has("point_masses")) {
    for (const ParameterSection& point : object.sections("point_masses")) {
      p.point_masses.push_back({point.number("at"), point.number("mass")});
    }
  }
  if (object.has("grips")) {
    for (const ParameterSection& grip : object.sections("grips")) {
      p.grips.push_back({grip.integer("particle"), grip.numberOrAuto("length")});
    }
  }
  p.pose = object.section("pose").pose("position", "orientation");
  p.gravity = simulation.vector<3>("gravity");
  p.solver = simulation.choice<RodSolver>("solver",
                                          {{"direct", RodSolver::DIRECT}, {"gauss_seidel", RodSolver::GAUSS_SEIDEL}});
  return p;
}

void RodParameters::check(ParameterCheck& check) const {
  check.positive("length", length, "[m]");
  check.positive("radius", radius, "[m]");
  check.positive("density", density, "[kg/m^3]");
  check.require(segments >= 2 && segments <= 100000, "segments", segments, "a whole number from 2 to 100000");
  check.positive("young_modulus", young_modulus, "[Pa]");
  check.positive("torsion_modulus", torsion_modulus, "[Pa]");
  check.notNegative("damping", damping, "[1/s]");
  check.notNegative("drag_coefficient", drag_coefficient, "[1]");
  check.notNegative("bending_retardation_time", bending_retardation_time, "[s]");
  check.notNegative("torsion_retardation_time", torsion_retardation_time, "[s]");
  check.require(threads >= 1 && threads <= 256, "threads", threads, "a whole number from 1 to 256");
  check.require(gravity.allFinite(), "gravity", gravity.norm(), "three finite numbers [m/s^2]");
  check.require(pose.position.allFinite(), "pose.position", pose.position.norm(), "three finite numbers [m]");
  check.require(std::abs(pose.orientation.norm() - 1.0) < 1e-6, "pose.orientation", pose.orientation.norm(),
                "a quaternion of norm 1");
  checkPointMasses(check);
  if (length > 0.0 && segments >= 2 && segments <= 100000) {
    if (checkGrips(check)) {
      checkNaturalShape(check);
    }
  }
}

void RodParameters::checkNaturalShape(ParameterCheck& check) const {
  const NaturalShape& shape = natural_shape;
  const bool finite = shape.curvature.allFinite() && std::isfinite(shape.twist);
  check.require(finite, "natural_shape", shape.curvature.norm(), "finite numbers [1/m]");
  const auto apart = [](const Vector3& a, const Vector3& b) { return (b - a).norm() > 0.0; };
  bool distinct = shape.points.size() != 1;
  for (std::size_t i = 1; i < shape.points.size(); ++i) {
    distinct = distinct && apart(shape.points[i - 1], shape.points[i]);
  }
  check.require(distinct, "natural_shape.points", static_cast<double>(shape.points.size()),
                "none, or at least 2 finite points, none of them like the one before");
  if (!finite || !distinct) {
    return;
  }
  double sharpest = 0.0;
  for (const Quaternion& turn : naturalJoints(*this).turns) {
    sharpest = std::max(sharpest, turn.angularDistance(Quaternion::Identity()));
  }
  check.require(sharpest <= kSharpestJoint, "natural_shape", sharpest,
                "turns of at most 1 rad from segment to segment; take more segments");
}

//! @return whether the rod can be divided into segments
bool RodParameters::checkGrips(ParameterCheck& check) const {
  bool known = true;
  for (std::size_t i = 0; i < grips.size(); ++i) {
    const std::string key = "grips." + std::to_string(i);
    const int least = i > 0 ? grips[i - 1].particle + 1 : 0;
    const bool in_order = grips[i].particle >= least && grips[i].particle < segments;
    check.require(in_order, key + ".particle", grips[i].particle,
                  "a segment, " + std::to_string(least) + " to " + std::to_string(segments - 1));
    const double own = grips[i].length.value_or(0.0);
    const bool fits = own >= 0.0 && own < length;
    check.require(fits, key + ".length", own, "at least 0 and below the rod's length [m]");
    known = known && in_order && fits;
  }
  if (!known || grips.empty()) {
    return known;
  }
  const RodPieces pieces = rodPieces(*this);
  const double shortest = *std::min_element(pieces.lengths.begin(), pieces.lengths.end());
  const double sum = std::accumulate(pieces.lengths.begin(), pieces.lengths.end(), 0.0);
  const bool divides = static_cast<int>(pieces.lengths.size()) == segments && std::abs(sum - length) < 1e-9 * length;
  const bool fits = divides && shortest >= shortestPiece(*this);
  check.require(fits, "grips", shortest,
                "short enough that the segments between and beyond them are " + std::to_string(shortestPiece(*this)) +
                    " [m] long at least, and grips of a length with a segment between them");
  return fits;
}

void RodParameters::checkPointMasses(ParameterCheck& check) const {
  for (std::size_t i = 0; i < point_masses.size(); ++i) {
    const std::string key = "point_masses." + std::to_string(i);
    check.require(point_masses[i].at >= 0.0 && point_masses[i].at <= length, key + ".at", point_masses[i].at,
                  "a place on the rod, 0 to " + std::to_string(length) + " [m]");
    check.positive(key + ".mass", point_masses[i].mass, "[kg]");
  }
}

double RodParameters::mass() const {
  double added = 0.0;
  for (const PointMass& point : point_masses) {
    added += point.mass;
  }
  return segments * segmentMass() + added;
}

double RodParameters::segmentMass() const { return density * area(radius) * segmentLength(); }

double RodParameters::transverseInertia() const { return transverseInertia(segmentLength()); }

double RodParameters::transverseInertia(double length) const {
  return density * area(radius) * length * (3.0 * radius * radius + length * length) / 12.0;
}

double RodParameters::axialInertia() const { return 0.5 * segmentMass() * radius * radius; }

double RodParameters::dragPerDistance() const {
  return 0.5 * kAirDensity * drag_coefficient * 2.0 * radius / (density * area(radius));
}

double RodParameters::bendingStiffness() const { return young_modulus * area(radius) * radius * radius / 4.0; }

double RodParameters::torsionStiffness() const { return torsion_modulus * area(radius) * radius * radius / 2.0; }

double RodParameters::axialStiffness() const { return young_modulus * area(radius); }

}  // namespace pbd
}  // namespace deformable_manipulation
