#pragma once

#include "deformable_manipulation/parameters/parameter_section.h"
#include "object_drawing.h"

namespace deformable_manipulation {

//! A rod as a line of its diameter, its copies as thin lines.
class RodDrawing : public ObjectDrawing {
 public:
  //! Of the rod that a section describes.
  static std::unique_ptr<ObjectDrawing> of(const ParameterSection& object);

  //! @param diameter  [m]
  explicit RodDrawing(double diameter);

  long triangleCount() const override { return 0; }
  void drawObject(const ObjectState& state, visualization_msgs::MarkerArray& to) const override;
  visualization_msgs::Marker drawCopy(const ObjectState& state, std::size_t copy,
                                      const std_msgs::ColorRGBA& color) const override;

 private:
  double width_;
};

}  // namespace deformable_manipulation
