// Compiled once per instruction set; see lane_math.h.

#include "fabric_kernel.h"

#include <utility>

#include "lane_math.h"

namespace deformable_manipulation {
namespace pbd {
namespace DEFORMABLE_MANIPULATION_ISA {
namespace {

// m^2, added to squared lengths: below rounding, and an edge without length has no direction but is finite.
constexpr double kTiny = 1e-30;

//! One pack of copies of a fabric.
class FabricPack {
 public:
  FabricPack(const FabricInput& input, FabricLanes& lanes, int first_lane)
      : in_(input),
        position_(lanes.position.data() + first_lane),
        previous_(lanes.previous_position.data() + first_lane),
        velocity_(lanes.velocity.data() + first_lane),
        rest_length_(lanes.rest_length.data() + first_lane),
        finite_(lanes.finite.data() + first_lane),
        recorded_(input.recorded + first_lane),
        first_lane_(first_lane) {}

  void advance(int substeps) {
    predictFirst();
    for (int i = 0; i < substeps; ++i) {
      place(in_.held + static_cast<std::ptrdiff_t>(i) * in_.held_stride);
      const bool last = i + 1 == substeps;
      if (last) {
        solve<true>();
        adapt();
        finish(i);
      } else {
        solve<false>();
        predictNext(i);
      }
    }
  }

 private:
  //! The part of the motion that is not damped, in a substep.
  DM_INLINE Vec3 carried(int vertex, Vec3& change) const { return broadcast3(in_.carried + 3 * vertex) + change; }

  Vec3 carriedChange(int substep) const { return broadcast(substep + 1.0) * broadcast3(in_.carried_change); }

  void predictFirst() {
    const Pack h = broadcast(in_.h);
    Vec3 fall = h * broadcast3(in_.gravity);
    for (std::ptrdiff_t i = 0; i < in_.vertices; ++i) {
      const std::ptrdiff_t at = 3 * kLanes * i;
      Vec3 x = load3(position_ + at, kLanes);
      store3(previous_ + at, kLanes, scaleAdd(h, fall + load3(velocity_ + at, kLanes), x));
    }
    std::swap(position_, previous_);
  }

  //! The end of a substep and the prediction of the next one.
  void predictNext(int substep) {
    const Pack h = broadcast(in_.h);
    Vec3 change = carriedChange(substep) + h * broadcast3(in_.gravity);
    for (std::ptrdiff_t i = 0; i < in_.vertices; ++i) {
      const std::ptrdiff_t at = 3 * kLanes * i;
      Vec3 x = load3(position_ + at, kLanes);
      Vec3 moved = x - load3(previous_ + at, kLanes);
      store3(previous_ + at, kLanes, scaleAdd(broadcast(in_.decay[i]), moved, scaleAdd(h, carried(i, change), x)));
    }
    std::swap(position_, previous_);
  }

  void finish(int substep) {
    Vec3 change = carriedChange(substep);
    const double rate = 1.0 / in_.h;
    Pack finite = {};
    for (std::ptrdiff_t i = 0; i < in_.vertices; ++i) {
      const std::ptrdiff_t at = 3 * kLanes * i;
      Vec3 x = load3(position_ + at, kLanes);
      Vec3 moved = x - load3(previous_ + at, kLanes);
      Vec3 velocity = scaleAdd(broadcast(rate * in_.decay[i]), moved, carried(i, change));
      store3(velocity_ + at, kLanes, velocity);
      const Pack sum = velocity.x + velocity.y + velocity.z + x.x + x.y + x.z;
      finite += sum - sum;  // not a number, unless all of the sum is finite
    }
    store(finite_, finite);
  }

  void place(const HeldVertex* held) {
    for (int i = 0; i < in_.held_count; ++i) {
      store3(position_ + 3 * kLanes * held[i].vertex, kLanes, load3(held[i].position + first_lane_, kLanes));
    }
  }

  //! The excess of an edge takes long and moves nothing: it is computed while the hinge before is solved, which gives
  //! the processor more to do at the same time.
  template <bool recording>
  void solve() {
    double* recorded = recorded_;
    const double* rest_length = rest_length_;
    const HingeConstraint* const hinges_end = in_.hinges + in_.hinge_count;
    Pack ahead = {};
    for (const HingeConstraint* hinge = in_.hinges; hinge != hinges_end; ++hinge) {
      const std::ptrdiff_t step = hinge + 1 != hinges_end ? 1 : 0;
      const Pack excess = hinge->waits ? excessOf(*hinge, rest_length) : ahead;
      ahead = excessOf(hinge[step], rest_length + step * kLanes);
      solveHinge<recording>(*hinge, excess, recorded);
      rest_length += kLanes;
      recorded += recording ? kRecordedOfHinge : 0;
    }
    const BoundaryConstraint* const boundaries_end = in_.boundaries + in_.boundary_count;
    for (const BoundaryConstraint* boundary = in_.boundaries; boundary != boundaries_end; ++boundary) {
      solveBoundary<recording>(*boundary, rest_length, recorded);
      rest_length += kLanes;
      recorded += recording ? kRecordedOfBoundary : 0;
    }
  }

  //! Moves the rest lengths towards those at which all edges have the lengths of the elastic equilibrium.
  void adapt() {
    double* rest_length = rest_length_;
    const double* recorded = recorded_;
    for (int i = 0; i < in_.hinge_count; ++i) {
      adapt(in_.hinges[i].stretch, in_.hinges[i].at, recorded, rest_length);
      rest_length += kLanes;
      recorded += kRecordedOfHinge;
    }
    for (int i = 0; i < in_.boundary_count; ++i) {
      adapt(in_.boundaries[i].stretch, in_.boundaries[i].at, recorded, rest_length);
      rest_length += kLanes;
      recorded += kRecordedOfBoundary;
    }
  }

  DM_INLINE void adapt(const StretchConstraint& c, const int* at, const double* recorded, double* rest_length) {
    Vec3 edge = load3(position_ + at[1], kLanes) - load3(position_ + at[0], kLanes);
    const Pack square = dotAdd(edge, edge, broadcast(kTiny));
    const Pack inverse_length = inverseSquareRoot(square);
    const Pack corrected = inverse_length * dot(load3(recorded, kLanes), edge);
    const Pack error = square * inverse_length - c.rest_length - c.yield * corrected;
    const Pack adapted = load(rest_length) - in_.adaptation * error;
    const Pack least = broadcast(c.rest_length - c.most_adapted);
    const Pack most = broadcast(c.rest_length + c.most_adapted);
    store(rest_length, adapted < least ? least : (adapted > most ? most : adapted));
  }

  //! By how much an edge is too long, as a part of its length.
  DM_INLINE static Pack excess(const Pack& rest_length, Vec3& edge) {
    return 1.0 - rest_length * inverseSquareRoot(dotAdd(edge, edge, broadcast(kTiny)));
  }

  DM_INLINE Pack excessOf(const HingeConstraint& c, const double* rest_length) const {
    Vec3 edge = load3(position_ + c.at[1], kLanes) - load3(position_ + c.at[0], kLanes);
    return excess(load(rest_length), edge);
  }

  //! The edge first, then the fold with the edge as corrected.
  template <bool recording>
  DM_INLINE void solveHinge(const HingeConstraint& c, const Pack& excess, double* recorded) {
    double* const at[4] = {position_ + c.at[0], position_ + c.at[1], position_ + c.at[2], position_ + c.at[3]};
    Vec3 x[4];
    for (int i = 0; i < 4; ++i) {
      x[i] = load3(at[i], kLanes);
    }
    Vec3 edge = x[1] - x[0];
    Vec3 fold = scaleAdd(broadcast(c.weight_of_opposite), x[3] - x[0], x[2] - x[0]);
    fold = scaleAdd(c.weight_of_end + c.weight_of_stretch * excess, edge, fold);
    if (recording) {
      store3(recorded, kLanes, excess * edge);
      store3(recorded + 3 * kLanes, kLanes, fold);
    }
    x[0] = scaleAdd(c.stretch.gain[0] * excess, edge, x[0]);
    x[1] = scaleAdd(c.stretch.gain[1] * excess, edge, x[1]);
    for (int i = 0; i < 4; ++i) {
      store3(at[i], kLanes, scaleAdd(broadcast(c.gain[i]), fold, x[i]));
    }
  }

  template <bool recording>
  DM_INLINE void solveBoundary(const BoundaryConstraint& c, const double* rest_length, double* recorded) {
    double* const at[2] = {position_ + c.at[0], position_ + c.at[1]};
    Vec3 start = load3(at[0], kLanes);
    Vec3 end = load3(at[1], kLanes);
    Vec3 edge = end - start;
    const Pack excess = this->excess(load(rest_length), edge);
    if (recording) {
      store3(recorded, kLanes, excess * edge);
    }
    store3(at[0], kLanes, scaleAdd(c.stretch.gain[0] * excess, edge, start));
    store3(at[1], kLanes, scaleAdd(c.stretch.gain[1] * excess, edge, end));
  }

  const FabricInput& in_;
  double* position_;  // predictions take the place of what is no longer needed: the arrays swap in each substep
  double* previous_;
  double* const velocity_;
  double* const rest_length_;
  double* const finite_;
  double* const recorded_;
  const int first_lane_;
};

void advance(const FabricInput& input, int copies, int substeps, FabricLanes& lanes) {
  for (int lane = 0; lane < copies; lane += kPackWidth) {
    FabricPack(input, lanes, lane).advance(substeps);
  }
  if (substeps % 2 != 0) {
    std::swap(lanes.position, lanes.previous_position);
  }
}

#define DM_TEXT(name) #name
#define DM_NAME_OF(name) DM_TEXT(name)

}  // namespace

FabricKernel fabricKernel() { return {DM_NAME_OF(DEFORMABLE_MANIPULATION_ISA), advance}; }

}  // namespace DEFORMABLE_MANIPULATION_ISA
}  // namespace pbd
}  // namespace deformable_manipulation
