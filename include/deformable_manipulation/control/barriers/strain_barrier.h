#pragma once

#include <vector>

#include "deformable_manipulation/control/load_barrier.h"

namespace deformable_manipulation {
namespace control {

//! Keeps the edges of a fabric from being stretched too far: h = max_strain - (length / unstretched length - 1).
class StrainBarrier final : public LoadBarrier {
 public:
  //! An edge between two points.
  struct Edge {
    int first;
    int second;
    double length;  //!< [m] unstretched
  };

  StrainBarrier(const LoadParameters& parameters, std::vector<Edge> edges, const Team& team)
      : LoadBarrier(parameters, team), edges_(std::move(edges)) {}

 protected:
  int count(const ObjectShape& shape) const override;
  double load(const ObjectShape& shape, int edge) const override;
  void addGradient(const ObjectShape& shape, int edge, std::vector<Vector6>& gradients) const override;
  bool isDifferentiable(const ObjectShape& shape) const override { return shape.response != nullptr; }

 private:
  std::vector<Edge> edges_;
};

}  // namespace control
}  // namespace deformable_manipulation
