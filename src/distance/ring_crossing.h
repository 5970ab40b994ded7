#pragma once

#include <string>
#include <vector>

#include "edge_tree.h"

namespace deformable_manipulation {
namespace distance {

//! Appends a problem if a ring crosses or touches itself.
void checkCrossings(const PlanarRing& ring, const EdgeTree& tree, std::vector<std::string>* problems);

}  // namespace distance
}  // namespace deformable_manipulation
