#include "object_drawing.h"

#include "fabric_drawing.h"
#include "rod_drawing.h"

namespace deformable_manipulation {

std::unique_ptr<ObjectDrawing> makeDrawing(const ObjectShape& shape) {
  if (shape.triangles.empty()) {
    return std::make_unique<RodDrawing>(shape.thickness);
  }
  return std::make_unique<FabricDrawing>(shape.triangles);
}

}  // namespace deformable_manipulation
