#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/features.h"
#include "deformable_manipulation/distance/minimum_distance.h"

//! The computation with the names of its obstacles, as Python holds it:
//! deformable_manipulation._distance.MinimumDistance.
struct NamedMinimumDistance {
  deformable_manipulation::distance::MinimumDistance native;
  std::shared_ptr<const std::vector<std::string>> names;
};

//! The result of a distance computation, as Python holds it: deformable_manipulation._distance.Distances.
//!
//! The controller takes it as it is, so that what the C++ core has computed does not become arrays on its way.
struct NamedDistances {
  deformable_manipulation::distance::Distances distances;
  std::shared_ptr<const std::vector<std::string>> names;  //!< of the obstacles
};
