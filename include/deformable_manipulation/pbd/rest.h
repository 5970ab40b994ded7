#pragma once

namespace deformable_manipulation {
namespace pbd {

//! How an object rests where it was let settle.
enum class Rest {
  STABLE,   //!< it comes back when it is pushed a little
  MOVING,   //!< it still moved when settling was given up
  BALANCED  //!< it leaves each shape that it settles in when it is pushed a little
};

//! One word for it: stable, moving or balanced.
const char* name(Rest rest);

//! What is wrong with it and what helps, as sentences; empty where it is stable.
const char* describe(Rest rest);

}  // namespace pbd
}  // namespace deformable_manipulation
