#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "deformable_manipulation/control/observation.h"

//! Reads control.observation.Observation, checking types and shapes; keeps its memory from call to call.
class ObservationReader {
 public:
  //! Reads what the view then shows, until the next call.
  //! @param agents that there must be
  //! @return what makes the observation unusable, as a clause that names the field, or an empty string
  std::string read(const pybind11::handle& observation, int agents);

  const deformable_manipulation::control::ObservationView& view() const { return view_; }

 private:
  using Shape = std::vector<pybind11::ssize_t>;

  void readState(const pybind11::handle& observation, int agents);
  void readIntent(const pybind11::handle& intent);
  void readDistances(const pybind11::handle& distances);
  const double* numbers(const pybind11::handle& owner, const char* key, const char* name, const Shape& shape);
  const int* indices(const pybind11::handle& owner, const char* key, const char* name, const Shape& shape);

  deformable_manipulation::control::ObservationView view_;
  pybind11::object owner_;                   // of the distances that the view looks at
  std::vector<pybind11::object> arrays_;     // that it looks at
  std::vector<std::vector<int>> converted_;  // indices that it looks at
  std::size_t conversions_ = 0;
};
