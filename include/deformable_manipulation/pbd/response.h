#pragma once

namespace deformable_manipulation {
namespace pbd {

//! Whether the quasi-static response of an object to its holds' motion is known.
enum class ResponseStatus {
  VALID,
  NOT_AVAILABLE,  //!< this kind of object has none
  NOT_HELD,       //!< nothing holds the object
  OUT_OF_REACH,   //!< two holds are farther apart than the object reaches between them
  NOT_CONVERGED,  //!< no equilibrium was found near the present shape
  UNSTABLE,       //!< the object would not stay in the equilibrium found, or can swing freely
  OTHER_SHAPE     //!< the equilibrium found is far from the present shape: the object moves towards another
};

//! A clause that says the status in words.
const char* describe(ResponseStatus status);

}  // namespace pbd
}  // namespace deformable_manipulation
