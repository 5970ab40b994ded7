#include "deformable_manipulation/control/barriers/strain_barrier.h"

#include <utility>

namespace deformable_manipulation {
namespace control {

int StrainBarrier::count(const ObjectShape& shape) const {
  return shape.coordinates != nullptr ? static_cast<int>(edges_.size()) : 0;
}

double StrainBarrier::load(const ObjectShape& shape, int edge) const {
  const Edge& e = edges_[edge];
  return (shape.point(e.second) - shape.point(e.first)).norm() / e.length - 1.0;
}

void StrainBarrier::addGradient(const ObjectShape& shape, int edge, std::vector<Vector6>& gradients) const {
  const Edge& e = edges_[edge];
  const Vector3 along = (shape.point(e.second) - shape.point(e.first)).normalized() / e.length;
  shape.addPointGradient(e.first, -along, gradients);
  shape.addPointGradient(e.second, along, gradients);
}

namespace barriers {

std::unique_ptr<Barrier> strain(const ParameterSection& section, const Team& team) {
  const Eigen::MatrixXd rows = section.matrix("edges");
  section.check().require(rows.cols() == 3, section.pathOf("edges"), static_cast<double>(rows.cols()),
                          "rows of two points and a length");
  std::vector<StrainBarrier::Edge> edges;
  for (Eigen::Index i = 0; i < rows.rows() && rows.cols() == 3; ++i) {
    edges.push_back({static_cast<int>(rows(i, 0)), static_cast<int>(rows(i, 1)), rows(i, 2)});
  }
  const LoadParameters parameters = LoadParameters::read(section, section.number("max_strain"));
  return std::make_unique<StrainBarrier>(parameters, std::move(edges), team);
}

}  // namespace barriers
}  // namespace control
}  // namespace deformable_manipulation
