#pragma once

#include <vector>

#include "deformable_manipulation/pbd/rest_shapes.h"

namespace deformable_manipulation {
namespace control {

using pbd::Vector3;

//! Shapes of an object to first order, for objects whose rest shapes are not known.
class LinearShapes final : public pbd::RestShapes {
 public:
  //! What the object does when its held points move.
  //! @param held [A] m, the held points now
  //! @param response [A x P x 3 x 3] d point / d held point; of all agents together the identity
  void setResponse(std::vector<Vector3> held, const std::vector<double>& response);

  int pointCount() const override { return points_; }
  void forget() override {}
  void find(const std::vector<Vector3>& held) override { moved_ = held; }
  bool known(int /*shape*/) const override { return true; }
  void response(int shape, double* to) const override;

 protected:
  void placePresent(const double* points) override { present_ = points; }
  void readPoints(int shape, double* to) const override;

 private:
  int points_ = 0;
  const double* present_ = nullptr;  // [P x 3] m
  std::vector<Vector3> held_;        // [A] m
  std::vector<Vector3> moved_;       // [shapes x A] m
  std::vector<double> response_;     // [A x P x 3 x 3]
};

}  // namespace control
}  // namespace deformable_manipulation
