#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "fabric_mesh.h"

namespace deformable_manipulation {
namespace pbd {

//! Stiffness of a membrane of tension 1 N/m, [N x N]: springs along the edges.
Eigen::SparseMatrix<double> membraneMatrix(int vertices, const std::vector<MeshEdge>& edges);

//! Minimises x^T matrix x / 2 - x^T load, with the values of the held vertices given.
//! @param held    vertices, different ones
//! @param values  [held x columns]
//! @param load    [N x columns]
//! @return [N x columns]
Eigen::MatrixXd solveHeld(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& held,
                          const Eigen::MatrixXd& values, const Eigen::MatrixXd& load);

//! How much each vertex goes with each held one, [N x held]; rows sum to 1. Smooth whatever the resolution: the
//! deflection of a thin plate under tension on point supports.
Eigen::MatrixXd holdWeights(const std::vector<Vector3>& vertices, const std::vector<MeshEdge>& edges,
                            const std::vector<int>& held);

}  // namespace pbd
}  // namespace deformable_manipulation
