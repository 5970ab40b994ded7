#pragma once

namespace deformable_manipulation {
namespace pbd {

//! How an object rests after settling.
enum class Rest {
  STABLE,   //!< it comes back when it is pushed a little
  MOVING,   //!< it still moved when settling was stopped
  BALANCED  //!< it leaves each shape that it settles in when it is pushed a little
};

//! One word for it: stable, moving or balanced.
const char* name(Rest rest);

//! Sentences about what is wrong with it and what helps; empty if it is stable.
const char* describe(Rest rest);

}  // namespace pbd
}  // namespace deformable_manipulation
