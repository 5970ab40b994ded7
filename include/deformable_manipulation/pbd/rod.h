#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/pbd/body.h"
#include "deformable_manipulation/pbd/rod_parameters.h"

namespace deformable_manipulation {
namespace pbd {

struct JointStiffness;
struct NaturalJoints;
struct RodPieces;
struct SegmentMasses;

//! A rope or rod: rigid segments, joined by zero-stretch bending-twisting constraints (Deul et al.
//! 2018), with small substeps (Macklin et al. 2019); Algorithm 1 of the paper.
//!
//! The particles are the segments, held at their centres; the geometry points the N + 1 ends.
class Rod final : public Body {
 public:
  //! A straight rod at rest at its pose, held nowhere.
  //! @throw ParameterError
  explicit Rod(const RodParameters& parameters);
  ~Rod() override;

  const RodParameters& parameters() const { return parameters_; }
  const std::shared_ptr<const RodPieces>& pieces() const { return pieces_; }
  const std::shared_ptr<const NaturalJoints>& naturalJoints() const { return natural_; }
  const std::shared_ptr<const SegmentMasses>& segmentMasses() const { return masses_; }

  //! Keys: young_modulus, torsion_modulus [Pa], damping [1/s], drag_coefficient, bending_retardation_time,
  //! torsion_retardation_time [s].
  void setMaterial(const std::vector<MaterialParameter>& parameters) override;

  std::unique_ptr<Body> clone() const override;
  const char* kind() const override { return "rod"; }
  double largestStretch() const override { return 0.01; }  //!< less than a thousandth to any load in use
  int particleCount() const override { return parameters_.segments; }
  int pointCount() const override { return parameters_.segments + 1; }
  std::vector<double> arcLengths() const override;
  std::vector<double> jointLengths() const;  //!< [N - 1] m, of the rod that bends in each joint
  double freeLength(int particle, int other) const override;
  Pose undeformedPose(int particle) const override;
  bool particlesTurn() const override { return true; }
  double mass() const override { return parameters_.mass(); }
  double stretch() const override;
  std::string softness(double time_step, int substeps) const override;
  Wrench wrench(int particle, int copy = 0) const override;

  //! Not available where a grip holds several segments.
  ResponseStatus response(double* to) override;
  bool turningResponse(double* to) const override;
  bool wrenchResponse(double* to) const override;
  std::unique_ptr<RestShapes> restShapes(const std::vector<HeldPoint>& agents) const override;
  void layOut() override;

  //! Puts the object itself, at rest, into a shape, without a twist but its natural one.
  //! @param points [(segments + 1) x 3] m; segments lie between them, as long as they are anyway
  void setShape(const double* points);

  void points(double* to) const override;
  Pose pose(int particle) const override;
  void positions(int copy, double* to) const override;
  void velocities(int copy, double* to) const override;
  bool orientations(int copy, double* to) const override;

  //! [rad] Of the N - 1 joints of a copy, up to a turn either way.
  void twists(int copy, double* to) const;

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
  std::vector<MaterialParameter> dampings() const override;

 private:
  struct State;
  Rod(const Rod& other);

  void placeMasses();
  const HeldPoint* firstClamped() const;
  void shiftPositions(int segment, double by);
  Vector3 centre(int segment, int copy) const;
  void describeJoints(double h);
  JointStiffness jointStiffness(int joint, double h) const;
  void closeGaps();
  void updateReferenceMotion();
  void dampTowardsReference(double h);
  void letReferenceFall();
  void placeCopy(int copy, const std::vector<Pose>& segments);

  std::vector<Quaternion> framesFrom(int start, const Quaternion& frame, const std::vector<Vector3>& directions) const;

  RodParameters parameters_;
  std::shared_ptr<const RodPieces> pieces_;  // shared with clones, as are the two below
  std::shared_ptr<const NaturalJoints> natural_;
  std::shared_ptr<const SegmentMasses> masses_;
  std::unique_ptr<State> state_;
};

}  // namespace pbd
}  // namespace deformable_manipulation
