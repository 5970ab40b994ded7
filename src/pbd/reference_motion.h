#pragma once

#include <vector>

#include "deformable_manipulation/pbd/body.h"

namespace deformable_manipulation {
namespace pbd {

// Damping acts on the motion relative to a reference, so that an object carried along keeps the
// shape it has at rest. The functions write [n x 3] m/s and [n x 3] rad/s.

//! Motion of the held points, blended linearly along a chain of particles between neighbouring holds.
//! @param places [n] of the particles along the chain, ascending
//! @pre holds is sorted by particle and not empty
void carriedMotion(const std::vector<HeldPoint>& holds, const std::vector<double>& places, double* velocity,
                   double* angular_velocity);

//! A rod's segment as a rigid body.
struct SegmentMotion {
  double relative_mass;  // over that of a plain segment
  double added_inertia;  // kg m^2, across the axis
  double axial_inertia;  // kg m^2, about the axis
  Vector3 position;      // m
  Vector3 tangent;
  Vector3 velocity;          // m/s
  Vector3 angular_velocity;  // rad/s
};

//! The rigid motion with the same momentum and angular momentum as a free chain of segments.
//! @param mass, transverse_inertia  of a plain segment
void rigidMotion(const std::vector<SegmentMotion>& segments, double mass, double transverse_inertia, double* velocity,
                 double* angular_velocity);

//! A vertex as a point mass.
struct PointMotion {
  double mass;       // kg
  Vector3 position;  // m
  Vector3 velocity;  // m/s
};

//! The rigid motion with the same momentum and angular momentum as free points, [points x 3] m/s.
void rigidMotion(const std::vector<PointMotion>& points, double* velocity);

}  // namespace pbd
}  // namespace deformable_manipulation
