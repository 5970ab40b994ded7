#pragma once

#include <memory>
#include <vector>

#include "deformable_manipulation/distance/minimum_distance.h"
#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace control {

using pbd::Pose;
using pbd::Vector3;

//! Poses at equal intervals, straight in between; before and after them the first and the last.
struct PosePath {
  double begin = 0.0;  //!< [s] of the first pose
  double step = 1.0;   //!< [s] > 0
  std::vector<Pose> poses;

  Pose at(double time) const;
};

//! Distances of an object's future shapes from an obstacle on a known path, each shape at its own time.
//!
//! The obstacle stays where it is; each shape is put where it is as seen from the obstacle at its time. So all of them
//! are computed at once, whatever the path.
//!
//! An obstacle that moves into a shape would have the shape leave by the nearest side, which need not be the one from
//! which it came. Such a shape has the feature of the obstacle at present, as far as that moves along its normal.
class ObstacleForecast {
 public:
  //! @param distance from this obstacle alone, at the pose `place`
  //! @throw std::invalid_argument if the path has no pose or no step
  ObstacleForecast(std::shared_ptr<distance::MinimumDistance> distance, const Pose& place, PosePath path);

  //! Another path. @throw std::invalid_argument as above
  void setPath(PosePath path);

  //! The nearest feature of each shape, in the fixed frame.
  //! @param object its copies are the shapes
  //! @param times [copies] s
  //! @param now [s] the present
  //! @return [copies] valid until the next call; of an obstacle that stands
  const std::vector<distance::Feature>& compute(const distance::ObjectView& object, const std::vector<double>& times,
                                                double now);

 private:
  void find(const distance::ObjectView& object, const std::vector<double>& times,
            std::vector<distance::Feature>* features);
  void keepSides(const distance::ObjectView& object, const std::vector<double>& times, double now);

  std::shared_ptr<distance::MinimumDistance> distance_;
  Pose place_;
  PosePath path_;
  std::vector<double> points_;  // [copies x points x 3] m, as seen from the obstacle at `place`
  std::vector<distance::Feature> features_;
  std::vector<distance::Feature> present_;  // of the obstacle where it is now
};

}  // namespace control
}  // namespace deformable_manipulation
