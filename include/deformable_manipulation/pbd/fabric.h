#pragma once

#include <memory>
#include <vector>

#include "deformable_manipulation/pbd/body.h"
#include "deformable_manipulation/pbd/fabric_parameters.h"

namespace deformable_manipulation {
namespace pbd {

class FabricResponse;

//! A fabric: springs along the edges of a triangle mesh and bending across them (Bergou et al. 2006), by extended
//! position-based dynamics (Macklin et al. 2016) with small substeps (Macklin et al. 2019).
//!
//! Particles and geometry points are the vertices. Particles have no orientation: CLAMPED and PINNED hold a single one
//! alike, and poses have the identity.
class Fabric final : public Body {
 public:
  //! The unstretched fabric at rest at its pose, held nowhere.
  //! @throw ParameterError
  explicit Fabric(const FabricParameters& parameters);
  ~Fabric() override;

  const FabricParameters& parameters() const { return parameters_; }

  //! [m/N] The stretching compliance that the fabric has with substeps of this length [s]: that of its material, or
  //! more if its springs are too stiff for the mesh, its mass and the substep.
  double effectiveCompliance(double substep) const;

  //! The lowest number of substeps of a time step [s], from `least` to `most`, that keeps the compliance of the
  //! material; `most` if none does.
  int substepsForStiffness(double time_step, int least, int most) const;
  std::string softness(double time_step, int substeps) const override;

  //! Keys: stretching_compliance [m/N], bending_compliance [1/(N m)], damping [1/s].
  void setMaterial(const std::vector<MaterialParameter>& parameters) override;

  std::unique_ptr<Body> clone() const override;
  const char* kind() const override { return "fabric"; }
  double largestStretch() const override { return 0.05; }  //!< fabrics may be softer
  int particleCount() const override { return static_cast<int>(parameters_.vertices.size()); }
  int pointCount() const override { return particleCount(); }

  //! [m] Distance along the unstretched surface: exact where it is flat and convex, elsewhere the length of a path
  //! on the surface that is nearly the shortest, so never too short.
  double freeLength(int particle, int other) const override;
  Pose undeformedPose(int particle) const override;
  bool particlesTurn() const override { return false; }
  double mass() const override;

  //! Mean elongation of the edges, weighted with the area of their triangles.
  double stretch() const override;
  Wrench wrench(int particle, int copy = 0) const override;

  //! Computed at the present shape, which is near an equilibrium unless it moves fast. NOT_CONVERGED before the first
  //! step after a change of holds or material. While the fabric snaps to another shape, the last response stays in use
  //! for up to 300 calls; then it is UNSTABLE.
  ResponseStatus response(double* to) override;

  //! Of grips that hold several vertices; turns about a single one move nothing.
  bool turningResponse(double* to) const override;
  bool wrenchResponse(double* to) const override;
  void layOut() override;
  void points(double* to) const override;
  Pose pose(int particle) const override;
  void positions(int copy, double* to) const override;
  void velocities(int copy, double* to) const override;
  bool orientations(int copy, double* to) const override;

 protected:
  void holdsChanged() override;
  void resizeCopies() override;
  void assignCopy(int to, int from) override;
  void beginStep(double h) override;
  void substep() override;
  void endStep() override;
  int firstNonFinite(int copy) const override;
  double highestSpeed() const override;
  void stop() override;
  void displace(int particle, const Vector3& by) override;
  void placeState(const double* points, const double* velocities) override;
  std::vector<MaterialParameter> dampings() const override { return {{"damping", parameters_.damping}}; }

 private:
  struct State;
  Fabric(const Fabric& other);

  void updateCarriedMotion();

  FabricParameters parameters_;
  std::unique_ptr<State> state_;
  std::unique_ptr<FabricResponse> response_;  // once it is asked for, until the holds change
};

}  // namespace pbd
}  // namespace deformable_manipulation
