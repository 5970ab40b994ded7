#include "live_perturbation.h"

#include <stdexcept>
#include <string>

namespace deformable_manipulation {
namespace {

constexpr std::uint32_t kAll = ~0u;  // level of the first call

// As in the scenario's checks: less would be rounding in the differences between copies.
constexpr double kSmallest = 1e-5;  // m

}  // namespace

LivePerturbation::LivePerturbation(const SimulatorScenario& scenario, pbd::Simulation& simulation)
    : scenario_(scenario), simulation_(simulation), size_(scenario.perturbation) {
  server_.setCallback([this](SimulatorConfig& config, std::uint32_t level) { change(config, level); });
}

void LivePerturbation::change(SimulatorConfig& config, std::uint32_t level) {
  config.outcome = "As in the scenario.";
  if (level != kAll) {  // what an earlier life of the node has left behind does not count
    try {
      apply({config.perturbation_x, config.perturbation_y, config.perturbation_z});
      config.outcome = "Changed.";
    } catch (const std::logic_error& error) {
      config.outcome = std::string("Nothing changed: ") + error.what() + ".";
      ROS_WARN_STREAM(config.outcome);
    }
  }
  config.perturbation_x = size_.x();
  config.perturbation_y = size_.y();
  config.perturbation_z = size_.z();
}

void LivePerturbation::apply(const pbd::Vector3& size) {
  if (!size.allFinite() || (size.array().abs() < kSmallest).any()) {
    throw std::invalid_argument("every perturbation must be at least 0.00001 m, to one side or the other");
  }
  simulation_.setPerturbations(perturbationsOf(scenario_, size));
  size_ = size;
}

}  // namespace deformable_manipulation
