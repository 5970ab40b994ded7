#pragma once

#include <vector>

#include "mesh_search.h"

namespace deformable_manipulation {
namespace distance {

//! Of the nearest places of an object's elements, leaves those from which the distance does not fall: no element that
//! has the place, too, comes nearer. A place that several have is left to the first of them.
//! @param places [elements]; those that are none become not known()
void keepLocalMinima(const ObjectTree& object, std::vector<MeshPlace>* places);

}  // namespace distance
}  // namespace deformable_manipulation
