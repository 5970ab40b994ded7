#pragma once

#include <array>
#include <vector>

#include "deformable_manipulation/parameters/parameter_section.h"
#include "object_drawing.h"

namespace deformable_manipulation {

//! A fabric as a shaded surface with the lines of its mesh, its copies as outlines.
class FabricDrawing : public ObjectDrawing {
 public:
  //! Of the fabric that a section describes.
  static std::unique_ptr<ObjectDrawing> of(const ParameterSection& object);

  explicit FabricDrawing(std::vector<std::array<int, 3>> triangles);

  long triangleCount() const override { return static_cast<long>(triangles_.size()); }
  void drawObject(const ObjectState& state, visualization_msgs::MarkerArray& to) const override;
  visualization_msgs::Marker drawCopy(const ObjectState& state, std::size_t copy,
                                      const std_msgs::ColorRGBA& color) const override;

 private:
  using Edge = std::array<int, 2>;

  visualization_msgs::Marker surface(const ObjectState& state) const;
  std::vector<std_msgs::ColorRGBA> litColors(const double* points, std::size_t count) const;

  std::vector<std::array<int, 3>> triangles_;
  std::vector<Edge> edges_;    // each once
  std::vector<Edge> outline_;  // edges of one triangle only; of a closed surface all
};

}  // namespace deformable_manipulation
