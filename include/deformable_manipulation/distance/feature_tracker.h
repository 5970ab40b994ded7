#pragma once

#include <cstdint>
#include <vector>

#include "deformable_manipulation/distance/obstacle.h"

namespace deformable_manipulation {
namespace distance {

//! Numbers features so that the same one has the same number from call to call (Feature::identity).
//!
//! - Selection::ELEMENTS: the number tells obstacle and element, for every copy and whatever was before.
//! - Selection::LOCAL: a locally nearest pair keeps its number while it slides over the object. A feature of copy 0 is
//!   the one of the call before, with the same obstacle, whose material point is nearest to it now; pairs of them are
//!   made from the nearest on, and are not farther apart than two of their elements are long. Others get new numbers;
//!   no number comes twice. Features of other copies have none (-1).
class FeatureTracker {
 public:
  //! Numbers the features of a call.
  void follow(const ObjectView& object, Selection selection, Distances* distances);

 private:
  struct Candidate {
    double squared;  // m^2
    int now, before;
  };

  void number(const ObjectView& object, Feature* begin, Feature* end);

  std::vector<Feature> last_;  // of copy 0
  std::vector<Candidate> candidates_;
  std::vector<char> taken_;
  std::int64_t next_ = 0;
};

}  // namespace distance
}  // namespace deformable_manipulation
