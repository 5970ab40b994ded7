#pragma once

#include <Eigen/Core>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "deformable_manipulation/parameters/parameter_section.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace pbd {

//! How measured points correct a model: the section `correction` of a scenario.
struct CorrectionParameters {
  double noise;        //!< [m] standard deviation of a measured coordinate
  double expected;     //!< [m] standard deviation of the model's error, where it is largest
  double fading_time;  //!< [s] time constant with which the correction fades without measurements
  double smoothing;    //!< [s] time constant with which the shape follows the estimate
  double limit;        //!< [m] largest correction with which model and measurement count as agreeing
  bool stop;           //!< whether nobody shall act on a model that disagrees

  static CorrectionParameters read(const ParameterSection& correction);
};

//! A point of the object as it was seen.
struct MeasuredPoint {
  Vector3 position;  //!< m
  double place;      //!< [m] from the first end along the object; not finite: not known
};

//! The difference between a line-shaped object and its model, estimated from measured points (docs/mathematics.md).
//!
//! The difference is a sum of few smooth modes that vanish where the object is held. A Kalman filter estimates their
//! amplitudes, which wander about zero: without measurements they fade. It is applied with a delay of first order, so
//! that it never jumps. Times are those of the model's states.
class ShapeCorrection {
 public:
  //! @param arc_lengths [P] m, of the geometry points from the first end, ascending
  //! @param held [m] arc lengths at which the object is held
  ShapeCorrection(const CorrectionParameters& parameters, std::vector<double> arc_lengths, std::vector<double> held);

  //! The object is held elsewhere: what was estimated is forgotten.
  void setHolds(std::vector<double> held);

  //! Forgets all.
  void reset();

  //! Takes over the next state of the model.
  //! @param time [s], later than that of the state before
  //! @param points [P x 3] m, of the model itself
  void advance(double time, const double* points);

  //! Takes over what was seen at a time [s]. Points that are not finite, and those that are too far off to be of the
  //! object, are left out.
  //! @return why it is not used; empty: it is
  std::string measure(double time, const std::vector<MeasuredPoint>& points);

  //! [P x 3] m, to be added to the points of the model and of all its copies.
  const std::vector<double>& field() const { return field_; }

  //! [m] The largest difference that is estimated, which the field approaches.
  double largest() const;

  //! [s] since the newest measurement; infinite before the first.
  double age() const { return time_ - measured_; }

  //! Whether measurement and model have disagreed for some time: most points are too far off, or the difference is
  //! beyond the limit. It lasts until a measurement agrees.
  bool disagrees() const;

  //! Whether nobody shall act on the model now.
  bool stops() const { return parameters_.stop && disagrees(); }

  const CorrectionParameters& parameters() const { return parameters_; }

 private:
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

  //! A place between two geometry points.
  struct Place {
    int before;
    double share;  // of the way to the next one
  };

  void makeModes();
  void addModes(double begin, double end, int modes, bool free);
  Points shapeAt(double time) const;
  Place placeOf(double arc_length) const;
  Place nearest(const Points& shape, const Vector3& position) const;
  bool fuse(const Points& shape, const MeasuredPoint& point);
  void judge(bool agrees);

  CorrectionParameters parameters_;
  std::vector<double> arc_lengths_;
  std::vector<double> held_;
  Eigen::MatrixXd modes_;                       // [P x M]
  Eigen::VectorXd prior_;                       // [M] m^2, variances of the amplitudes without measurements
  Points amplitudes_;                           // [M x 3] m
  Eigen::MatrixXd covariance_;                  // [M x M] m^2, the same for each axis
  std::vector<double> field_;                   // [P x 3] m
  std::deque<std::pair<double, Points>> past_;  // times and points of the newest states
  double time_ = 0.0;
  double measured_ = -std::numeric_limits<double>::infinity();
  double disagreeing_since_ = std::numeric_limits<double>::infinity();
};

}  // namespace pbd
}  // namespace deformable_manipulation
