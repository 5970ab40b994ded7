#pragma once

#include <vector>

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Quaternion;
using pbd::Vector3;
using pbd::Vector6;

//! Shape and reactions of the object in one state, and how they follow its A held points. A view: it owns nothing.
//!
//! The derivatives are those of the object at rest. Moving all held points together moves the object as it is, so the
//! derivatives by the held points sum to the identity (points) or to zero (wrenches).
struct ObjectShape {
  int agents = 0;
  int points = 0;                       //!< P
  const double* coordinates = nullptr;  //!< [P x 3] m
  const double* response = nullptr;     //!< [A x P x 3 x 3] d point / d held point; null: not known
  const double* turning = nullptr;  //!< [A x P x 3 x 3] d point / d turn about the held point; null: grips do not turn
  const double* orientations = nullptr;     //!< [A x 4] x, y, z, w of the grips; null: those from the start
  const double* wrenches = nullptr;         //!< [A x 6] N and N m on the agents; null: not known
  const double* wrench_response = nullptr;  //!< [A x 6 x A x 6] d wrench / d held point, turn; null: not known

  Eigen::Map<const Vector3> point(int i) const { return Eigen::Map<const Vector3>(coordinates + 3L * i); }
  Eigen::Map<const Vector6> wrench(int agent) const { return Eigen::Map<const Vector6>(wrenches + 6L * agent); }

  //! Orientation of a grip that had another one at the start.
  Quaternion orientation(int agent, const Quaternion& start) const {
    return orientations != nullptr ? Quaternion(Eigen::Map<const Quaternion>(orientations + 4L * agent)) : start;
  }

  //! Adds the change of by . point i to the gradients [A] by the held points and, if known, by turns about them.
  void addPointGradient(int i, const Vector3& by, std::vector<Vector6>& gradients) const {
    using Derivative = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
    for (int agent = 0; agent < agents; ++agent) {
      const long at = 9L * (static_cast<long>(agent) * points + i);
      gradients[agent].head<3>() += Derivative(response + at).transpose() * by;
      if (turning != nullptr) {
        gradients[agent].tail<3>() += Derivative(turning + at).transpose() * by;
      }
    }
  }

  //! Adds the change of by . wrench of an agent to the gradients [A] by the held points and by turns about them.
  void addWrenchGradient(int of, const Vector6& by, std::vector<Vector6>& gradients) const {
    for (int component = 0; component < 6; ++component) {
      for (int agent = 0; agent < agents; ++agent) {
        const double* derivative = wrench_response + 6L * ((6L * of + component) * agents + agent);
        gradients[agent] += by[component] * Eigen::Map<const Vector6>(derivative);
      }
    }
  }
};

}  // namespace control
}  // namespace deformable_manipulation
