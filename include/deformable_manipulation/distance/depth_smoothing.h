#pragma once

namespace deformable_manipulation {
namespace distance {

//! Finds by how much the depths of an image are off because of noise, as of stereo cameras and structured light:
//! normal, with the same standard deviation of the inverse depth in all pixels.
//!
//! The inverse depths of a plane are linear in the rows and columns of a pinhole camera's image. Where those of the
//! pixels around one, 5 x 5, lie on a plane as well as noise explains, the plane tells the pixel's depth better than
//! the pixel itself. All others stay as they are: at edges, where less than half of the pixels have a depth, and where
//! something stands out.
//!
//! @param depths [rows x columns] m; pixels that are not finite and above 0 have none
//! @param noise [m] standard deviation of the depth at 1 m, above 0; at the depth d it is d^2 times as large
//! @param factors [rows x columns] by which to multiply the points; 1 where they stay as they are. No point moves along
//!     its ray by more than five standard deviations.
void smoothDepths(const float* depths, int rows, int columns, double noise, float* factors);

}  // namespace distance
}  // namespace deformable_manipulation
