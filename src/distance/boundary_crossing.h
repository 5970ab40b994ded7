#pragma once

#include <string>
#include <vector>

#include "edge_tree.h"

namespace deformable_manipulation {
namespace distance {

//! Appends a problem if a boundary crosses or touches itself.
void checkCrossings(const PlanarBoundary& boundary, const EdgeTree& tree, std::vector<std::string>* problems);

}  // namespace distance
}  // namespace deformable_manipulation
