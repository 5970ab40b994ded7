#pragma once

#include <memory>
#include <vector>

#include "deformable_manipulation/pbd/rest_shapes.h"
#include "deformable_manipulation/pbd/rod.h"
#include "deformable_manipulation/pbd/rod_equilibrium.h"

namespace deformable_manipulation {
namespace pbd {

//! Rest shapes of a rod: its equilibria, eight at a time.
class RodRestShapes final : public RestShapes {
 public:
  //! @param rod held nowhere
  //! @param agents where they hold it, with the orientations that they keep
  RodRestShapes(const Rod& rod, const std::vector<HeldPoint>& agents);

  int pointCount() const override { return rod_->pointCount(); }
  void setOrientations(const std::vector<Quaternion>& orientations) override;
  void forget() override { equilibrium_ = RodEquilibrium(); }
  void find(const std::vector<Vector3>& held) override;
  bool known(int shape) const override;
  void response(int shape, double* to) const override;

 protected:
  void placePresent(const double* points) override;
  void readPoints(int shape, double* to) const override { equilibrium_.points(shape, to); }

 private:
  bool isFarFromPresent() const;
  void search();

  std::unique_ptr<Rod> rod_;
  RodEquilibrium equilibrium_;
  bool turns_ = false;  // the orientations are not those from the start
  std::vector<int> agent_of_hold_;
  std::vector<Vector3> held_;    // [shapes x holds] m
  std::vector<double> present_;  // [P x 3] m
};

}  // namespace pbd
}  // namespace deformable_manipulation
