#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "deformable_manipulation/pbd/body.h"
#include "fabric_constraints.h"

namespace deformable_manipulation {
namespace pbd {

//! How a fabric at rest follows its held vertices, by implicit differentiation: the forces on the free vertices stay
//! zero, K dx + K_h dx_h = 0 with the second derivatives of the energy of springs and folds.
class FabricResponse {
 public:
  FabricResponse(int vertices, const FabricConstraints& constraints, const std::vector<HeldPoint>& holds);

  //! While the fabric snaps from one shape to another, the last derivative before counts on for some calls.
  //! @param constraints  those given before, up to date
  //! @param positions    [N x 3] m, of a shape near to an equilibrium
  //! @param to           [grips x N x 3 x 3] d vertex / d grip's point; written only where the result is VALID
  ResponseStatus compute(const FabricConstraints& constraints, const double* positions, double* to);

  //! The same by turns about the points of the grips that hold several vertices.
  //! @param to [grips x N x 3 x 3] m; zero for the others. @return false: there are no such grips, or the last
  //! compute() was not VALID
  bool turns(double* to) const;

  //! The derivative of the wrenches at the grips for the same shape, by the second derivatives between held vertices
  //! and all others.
  //! @param constraints, positions  those of the last compute()
  //! @param forces                  [N x 3] N that the fabric exerts at its held vertices
  //! @param to                      [grips x 6 x grips x 6] d (force, torque) / d (grip's point, turn)
  //! @return false: the last compute() was not VALID
  bool wrenches(const FabricConstraints& constraints, const double* positions, const double* forces, double* to);

 private:
  using Sparse = Eigen::SparseMatrix<double>;

  //! A grip and its columns among the right-hand sides.
  struct Grip {
    int vertex;       // at its point
    int turn_column;  // of turns, behind those of all displacements; -1: it holds a single vertex
  };

  void describeGrips(const std::vector<HeldPoint>& holds);
  void makePattern(const FabricConstraints& constraints);
  void assemble(const FabricConstraints& constraints, const double* positions);
  template <typename Add>
  void forAllBlocks(const FabricConstraints& constraints, const double* positions, Add add) const;
  void add(int vertex, int other, const Eigen::Matrix3d& block);
  void addHeld(int row, int held, const Eigen::Matrix3d& block);
  bool solve();
  void write(double* to) const;
  void addForceChange(int vertex, int other, const Eigen::Matrix3d& block);
  Eigen::Matrix<double, 6, 6> wrenchChange(int of, int by, const double* forces) const;

  std::vector<int> free_;  // [N] place among the free vertices, or -1
  std::vector<int> grip_;  // [N] grip that holds the vertex, or -1
  std::vector<Grip> grips_;
  std::vector<Vector3> arms_;  // [N] m, from the grip's point, of held vertices
  int free_count_ = 0;
  std::vector<std::vector<int>> rows_;  // [free] free vertices in the same spring or fold, sorted
  Sparse stiffness_;                    // K, N/m
  Eigen::MatrixXd right_;               // -K_h, N/m
  Eigen::MatrixXd solution_;
  Eigen::MatrixXd moved_;   // [3 free x columns] the last solution that was stable
  Eigen::MatrixXd forces_;  // [3 N x columns] change of the forces at held vertices, N/m
  int missed_ = 0;          // calls since that
  bool known_ = false;      // the last call was VALID
  Eigen::SimplicialLDLT<Sparse> solver_;
};

}  // namespace pbd
}  // namespace deformable_manipulation
