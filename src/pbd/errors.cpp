#include "deformable_manipulation/pbd/errors.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace deformable_manipulation {
namespace pbd {
namespace {

std::string describe(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) {
      text += "\n";
    }
    text += problem.key + ": " + problem.value + " - must be " + problem.allowed;
  }
  return text;
}

std::string toText(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

std::string describe(long step, int copy, int particle) {
  std::ostringstream stream;
  stream << "the simulated state is not finite: step " << step << ", copy " << copy << ", particle " << particle
         << "; use more substeps, a smaller time step or a softer material";
  return stream.str();
}

}  // namespace

ParameterError::ParameterError(std::vector<Problem> problems)
    : std::invalid_argument(describe(problems)), problems_(std::move(problems)) {}

NonFiniteState::NonFiniteState(long step, int copy, int particle)
    : std::runtime_error(describe(step, copy, particle)), step(step), copy(copy), particle(particle) {}

void ParameterCheck::require(bool condition, const std::string& key, double value, const std::string& allowed) {
  require(condition, key, toText(value), allowed);
}

void ParameterCheck::require(bool condition, const std::string& key, const std::string& value,
                             const std::string& allowed) {
  if (!condition) {
    problems_.push_back({key, value, allowed});
  }
}

void ParameterCheck::positive(const std::string& key, double value, const std::string& unit) {
  require(std::isfinite(value) && value > 0.0, key, value, "a finite number > 0 " + unit);
}

void ParameterCheck::notNegative(const std::string& key, double value, const std::string& unit) {
  require(std::isfinite(value) && value >= 0.0, key, value, "a finite number >= 0 " + unit);
}

void ParameterCheck::throwIfAny() const {
  if (!problems_.empty()) {
    throw ParameterError(problems_);
  }
}

}  // namespace pbd
}  // namespace deformable_manipulation
