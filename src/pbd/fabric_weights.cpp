#include "fabric_weights.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

namespace deformable_manipulation {
namespace pbd {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

// Tension of the plate as a part of rigidity / area. Linear motions of the holds are continued nearly as such between
// them, but not far beyond two that are close together.
constexpr double kTension = 10.0;

//! Adds factor c c^T for a row of coefficients c.
void addOuter(Entries& to, const int* at, const double* coefficients, int count, double factor) {
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      to.emplace_back(at[i], at[j], factor * coefficients[i] * coefficients[j]);
    }
  }
}

Eigen::SparseMatrix<double> assembled(int vertices, const Entries& entries) {
  Eigen::SparseMatrix<double> matrix(vertices, vertices);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

//! Energy of a plate of flexural rigidity 1: half the square of each fold over its area.
Eigen::SparseMatrix<double> plateMatrix(const std::vector<Vector3>& vertices, const std::vector<MeshEdge>& edges) {
  Entries entries;
  for (const MeshEdge& edge : edges) {
    if (edge.interior()) {
      const std::array<double, 4> weights = foldWeights(vertices, edge);
      const int at[4] = {edge.vertices[0], edge.vertices[1], edge.opposite[0], edge.opposite[1]};
      addOuter(entries, at, weights.data(), 4, 1.0 / edge.area);
    }
  }
  return assembled(static_cast<int>(vertices.size()), entries);
}

}  // namespace

Eigen::SparseMatrix<double> membraneMatrix(int vertices, const std::vector<MeshEdge>& edges) {
  Entries entries;
  const double difference[2] = {1.0, -1.0};
  for (const MeshEdge& edge : edges) {
    addOuter(entries, edge.vertices.data(), difference, 2, edge.area / (edge.length * edge.length));
  }
  return assembled(vertices, entries);
}

Eigen::MatrixXd solveHeld(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& held,
                          const Eigen::MatrixXd& values, const Eigen::MatrixXd& load) {
  const int n = static_cast<int>(matrix.rows());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, values.cols());
  std::vector<int> place(n, 0);  // among the free vertices, or -1
  for (std::size_t i = 0; i < held.size(); ++i) {
    place[held[i]] = -1;
    result.row(held[i]) = values.row(static_cast<int>(i));
  }
  std::vector<int> free;
  for (int i = 0; i < n; ++i) {
    if (place[i] == 0) {
      place[i] = static_cast<int>(free.size());
      free.push_back(i);
    }
  }
  if (free.empty()) {
    return result;
  }
  const Eigen::MatrixXd residual = load - matrix * result;
  Eigen::MatrixXd right(free.size(), values.cols());
  for (std::size_t i = 0; i < free.size(); ++i) {
    right.row(static_cast<int>(i)) = residual.row(free[i]);
  }
  Entries entries;
  for (int column = 0; column < n; ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry) {
      if (place[column] >= 0 && place[entry.row()] >= 0) {
        entries.emplace_back(place[entry.row()], place[column], entry.value());
      }
    }
  }
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(assembled(static_cast<int>(free.size()), entries));
  const Eigen::MatrixXd solution = solver.solve(right);
  for (std::size_t i = 0; i < free.size(); ++i) {
    result.row(free[i]) = solution.row(static_cast<int>(i));
  }
  return result;
}

Eigen::MatrixXd holdWeights(const std::vector<Vector3>& vertices, const std::vector<MeshEdge>& edges,
                            const std::vector<int>& held) {
  const int n = static_cast<int>(vertices.size());
  const int holds = static_cast<int>(held.size());
  double area = 0.0;  // of each triangle three times
  for (const MeshEdge& edge : edges) {
    area += edge.area;
  }
  const Eigen::SparseMatrix<double> matrix =
      plateMatrix(vertices, edges) + (3.0 * kTension / area) * membraneMatrix(n, edges);
  Eigen::MatrixXd weights =
      solveHeld(matrix, held, Eigen::MatrixXd::Identity(holds, holds), Eigen::MatrixXd::Zero(n, holds));
  for (int i = 0; i < n; ++i) {
    weights.row(i) /= weights.row(i).sum();
  }
  return weights;
}

}  // namespace pbd
}  // namespace deformable_manipulation
