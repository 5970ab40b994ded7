#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace deformable_manipulation {
namespace pbd {

//! One parameter that cannot be accepted.
struct Problem {
  std::string key;      //!< name of the parameter
  std::string value;    //!< what was given
  std::string allowed;  //!< what is allowed
};

//! Parameters that cannot be accepted: all of them at once.
class ParameterError : public std::invalid_argument {
 public:
  explicit ParameterError(std::vector<Problem> problems);

  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

//! The simulated state is no longer finite; the body must not be used any further.
class NonFiniteState : public std::runtime_error {
 public:
  NonFiniteState(long step, int copy, int particle);

  const long step;     //!< time steps since the body was made
  const int copy;      //!< copy, 0 is the object itself
  const int particle;  //!< first particle that is not finite
};

//! Collects problems and throws them together.
class ParameterCheck {
 public:
  //! Notes a problem unless the condition holds.
  void require(bool condition, const std::string& key, double value, const std::string& allowed);
  void require(bool condition, const std::string& key, const std::string& value, const std::string& allowed);

  //! Requires a finite number greater than zero.
  void positive(const std::string& key, double value, const std::string& unit);

  //! Requires a finite number that is not negative.
  void notNegative(const std::string& key, double value, const std::string& unit);

  //! @throw ParameterError if there is any problem.
  void throwIfAny() const;

 private:
  std::vector<Problem> problems_;
};

//! Parameters that pass their own check. @throw ParameterError
template <typename Parameters>
const Parameters& checked(const Parameters& parameters) {
  ParameterCheck check;
  parameters.check(check);
  check.throwIfAny();
  return parameters;
}

}  // namespace pbd
}  // namespace deformable_manipulation
