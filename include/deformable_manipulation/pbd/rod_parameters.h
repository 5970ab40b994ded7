#pragma once

#include <optional>
#include <vector>

#include "deformable_manipulation/parameters/parameter_section.h"
#include "deformable_manipulation/pbd/errors.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace pbd {

//! How the axial stiffness of a rod is chosen.
enum class Stretch {
  ZERO,        //!< the segments stay end to end, to numerical precision
  FROM_MODULI  //!< axial stiffness E A
};

//! How the joints of a rod are solved in a substep.
enum class RodSolver {
  GAUSS_SEIDEL,  //!< joint by joint (the paper's Algorithm 1)
  DIRECT         //!< the whole chain at once, block tridiagonal
};

//! The shape that a rod has without load: straight, unless there are numbers other than zero or points.
struct NaturalShape {
  Eigen::Vector2d curvature = Eigen::Vector2d::Zero();  //!< [1/m] about the y and the z axis of the segments
  double twist = 0.0;                                   //!< [rad/m] about their x axis
  std::vector<Vector3> points;                          //!< [m] its centre line, in place of the curvature

  bool isStraight() const { return points.empty() && twist == 0.0 && curvature.isZero(0.0); }

  //! Reads a section `natural_shape`.
  static NaturalShape read(const ParameterSection& section);
};

//! A mass that a rod carries at a place: a marker, a plug, a fitting.
struct PointMass {
  double at;    //!< [m] along the rod, from its first end
  double mass;  //!< [kg]
};

//! A place that an agent holds.
struct Grip {
  int particle;                  //!< held segment
  std::optional<double> length;  //!< [m] of the rod that the gripper keeps straight; none: it holds a usual segment
};

//! A rod of circular cross-section. Only the values are here; ranges, defaults and meanings of the keys are
//! declared in Python, see docs/parameters.md.
struct RodParameters {
  double length;           //!< [m]
  double radius;           //!< [m]
  double density;          //!< [kg/m^3]
  int segments;            //!< rigid segments, at least 2
  double young_modulus;    //!< [Pa] bending
  double torsion_modulus;  //!< [Pa] twist
  Stretch stretch;
  double damping;                         //!< [1/s] decay rate of motion relative to the held points
  double drag_coefficient = 0.0;          //!< of the cross-section in still air, across the axis
  double bending_retardation_time = 0.0;  //!< [s] viscosity over stiffness of bending (Kelvin-Voigt)
  double torsion_retardation_time = 0.0;  //!< [s] likewise of twist
  NaturalShape natural_shape;
  std::vector<PointMass> point_masses;
  std::vector<Grip> grips;  //!< in the order of their segments; those next to a grip of a length are shorter
  RodSolver solver;
  int threads = 1;  //!< that advance the copies, eight in each; results do not depend on it
  Vector3 gravity;  //!< [m/s^2]
  Pose pose;        //!< undeformed rod: first end at the position, along the pose's x axis

  //! Reads the sections `object` and `simulation`; `threads` is not one of their keys.
  static RodParameters read(const ParameterSection& object, const ParameterSection& simulation);

  //! Notes every parameter that is out of range.
  void check(ParameterCheck& check) const;

  double mass() const;                                        //!< [kg] of all, with the point masses
  double segmentLength() const { return length / segments; }  //!< [m] the usual one
  double segmentMass() const;                                 //!< [kg] without point masses
  double transverseInertia() const;                           //!< [kg m^2] of a segment, across its axis
  double transverseInertia(double length) const;              //!< [kg m^2] likewise, of one of a length [m]
  double axialInertia() const;                                //!< [kg m^2] of a segment, about its axis
  double dragPerDistance() const;                             //!< [1/m] speed lost across the axis, per way through air
  double bendingStiffness() const;                            //!< E I [N m^2]
  double torsionStiffness() const;                            //!< G J [N m^2]
  double axialStiffness() const;                              //!< E A [N]

 private:
  void checkNaturalShape(ParameterCheck& check) const;
  void checkPointMasses(ParameterCheck& check) const;
  bool checkGrips(ParameterCheck& check) const;
};

}  // namespace pbd
}  // namespace deformable_manipulation
