#pragma once

#include <vector>

#include "deformable_manipulation/control/barrier.h"
#include "deformable_manipulation/control/class_k.h"

namespace deformable_manipulation {
namespace control {

//! Parameters of a limit of what the object bears.
struct LoadParameters {
  double limit;    //!< in the unit of the load
  double reserve;  //!< part of it that the rows keep
  PiecewiseLinearClassK alpha;

  //! @param limit the greatest load
  static LoadParameters read(const ParameterSection& section, double limit);
};

//! Keeps loads of the object below a limit: h = limit - load, in the unit of the load.
//!
//! A load depends on the object's shape and reactions, and so on all held points. Its rows are shared by the assistants
//! like those of the distance to obstacles (docs/mathematics.md, "Loads"). A load that is not known limits nothing.
class LoadBarrier : public Barrier {
 public:
  LoadBarrier(const LoadParameters& parameters, const Team& team);

  double value(const PresentState& state, int agent) const override;
  void addRows(const Features& features, const PredictedState& state, BarrierRows& rows) const override;
  bool needsResponse() const override { return true; }

  //! Infinite, positive or negative: a load has no distance from its limit.
  double clearance(const PresentState& state, int agent) const override;

 protected:
  //! Number of loads that are known in a shape.
  virtual int count(const ObjectShape& shape) const = 0;

  //! The limit of a load, in its unit.
  virtual double limit(int /*item*/) const { return parameters_.limit; }

  //! A load.
  virtual double load(const ObjectShape& shape, int item) const = 0;

  //! Adds the derivative of a load by each held point, and by turns about it, to the gradients [A].
  virtual void addGradient(const ObjectShape& shape, int item, std::vector<Vector6>& gradients) const = 0;

  //! Whether a load is one that an agent has to do with.
  virtual bool concerns(int item, int agent) const;

  //! Whether the derivatives are known.
  virtual bool isDifferentiable(const ObjectShape& shape) const = 0;

  const Team& team() const { return team_; }

 private:
  double leastMargin(const PresentState& state, int agent, double reserve) const;
  void addRow(double load, double limit, const PredictedState& state, BarrierRows& rows) const;

  LoadParameters parameters_;
  Team team_;
  mutable std::vector<Vector6> gradients_;  // [A] by held points and turns; reused: nothing is allocated in a cycle
};

}  // namespace control
}  // namespace deformable_manipulation
