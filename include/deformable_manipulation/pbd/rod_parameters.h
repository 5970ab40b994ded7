#pragma once

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

//! A straight rod of circular cross-section.
struct RodParameters {
  double length = 1.0;           //!< [m]
  double radius = 0.005;         //!< [m]
  double density = 1000.0;       //!< [kg/m^3]
  int segments = 20;             //!< rigid segments, at least 2
  double young_modulus = 1e7;    //!< [Pa] bending
  double torsion_modulus = 4e6;  //!< [Pa] twist
  Stretch stretch = Stretch::ZERO;
  double damping = 10.0;  //!< [1/s] decay rate of motion relative to the held points
  RodSolver solver = RodSolver::DIRECT;
  int threads = 1;                             //!< that advance the copies, eight in each; results do not depend on it
  Vector3 gravity = Vector3(0.0, 0.0, -9.81);  //!< [m/s^2]
  Pose pose;                                   //!< undeformed rod: first end at the position, along the pose's x axis

  //! Notes every parameter that is out of range.
  void check(ParameterCheck& check) const;

  double segmentLength() const { return length / segments; }  //!< [m]
  double segmentMass() const;                                 //!< [kg]
  double transverseInertia() const;                           //!< [kg m^2] of a segment, across its axis
  double axialInertia() const;                                //!< [kg m^2] of a segment, about its axis
  double bendingStiffness() const;                            //!< E I [N m^2]
  double torsionStiffness() const;                            //!< G J [N m^2]
  double axialStiffness() const;                              //!< E A [N]
};

}  // namespace pbd
}  // namespace deformable_manipulation
