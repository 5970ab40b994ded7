#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <memory>
#include <string>
#include <utility>

#include "deformable_manipulation/ObjectState.h"
#include "object_drawing.h"

namespace deformable_manipulation {

//! Draws a state for RViz: the object, its copies in one colour per displaced axis (x red, y green,
//! z blue), and the agents with their names.
class ObjectMarkers {
 public:
  //! @param leader  its name
  ObjectMarkers(std::unique_ptr<ObjectDrawing> drawing, std::string leader)
      : leader_(std::move(leader)), drawing_(std::move(drawing)) {}

  long triangleCount() const { return drawing_->triangleCount(); }

  //! Copies that are gone since the last call are deleted.
  visualization_msgs::MarkerArray draw(const ObjectState& state);

 private:
  std::string leader_;
  std::unique_ptr<ObjectDrawing> drawing_;
  std::size_t copies_drawn_ = 0;
};

}  // namespace deformable_manipulation
