#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <memory>

#include "deformable_manipulation/ObjectState.h"
#include "object_shape.h"

namespace deformable_manipulation {

//! How one kind of object looks.
class ObjectDrawing {
 public:
  virtual ~ObjectDrawing() = default;

  //! Adds the markers of the object itself.
  virtual void drawObject(const ObjectState& state, visualization_msgs::MarkerArray& to) const = 0;

  //! A perturbed copy: light enough to be sent many times.
  virtual visualization_msgs::Marker drawCopy(const ObjectState& state, std::size_t copy,
                                              const std_msgs::ColorRGBA& color) const = 0;
};

//! A line for a rod, a surface for a fabric.
std::unique_ptr<ObjectDrawing> makeDrawing(const ObjectShape& shape);

}  // namespace deformable_manipulation
