#pragma once

#include <array>
#include <vector>

#include "deformable_manipulation/parameters/parameter_section.h"
#include "deformable_manipulation/pbd/errors.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace pbd {

//! Vertices of a triangle.
using Triangle = std::array<int, 3>;

//! A fabric: a triangle mesh, of any resolution, with mass, membrane and bending stiffness. Only the values are here;
//! ranges, defaults and meanings of the keys are declared in Python, see docs/parameters.md.
struct FabricParameters {
  std::vector<Vector3> vertices;    //!< [m] unstretched
  std::vector<Triangle> triangles;  //!< one connected surface; their winding does not matter
  double density;                   //!< [kg/m^2]
  double thickness;                 //!< [m] for distances only
  double stretching_compliance;     //!< [m/N] 1 / (E t), inverse membrane stiffness; 0: inextensible
  double bending_compliance;        //!< [1/(N m)] inverse flexural rigidity; infinity: no stiffness
  double damping;                   //!< [1/s] decay rate of motion relative to the held points
  int threads = 1;                  //!< that advance the copies, eight in each; results do not depend on it
  Vector3 gravity;                  //!< [m/s^2]
  Pose pose;                        //!< undeformed, vertex v lies at position + orientation * v

  //! Reads the sections `object` and `simulation`; `threads` is not one of their keys.
  static FabricParameters read(const ParameterSection& object, const ParameterSection& simulation);

  //! Notes every parameter that is out of range and everything that is wrong with the mesh.
  void check(ParameterCheck& check) const;
};

//! Notes what is out of range among the parameters that can change while running.
void checkFabricMaterial(double stretching_compliance, double bending_compliance, double damping,
                         ParameterCheck& check);

}  // namespace pbd
}  // namespace deformable_manipulation
