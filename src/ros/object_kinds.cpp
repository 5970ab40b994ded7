#include "object_kinds.h"

#include "deformable_manipulation/ObjectState.h"
#include "fabric_drawing.h"
#include "rod_drawing.h"

namespace deformable_manipulation {

const ObjectKind& objectKind(const std::string& kind) {
  static const std::map<std::string, ObjectKind> kinds = {
      {"fabric", {ObjectState::FABRIC, &FabricDrawing::of}},
      {"rod", {ObjectState::ROD, &RodDrawing::of}},
  };
  return kinds.at(kind);
}

std::unique_ptr<ObjectDrawing> makeDrawing(const ParameterValue& object) {
  pbd::ParameterCheck check;
  const ParameterSection section(object, "object", check);
  std::unique_ptr<ObjectDrawing> drawing = objectKind(section.text("type")).make_drawing(section);
  check.throwIfAny();
  return drawing;
}

}  // namespace deformable_manipulation
