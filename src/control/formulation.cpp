#include "deformable_manipulation/control/formulation.h"

namespace deformable_manipulation {
namespace control {

Formulation Formulation::read(const ParameterSection& controller) {
  if (controller.choice<bool>("formulation", {{"paper", true}, {"full", false}})) {
    return paper();
  }
  const ParameterSection collision = controller.section("collision");
  Formulation formulation = full();
  formulation.leader_velocity = controller.flag("feedforward");
  formulation.obstacle_velocity = collision.flag("obstacle_velocity");
  formulation.every_feature = collision.choice<bool>("gradient", {{"features", true}, {"minimum", false}});
  return formulation;
}

}  // namespace control
}  // namespace deformable_manipulation
