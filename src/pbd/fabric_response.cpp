#include "fabric_response.h"

#include <algorithm>

namespace deformable_manipulation {
namespace pbd {
namespace {

// A fabric's vertices move about as fast as its holds. Much more: it is about to snap, and the derivative says little
// about what comes after.
constexpr double kLargestResponse = 10.0;

// Calls for which the last derivative counts on while the fabric snaps.
constexpr int kSnapLasts = 300;

Eigen::Map<const Vector3> vertexIn(const double* positions, int vertex) {
  return Eigen::Map<const Vector3>(positions + 3 * vertex);
}

}  // namespace

FabricResponse::FabricResponse(int vertices, const FabricConstraints& constraints, const std::vector<HeldPoint>& holds)
    : free_(vertices, 0), held_(vertices, -1), held_count_(static_cast<int>(holds.size())) {
  for (int hold = 0; hold < held_count_; ++hold) {
    held_[holds[hold].particle] = hold;
  }
  for (int vertex = 0; vertex < vertices; ++vertex) {
    free_[vertex] = held_[vertex] < 0 ? free_count_++ : -1;
  }
  makePattern(constraints);
  right_.resize(3 * free_count_, 3 * held_count_);
}

void FabricResponse::makePattern(const FabricConstraints& constraints) {
  rows_.resize(free_count_);
  const auto couple = [this](const int* at, int count) {
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) {
        const int column = free_[vertexAt(at[i])];
        const int row = free_[vertexAt(at[j])];
        if (column >= 0 && row >= 0) {
          rows_[column].push_back(row);
        }
      }
    }
  };
  for (const HingeConstraint& hinge : constraints.hinges()) {
    couple(hinge.at, 4);
  }
  for (const BoundaryConstraint& boundary : constraints.boundaries()) {
    couple(boundary.at, 2);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < free_count_; ++column) {
    std::vector<int>& rows = rows_[column];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (int row : rows) {
      for (int k = 0; k < 9; ++k) {
        entries.emplace_back(3 * row + k / 3, 3 * column + k % 3, 0.0);
      }
    }
  }
  stiffness_.resize(3 * free_count_, 3 * free_count_);
  stiffness_.setFromTriplets(entries.begin(), entries.end());
  solver_.analyzePattern(stiffness_);
}

ResponseStatus FabricResponse::compute(const FabricConstraints& constraints, const double* positions, double* to) {
  assemble(constraints, positions);
  missed_ = free_count_ == 0 || solve() ? 0 : missed_ + 1;
  if (missed_ > (moved_.size() > 0 ? kSnapLasts : 0)) {
    return ResponseStatus::UNSTABLE;
  }
  write(to);
  return ResponseStatus::VALID;
}

void FabricResponse::assemble(const FabricConstraints& constraints, const double* positions) {
  std::fill_n(stiffness_.valuePtr(), stiffness_.nonZeros(), 0.0);
  right_.setZero();
  const double* spring = constraints.springs().data();
  const double* fold = constraints.folds().data();
  for (const HingeConstraint& hinge : constraints.hinges()) {
    addSpring(hinge.at, *spring++, hinge.stretch.rest_length, positions);
    addFold(hinge, *fold++);
  }
  for (const BoundaryConstraint& boundary : constraints.boundaries()) {
    addSpring(boundary.at, *spring++, boundary.stretch.rest_length, positions);
  }
}

void FabricResponse::addSpring(const int* at, double spring, double rest_length, const double* positions) {
  const int start = vertexAt(at[0]);
  const int end = vertexAt(at[1]);
  const Vector3 span = vertexIn(positions, end) - vertexIn(positions, start);
  const double part = rest_length / span.norm();  // of the stiffness along the edge that is missing across it
  const Vector3 along = span.normalized();
  const Eigen::Matrix3d block =
      spring * ((1.0 - part) * Eigen::Matrix3d::Identity() + part * along * along.transpose());
  add(start, start, block);
  add(end, end, block);
  add(start, end, -block);
  add(end, start, -block);
}

void FabricResponse::addFold(const HingeConstraint& hinge, double spring) {
  const std::array<double, 4> weights = weightsOf(hinge);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      add(vertexAt(hinge.at[i]), vertexAt(hinge.at[j]), spring * weights[i] * weights[j] * Eigen::Matrix3d::Identity());
    }
  }
}

void FabricResponse::add(int vertex, int other, const Eigen::Matrix3d& block) {
  const int row = free_[vertex];
  if (row < 0) {
    return;
  }
  if (held_[other] >= 0) {
    right_.block<3, 3>(3 * row, 3 * held_[other]) -= block;
    return;
  }
  const int column = free_[other];
  const std::vector<int>& rows = rows_[column];
  const auto place = std::lower_bound(rows.begin(), rows.end(), row) - rows.begin();
  for (int axis = 0; axis < 3; ++axis) {
    double* to = stiffness_.valuePtr() + stiffness_.outerIndexPtr()[3 * column + axis] + 3 * place;
    Eigen::Map<Vector3>(to) += block.col(axis);
  }
}

//! False if the shape is not stable or about to snap.
bool FabricResponse::solve() {
  solver_.factorize(stiffness_);
  if (solver_.info() != Eigen::Success || !(solver_.vectorD().minCoeff() > 0.0)) {
    return false;
  }
  solution_ = solver_.solve(right_);
  if (!(solution_.cwiseAbs().maxCoeff() < kLargestResponse)) {
    return false;
  }
  moved_.swap(solution_);
  return true;
}

void FabricResponse::write(double* to) const {
  using Response = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  for (int hold = 0; hold < held_count_; ++hold) {
    for (std::size_t vertex = 0; vertex < free_.size(); ++vertex, to += 9) {
      Response response(to);
      if (free_[vertex] >= 0) {
        response = moved_.block<3, 3>(3 * free_[vertex], 3 * hold);
      } else {
        response.setZero();
        response.diagonal().setConstant(held_[vertex] == hold ? 1.0 : 0.0);
      }
    }
  }
}

}  // namespace pbd
}  // namespace deformable_manipulation
