#pragma once

#include <vector>

#include "deformable_manipulation/control/barrier.h"
#include "deformable_manipulation/control/class_k.h"

namespace deformable_manipulation {
namespace control {

//! The region in which the held points of the commanded assistants may be, in the fixed frame.
struct WorkspaceParameters {
  //! All points x with normal . x >= level.
  struct HalfSpace {
    Vector3 normal;  //!< unit vector into the half space
    double level;    //!< [m]
  };
  //! A ball to stay out of.
  struct Ball {
    Vector3 center;  //!< [m]
    double radius;   //!< [m]
  };

  std::vector<HalfSpace> half_spaces;  //!< to stay in
  std::vector<Ball> balls;             //!< to stay out of
  double margin;                       //!< [m] by which the rows stay within them
  PiecewiseLinearClassK alpha;

  //! Reads the section `controller.workspace`.
  static WorkspaceParameters read(const ParameterSection& workspace);
};

//! Keeps the held point x of each commanded assistant within half spaces and out of balls.
//!
//! A half space has h = n . x - level with the gradient n, a ball h = |x - c| - r with (x - c) / |x - c|; in the
//! ball's centre, where there is no direction, x is driven along the x axis. With the gradient g and the assistant's
//! own velocity u,
//!
//!   g . u >= -alpha(h - margin).
//!
//! Rows that every velocity within the bounds satisfies are left out.
class WorkspaceBarrier : public Barrier {
 public:
  WorkspaceBarrier(const WorkspaceParameters& parameters, const Team& team) : parameters_(parameters), team_(team) {}

  double value(const PresentState& state, int agent) const override;

  void addRows(const Features& features, const PredictedState& state, BarrierRows& rows) const override;

 private:
  template <typename Take>
  void forEachLimit(const Vector3& position, Take take) const;

  WorkspaceParameters parameters_;
  Team team_;
};

}  // namespace control
}  // namespace deformable_manipulation
