#pragma once

#include "deformable_manipulation/pbd/body.h"

namespace deformable_manipulation {
namespace pbd {

inline SettleOptions settling(int substeps = 10) { return {0.01, substeps, 1e-4, 60.0}; }

}  // namespace pbd
}  // namespace deformable_manipulation
