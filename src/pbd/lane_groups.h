#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "deformable_manipulation/pbd/body.h"
#include "lanes.h"
#include "thread_pool.h"

namespace deformable_manipulation {
namespace pbd {

//! All copies of a body, eight to a group, and where their held particles are in the substeps still to be done.
//!
//! @tparam Lanes state of a group; Lanes::kArrays are the arrays that make up a copy
//! @tparam Held a held particle during one substep, with a `position` per lane
template <typename Lanes, typename Held>
class LaneGroups {
 public:
  using Array = AlignedArray Lanes::*;

  explicit LaneGroups(Lanes first) { groups_.push_back(std::move(first)); }

  //! Makes room for the copies and holds of a body.
  void resize(const Body& body) {
    groups_.resize((body.copyCount() + kLanes - 1) / kLanes, groups_.front());
    held_.resize(kSubstepsAtOnce * groups_.size() * body.holds().size());
  }

  std::size_t size() const { return groups_.size(); }
  std::vector<Lanes>& all() { return groups_; }
  Lanes& operator[](std::size_t group) { return groups_[group]; }
  const Lanes& of(int copy) const { return groups_[copy / kLanes]; }
  Lanes& of(int copy) { return groups_[copy / kLanes]; }

  //! Three numbers of an item of a copy.
  Vector3 read(Array array, int item, int copy = 0) const { return read3(of(copy).*array, item, copy % kLanes); }

  //! Adds to three numbers of an item of copy 0.
  void displace(Array array, int item, const Vector3& by) {
    write3(of(0).*array, item, 0, read3(of(0).*array, item, 0) + by);
  }

  //! All numbers of a copy, in order.
  void unpack(Array array, int copy, double* to) const { pbd::unpack(of(copy).*array, copy % kLanes, to); }

  //! Overwrites the state of one copy with that of another.
  void assign(int to, int from) {
    for (Array array : Lanes::kArrays) {
      copyLane(of(to).*array, to % kLanes, of(from).*array, from % kLanes);
    }
  }

  void fill(Array array, double value) {
    for (Lanes& lanes : groups_) {
      std::fill((lanes.*array).begin(), (lanes.*array).end(), value);
    }
  }

  //! Notes where the held particles of all copies are at the end of a substep.
  //! @param describe (HeldPoint, Held*) fills in all but the positions
  //! @return whether it is time to advance
  template <typename Describe>
  bool note(const Body& body, Describe describe) {
    for (std::size_t group = 0; group < groups_.size(); ++group) {
      Held* to = held_.data() + place(pending_, group, body);
      for (const HeldPoint& held : body.holds()) {
        describe(held, to);
        writePositions(body, held, static_cast<int>(group) * kLanes, to++);
      }
    }
    return ++pending_ == kSubstepsAtOnce;
  }

  //! Substeps that are noted and still to be done.
  int pending() const { return pending_; }

  //! The held particles of a group at the end of a noted substep.
  const Held* held(int substep, std::size_t group, const Body& body) const {
    return held_.data() + place(substep, group, body);
  }

  //! Does the noted substeps: calls advance(worker, group, copies) for all groups, several at a time.
  template <typename Advance>
  void advance(const Body& body, ThreadPool& pool, Advance advance) {
    if (pending_ == 0) {
      return;
    }
    pool.run(static_cast<int>(groups_.size()), [&](int worker, int group) {
      advance(worker, group, std::min(body.copyCount() - group * kLanes, kLanes));
    });
    pending_ = 0;
  }

 private:
  static constexpr int kSubstepsAtOnce = 16;  // that the threads do before they wait for each other

  std::size_t place(int substep, std::size_t group, const Body& body) const {
    return (substep * groups_.size() + group) * body.holds().size();
  }

  //! Lanes without a copy are held where the object itself is.
  static void writePositions(const Body& body, const HeldPoint& held, int first_copy, Held* to) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const int copy = first_copy + lane;
      const Vector3 position = body.heldPosition(held, copy < body.copyCount() ? copy : 0);
      for (int axis = 0; axis < 3; ++axis) {
        to->position[axis * kLanes + lane] = position[axis];
      }
    }
  }

  std::vector<Lanes> groups_;
  std::vector<Held> held_;  // [substeps x groups x holds]
  int pending_ = 0;
};

}  // namespace pbd
}  // namespace deformable_manipulation
