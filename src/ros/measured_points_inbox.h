#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <string>
#include <vector>

#include "deformable_manipulation/pbd/shape_correction.h"

namespace deformable_manipulation {

//! Points of the object as they were measured, from clouds with the fields x, y, z and, where it is known how far along
//! the object a point is, arc_length [m], all float32 or all float64.
class MeasuredPointsInbox {
 public:
  //! @param frame fixed frame that clouds must be in
  explicit MeasuredPointsInbox(std::string frame) : frame_(std::move(frame)) {}

  //! @return why the cloud is dropped; empty if it is accepted
  std::string read(const sensor_msgs::PointCloud2& message);

  //! Those of the last cloud that was accepted; some may not be finite.
  const std::vector<pbd::MeasuredPoint>& points() const { return points_; }

 private:
  std::string frame_;
  std::vector<pbd::MeasuredPoint> points_;
};

}  // namespace deformable_manipulation
