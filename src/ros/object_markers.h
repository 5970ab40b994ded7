#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deformable_manipulation/ObjectState.h"
#include "object_drawing.h"

namespace deformable_manipulation {

//! Draws a state for RViz: the object, its copies in one colour per displaced axis (x red, y green,
//! z blue), and the agents with their names and the bars of grips that hold several particles.
class ObjectMarkers {
 public:
  //! @param leader  its name
  ObjectMarkers(std::unique_ptr<ObjectDrawing> drawing, std::string leader)
      : leader_(std::move(leader)), drawing_(std::move(drawing)) {}

  long triangleCount() const { return drawing_->triangleCount(); }

  //! Copies, and bars of grips, that are gone since the last call are deleted.
  visualization_msgs::MarkerArray draw(const ObjectState& state);

 private:
  void drawBar(const ObjectState& state, int agent, visualization_msgs::MarkerArray& array);

  std::string leader_;
  std::unique_ptr<ObjectDrawing> drawing_;
  std::size_t copies_drawn_ = 0;
  std::vector<bool> bars_drawn_;  // [agents]
};

}  // namespace deformable_manipulation
