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

using Response = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

//! How a point turns about another one: d (turn x arm) / d turn.
Eigen::Matrix3d turning(const Vector3& arm) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, arm.z(), -arm.y(), -arm.z(), 0.0, arm.x(), arm.y(), -arm.x(), 0.0;
  return matrix;
}

Eigen::Map<const Vector3> vertexIn(const double* positions, int vertex) {
  return Eigen::Map<const Vector3>(positions + 3 * vertex);
}

template <typename Add>
void forSpring(const int* at, double spring, double rest_length, const double* positions, Add add) {
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

template <typename Add>
void forFold(const HingeConstraint& hinge, double spring, Add add) {
  const std::array<double, 4> weights = weightsOf(hinge);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      add(vertexAt(hinge.at[i]), vertexAt(hinge.at[j]), spring * weights[i] * weights[j] * Eigen::Matrix3d::Identity());
    }
  }
}

}  // namespace

FabricResponse::FabricResponse(int vertices, const FabricConstraints& constraints, const std::vector<HeldPoint>& holds)
    : free_(vertices, 0), grip_(vertices, -1), arms_(vertices, Vector3::Zero()) {
  describeGrips(holds);
  for (int vertex = 0; vertex < vertices; ++vertex) {
    free_[vertex] = grip_[vertex] < 0 ? free_count_++ : -1;
  }
  makePattern(constraints);
}

void FabricResponse::describeGrips(const std::vector<HeldPoint>& holds) {
  for (const HeldPoint& hold : holds) {
    if (hold.leads()) {
      grips_.push_back({hold.particle, -1});
    }
  }
  int columns = 3 * static_cast<int>(grips_.size());
  for (const HeldPoint& hold : holds) {
    const auto leads = [&](const Grip& grip) { return grip.vertex == hold.grip; };
    const auto grip = std::find_if(grips_.begin(), grips_.end(), leads);
    grip_[hold.particle] = static_cast<int>(grip - grips_.begin());
    if (!hold.leads() && grip->turn_column < 0) {
      grip->turn_column = columns;
      columns += 3;
    }
  }
  right_.resize(3 * std::count(grip_.begin(), grip_.end(), -1), columns);
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
  known_ = missed_ <= (moved_.size() > 0 ? kSnapLasts : 0);
  if (!known_) {
    return ResponseStatus::UNSTABLE;
  }
  write(to);
  return ResponseStatus::VALID;
}

void FabricResponse::assemble(const FabricConstraints& constraints, const double* positions) {
  std::fill_n(stiffness_.valuePtr(), stiffness_.nonZeros(), 0.0);
  right_.setZero();
  for (std::size_t vertex = 0; vertex < grip_.size(); ++vertex) {
    if (grip_[vertex] >= 0) {
      arms_[vertex] = vertexIn(positions, static_cast<int>(vertex)) - vertexIn(positions, grips_[grip_[vertex]].vertex);
    }
  }
  forAllBlocks(constraints, positions,
               [this](int vertex, int other, const Eigen::Matrix3d& block) { add(vertex, other, block); });
}

//! Calls add(vertex, other, block) for all blocks of second derivatives of the energy [N/m].
template <typename Add>
void FabricResponse::forAllBlocks(const FabricConstraints& constraints, const double* positions, Add add) const {
  const double* spring = constraints.springs().data();
  const double* fold = constraints.folds().data();
  for (const HingeConstraint& hinge : constraints.hinges()) {
    forSpring(hinge.at, *spring++, hinge.stretch.rest_length, positions, add);
    forFold(hinge, *fold++, add);
  }
  for (const BoundaryConstraint& boundary : constraints.boundaries()) {
    forSpring(boundary.at, *spring++, boundary.stretch.rest_length, positions, add);
  }
}

void FabricResponse::add(int vertex, int other, const Eigen::Matrix3d& block) {
  const int row = free_[vertex];
  if (row < 0) {
    return;
  }
  if (grip_[other] >= 0) {
    addHeld(row, other, block);
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

void FabricResponse::addHeld(int row, int held, const Eigen::Matrix3d& block) {
  right_.block<3, 3>(3 * row, 3 * grip_[held]) -= block;
  const int column = grips_[grip_[held]].turn_column;
  if (column >= 0) {
    right_.block<3, 3>(3 * row, column) -= block * turning(arms_[held]);
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
  for (int grip = 0; grip < static_cast<int>(grips_.size()); ++grip) {
    for (std::size_t vertex = 0; vertex < free_.size(); ++vertex, to += 9) {
      Response response(to);
      if (free_[vertex] >= 0) {
        response = moved_.block<3, 3>(3 * free_[vertex], 3 * grip);
      } else {
        response.setZero();
        response.diagonal().setConstant(grip_[vertex] == grip ? 1.0 : 0.0);
      }
    }
  }
}

bool FabricResponse::turns(double* to) const {
  if (!known_) {
    return false;
  }
  bool any = false;
  for (int grip = 0; grip < static_cast<int>(grips_.size()); ++grip) {
    const int column = grips_[grip].turn_column;
    any = any || column >= 0;
    for (std::size_t vertex = 0; vertex < free_.size(); ++vertex, to += 9) {
      Response response(to);
      if (column >= 0 && free_[vertex] >= 0) {
        response = moved_.block<3, 3>(3 * free_[vertex], column);
      } else if (grip_[vertex] == grip) {
        response = turning(arms_[vertex]);
      } else {
        response.setZero();
      }
    }
  }
  return any;
}

bool FabricResponse::wrenches(const FabricConstraints& constraints, const double* positions, const double* forces,
                              double* to) {
  if (!known_) {
    return false;
  }
  forces_.setZero(3 * static_cast<Eigen::Index>(free_.size()), right_.cols());
  forAllBlocks(constraints, positions,
               [this](int vertex, int other, const Eigen::Matrix3d& block) { addForceChange(vertex, other, block); });
  const int grips = static_cast<int>(grips_.size());
  for (int of = 0; of < grips; ++of) {
    for (int by = 0; by < grips; ++by) {
      const Eigen::Matrix<double, 6, 6> change = wrenchChange(of, by, forces);
      for (int row = 0; row < 6; ++row) {
        Eigen::Map<Vector6>(to + 6 * ((6 * of + row) * grips + by)) = change.row(row).transpose();
      }
    }
  }
  return true;
}

//! Adds what the motion of another vertex changes of the force at a held one.
void FabricResponse::addForceChange(int vertex, int other, const Eigen::Matrix3d& block) {
  if (grip_[vertex] < 0) {
    return;
  }
  auto change = forces_.middleRows<3>(3 * vertex);
  if (grip_[other] < 0) {
    change.noalias() -= block * moved_.middleRows<3>(3 * free_[other]);
    return;
  }
  change.middleCols<3>(3 * grip_[other]) -= block;
  const int column = grips_[grip_[other]].turn_column;
  if (column >= 0) {
    change.middleCols<3>(column) -= block * turning(arms_[other]);
  }
}

//! The change of a grip's wrench by the point of a grip and turns about it: of the forces at its vertices, and of their
//! arms where it turns itself.
Eigen::Matrix<double, 6, 6> FabricResponse::wrenchChange(int of, int by, const double* forces) const {
  Eigen::Matrix<double, 6, 6> change = Eigen::Matrix<double, 6, 6>::Zero();
  const int turn_column = grips_[by].turn_column;
  for (int vertex = 0; vertex < static_cast<int>(grip_.size()); ++vertex) {
    if (grip_[vertex] != of) {
      continue;
    }
    Eigen::Matrix<double, 3, 6> force = Eigen::Matrix<double, 3, 6>::Zero();
    force.leftCols<3>() = forces_.block<3, 3>(3 * vertex, 3 * by);
    if (turn_column >= 0) {
      force.rightCols<3>() = forces_.block<3, 3>(3 * vertex, turn_column);
    }
    change.topRows<3>() += force;
    change.bottomRows<3>() -= turning(arms_[vertex]) * force;  // arm x force
    if (of == by) {
      change.bottomRightCorner<3, 3>() += turning(vertexIn(forces, vertex)) * turning(arms_[vertex]);
    }
  }
  return change;
}

}  // namespace pbd
}  // namespace deformable_manipulation
