#pragma once

#include <array>
#include <vector>

#include "deformable_manipulation/pbd/types.h"
#include "fabric_kernel.h"
#include "fabric_mesh.h"

namespace deformable_manipulation {
namespace pbd {

//! The constraints of a fabric as the kernel solves them, and the forces that they come to.
class FabricConstraints {
 public:
  FabricConstraints(const std::vector<Vector3>& vertices, const std::vector<MeshEdge>& edges);

  //! Sets the gains for substeps of h [s]; nothing is allocated.
  //! @param inverse_mass  [vertices] 1/kg, zero where held
  //! @param damping       1/s
  void update(const std::vector<double>& inverse_mass, double stretching_compliance, double bending_compliance,
              double damping, double h);

  const std::vector<HingeConstraint>& hinges() const { return hinges_; }
  const std::vector<BoundaryConstraint>& boundaries() const { return boundaries_; }

  //! [hinges and then boundaries] N/m, force by elongation of each edge in the state of rest.
  const std::vector<double>& springs() const { return elastic_; }

  //! [m/N] What the springs come to as a compliance of the fabric: the mean over the edges.
  double stretchingCompliance() const;

  //! [hinges] N/m, force by fold.
  const std::vector<double>& folds() const { return elastic_fold_; }

  //! Fills in the unstretched lengths of the edges, [edges x lane].
  void restLengths(AlignedArray& to) const;

  //! Numbers that the kernel records.
  std::size_t recordedSize() const {
    return kRecordedOfHinge * hinges_.size() + kRecordedOfBoundary * boundaries_.size();
  }

  //! [N] What all constraints exert on a vertex of a copy, in the substep that was recorded.
  //! @param recorded from its lane on
  Vector3 force(int vertex, const double* recorded) const;

 private:
  //! What does not change with material, holds and time step.
  struct Rest {
    double length_share;  // compliance of the edge as a part of the fabric's stretching compliance
    double fold_area;     // m^2, compliance of the fold as a part of the fabric's bending compliance; 0 on the boundary
    double fineness;      // factor of the least compliance: fine folds take up more energy
  };

  void updateFolds(const std::vector<double>& inverse_mass, double bending_compliance, double h);

  std::vector<HingeConstraint> hinges_;
  std::vector<BoundaryConstraint> boundaries_;
  std::vector<Rest> rest_;                      // of the hinges, then the boundary edges
  std::vector<double> unfolded_;                // [vertices] largest part of a fold that a substep takes away
  std::vector<double> spring_, fold_spring_;    // N/m, force by excess of length and by fold; as rest_
  std::vector<double> elastic_, elastic_fold_;  // N/m, of the edges and folds in the state of rest; as rest_
};

//! The vertex at a place in the arrays of lanes.
int vertexAt(int place);

//! Weights of the four vertices of a hinge, whose sum is the fold.
std::array<double, 4> weightsOf(const HingeConstraint& hinge);

//! An order in which items that touch a common vertex are several places apart, as near to the order given as that
//! allows: their solution can overlap in the processor.
std::vector<int> independentOrder(const std::vector<std::vector<int>>& vertices_of_items, int vertices);

}  // namespace pbd
}  // namespace deformable_manipulation
