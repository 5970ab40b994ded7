#pragma once

#include <array>
#include <vector>

#include "deformable_manipulation/pbd/errors.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace pbd {

//! Vertices of a triangle.
using Triangle = std::array<int, 3>;

//! A fabric: a triangle mesh, of any resolution, with mass, membrane and bending stiffness.
struct FabricParameters {
  std::vector<Vector3> vertices;               //!< [m] unstretched
  std::vector<Triangle> triangles;             //!< one connected surface; which way round they go does not matter
  double density = 0.2;                        //!< [kg/m^2]
  double thickness = 0.001;                    //!< [m] for distances only
  double stretching_compliance = 1e-4;         //!< [m/N] 1 / (E t), inverse membrane stiffness; 0: inextensible
  double bending_compliance = 1e4;             //!< [1/(N m)] inverse flexural rigidity; infinity: no stiffness
  double damping = 10.0;                       //!< [1/s] decay rate of motion relative to the held points
  int threads = 1;                             //!< that advance the copies, eight in each; results do not depend on it
  Vector3 gravity = Vector3(0.0, 0.0, -9.81);  //!< [m/s^2]
  Pose pose;                                   //!< undeformed, vertex v lies at position + orientation * v

  //! Notes every parameter that is out of range and everything that is wrong with the mesh.
  void check(ParameterCheck& check) const;
};

//! Notes what is out of range among the parameters that can change while running.
void checkFabricMaterial(double stretching_compliance, double bending_compliance, double damping,
                         ParameterCheck& check);

}  // namespace pbd
}  // namespace deformable_manipulation
