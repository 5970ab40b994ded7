#pragma once

#include "object_drawing.h"

namespace deformable_manipulation {

//! A rod as a line of its diameter, its copies as thin lines.
class RodDrawing : public ObjectDrawing {
 public:
  //! @param diameter  [m]
  explicit RodDrawing(double diameter);

  void drawObject(const ObjectState& state, visualization_msgs::MarkerArray& to) const override;
  visualization_msgs::Marker drawCopy(const ObjectState& state, std::size_t copy,
                                      const std_msgs::ColorRGBA& color) const override;

 private:
  double width_;
};

}  // namespace deformable_manipulation
