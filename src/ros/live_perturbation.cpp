#include "live_perturbation.h"

#include <sstream>
#include <stdexcept>
#include <string>

namespace deformable_manipulation {
namespace {

constexpr std::uint32_t kAll = ~0u;  // level of the first call

// As in the scenario's checks: less would be rounding in the differences between copies.
constexpr double kSmallest = 1e-5;  // m

pbd::Vector3 sizeIn(const SimulatorConfig& config) {
  return {config.perturbation_x, config.perturbation_y, config.perturbation_z};
}

void setSize(SimulatorConfig& config, const pbd::Vector3& size) {
  config.perturbation_x = size.x();
  config.perturbation_y = size.y();
  config.perturbation_z = size.z();
}

}  // namespace

LivePerturbation::LivePerturbation(const SimulatorScenario& scenario, pbd::Simulation& simulation)
    : scenario_(scenario),
      simulation_(simulation),
      size_(scenario.perturbation),
      least_(sizeIn(SimulatorConfig::__getMin__()).cwiseMin(size_)),
      most_(sizeIn(SimulatorConfig::__getMax__()).cwiseMax(size_)) {
  showRanges();
  server_.setCallback([this](UnclampedSimulatorConfig& config, std::uint32_t level) { change(config, level); });
}

// The scenario's sizes are within the ranges, whatever they are.
void LivePerturbation::showRanges() {
  UnclampedSimulatorConfig least = SimulatorConfig::__getMin__(), most = SimulatorConfig::__getMax__();
  setSize(least, least_);
  setSize(most, most_);
  server_.setConfigMin(least);
  server_.setConfigMax(most);
}

void LivePerturbation::change(UnclampedSimulatorConfig& config, std::uint32_t level) {
  config.outcome = "As in the scenario.";
  if (level != kAll) {  // what an earlier life of the node has left behind does not count
    try {
      apply(sizeIn(config));
      config.outcome = "Changed.";
    } catch (const std::logic_error& error) {
      config.outcome = std::string("Nothing changed: ") + error.what() + ".";
      ROS_ERROR_STREAM(config.outcome);
    }
  }
  setSize(config, size_);
}

void LivePerturbation::apply(const pbd::Vector3& size) {
  checkRanges(size);
  if ((size.array().abs() < kSmallest).any()) {
    throw std::invalid_argument("every perturbation must be at least 0.00001 m, to one side or the other");
  }
  simulation_.setPerturbations(perturbationsOf(scenario_, size));
  size_ = size;
}

void LivePerturbation::checkRanges(const pbd::Vector3& size) const {
  std::ostringstream faults;
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] >= least_[axis] && size[axis] <= most_[axis]) continue;  // not so for NaN
    faults << (faults.tellp() > 0 ? ". " : "") << "perturbation_"
           << "xyz"[axis] << " must be a number from " << least_[axis] << " to " << most_[axis] << ", not "
           << size[axis] << "; it stays " << size_[axis];
  }
  if (faults.tellp() > 0) throw std::invalid_argument(faults.str());
}

}  // namespace deformable_manipulation
