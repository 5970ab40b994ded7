#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <memory>

#include "deformable_manipulation/ObjectState.h"
#include "object_drawing.h"

namespace deformable_manipulation {

//! Draws a state for RViz: the object, its copies in one colour per displaced axis (x red, y green,
//! z blue), and the agents with their names.
class ObjectMarkers {
 public:
  //! @param leader  its index among the agents
  ObjectMarkers(const ObjectShape& shape, int leader) : leader_(leader), drawing_(makeDrawing(shape)) {}

  //! Copies that are gone since the last call are deleted.
  visualization_msgs::MarkerArray draw(const ObjectState& state);

 private:
  int leader_;
  std::unique_ptr<ObjectDrawing> drawing_;
  std::size_t copies_drawn_ = 0;
};

}  // namespace deformable_manipulation
