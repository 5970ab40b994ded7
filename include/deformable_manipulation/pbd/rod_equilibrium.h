#pragma once

#include <memory>
#include <vector>

#include "deformable_manipulation/pbd/response.h"
#include "deformable_manipulation/pbd/rod.h"

namespace deformable_manipulation {
namespace pbd {

//! When a search for an equilibrium ends.
struct EquilibriumOptions {
  double tolerance = 1e-5;  //!< of the last step, turns [rad] and relative forces; the error left is about its square
  int iterations = 20;      //!< at most, per start
  bool turned = false;      //!< updateElsewhere(): clamped segments may be turned against the rod's present shape
};

//! The quasi-static equilibrium of a rod's copies by Newton's method, and its exact derivative with
//! respect to each held point by implicit differentiation (docs/mathematics.md).
//!
//! It is the equilibrium of the same rigid segments and joints that the simulation advances, so a rod at rest is in it.
//! Each search starts from the last equilibrium that was found. The first search, and a search after a failure, start
//! from the rod's present shape.
class RodEquilibrium {
 public:
  RodEquilibrium();
  RodEquilibrium(const RodEquilibrium& other);
  RodEquilibrium& operator=(const RodEquilibrium& other);
  ~RodEquilibrium();

  //! Finds the equilibria of the first `copies` copies at their present held points.
  void update(const Rod& rod, int copies, const EquilibriumOptions& options = EquilibriumOptions());

  //! Finds the equilibria in which the rod would rest if it were held elsewhere, beside its present shape.
  //! @param held [shapes x holds] m, positions of the held points; orientations are those of the rod's holds
  //! Searches start from the last shapes found, the first ones, and those after a failure, from the rod's present
  //! shape.
  void updateElsewhere(const Rod& rod, const std::vector<Vector3>& held, const EquilibriumOptions& options);

  int copyCount() const;
  ResponseStatus status(int copy) const;

  //! Newton steps of the last update.
  int iterations() const;

  //! Points of a copy in equilibrium, [pointCount x 3] m. @throw std::logic_error unless VALID
  void points(int copy, double* to) const;

  //! Derivatives of a copy's points with respect to its held points, [holds x pointCount x 3 x 3].
  //! @throw std::logic_error unless VALID
  void response(int copy, double* to) const;

  //! The same by turns [rad] about each held point, [holds x pointCount x 3 x 3] m; zero where a hold is pinned.
  //! @throw std::logic_error unless VALID
  void turningResponse(int copy, double* to) const;

  //! What a copy exerts on its agents, [holds x 6]: force [N], torque about the held point [N m].
  //! @throw std::logic_error unless VALID
  void wrenches(int copy, double* to) const;

  //! Derivatives of these with respect to each held point and turns about it, [holds x 6 x holds x 6].
  //! @throw std::logic_error unless VALID
  void wrenchResponse(int copy, double* to) const;

 private:
  void requireValid(int copy) const;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pbd
}  // namespace deformable_manipulation
