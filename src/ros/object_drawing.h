#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <memory>

#include "deformable_manipulation/ObjectState.h"

namespace deformable_manipulation {

//! How one kind of object looks.
class ObjectDrawing {
 public:
  virtual ~ObjectDrawing() = default;

  //! How many triangles it draws: large objects are drawn less often.
  virtual long triangleCount() const = 0;

  //! Adds the markers of the object itself.
  virtual void drawObject(const ObjectState& state, visualization_msgs::MarkerArray& to) const = 0;

  //! A perturbed copy: light enough to be sent many times.
  virtual visualization_msgs::Marker drawCopy(const ObjectState& state, std::size_t copy,
                                              const std_msgs::ColorRGBA& color) const = 0;
};

}  // namespace deformable_manipulation
