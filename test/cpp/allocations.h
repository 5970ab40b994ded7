#pragma once

namespace deformable_manipulation {
namespace test {

//! Calls of operator new in this program so far.
long allocations();

}  // namespace test
}  // namespace deformable_manipulation
