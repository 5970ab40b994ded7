#pragma once

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

//! A straight rod of circular cross-section. Only the values are here; ranges, defaults and meanings of the keys are
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
  RodSolver solver;
  int threads = 1;  //!< that advance the copies, eight in each; results do not depend on it
  Vector3 gravity;  //!< [m/s^2]
  Pose pose;        //!< undeformed rod: first end at the position, along the pose's x axis

  //! Reads the sections `object` and `simulation`; `threads` is not one of their keys.
  static RodParameters read(const ParameterSection& object, const ParameterSection& simulation);

  //! Notes every parameter that is out of range.
  void check(ParameterCheck& check) const;

  double segmentLength() const { return length / segments; }  //!< [m]
  double segmentMass() const;                                 //!< [kg]
  double transverseInertia() const;                           //!< [kg m^2] of a segment, across its axis
  double axialInertia() const;                                //!< [kg m^2] of a segment, about its axis
  double dragPerDistance() const;                             //!< [1/m] speed lost across the axis, per way through air
  double bendingStiffness() const;                            //!< E I [N m^2]
  double torsionStiffness() const;                            //!< G J [N m^2]
  double axialStiffness() const;                              //!< E A [N]
};

}  // namespace pbd
}  // namespace deformable_manipulation
