// Putting a rod into a shape.

#include <cmath>
#include <stdexcept>
#include <string>

#include "deformable_manipulation/pbd/rod.h"
#include "natural_shape.h"
#include "rod_layout.h"
#include "rod_state.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// Of a segment's length: points nearer than that have no direction.
constexpr double kLeastChord = 1e-3;

}  // namespace

void Rod::layOut() {
  const std::vector<Pose> segments = layOutRod(parameters_, *pieces_, *natural_, holds());
  for (std::size_t copy = 0; copy < state_->groups.size() * kLanes; ++copy) {
    placeCopy(static_cast<int>(copy), segments);
  }
  state_->groups.fill(&RodLanes::multiplier, 0.0);
  state_->groups.fill(&RodLanes::twist, 0.0);
  stop();
}

Pose Rod::undeformedPose(int particle) const {
  requireParticle(particle);
  return layOutRod(parameters_, *pieces_, *natural_, {})[particle];
}

void Rod::placeCopy(int copy, const std::vector<Pose>& segments) {
  RodLanes& lanes = state_->groups.of(copy);
  const int lane = copy % kLanes;
  for (int i = 0; i < parameters_.segments; ++i) {
    const double offset = state_->offset[i];
    const Vector3& centre = segments[i].position;
    const Vector3 position = offset == 0.0 ? centre : centre + offset * tangent(segments[i].orientation);
    write3(lanes.position, i, lane, position);
    write3(lanes.previous_position, i, lane, position);
    write4(lanes.orientation, i, lane, segments[i].orientation);
    write4(lanes.previous_orientation, i, lane, segments[i].orientation);
  }
}

//! Orientations of all segments along directions, from one whose orientation is as near as that allows, with no twist
//! but the natural one.
std::vector<Quaternion> Rod::framesFrom(int start, const Quaternion& frame,
                                        const std::vector<Vector3>& directions) const {
  std::vector<Quaternion> frames(directions.size());
  const auto carry = [&](const Quaternion& from, int to) {
    frames[to] = (Quaternion::FromTwoVectors(tangent(from), directions[to]) * from).normalized();
  };
  const auto twisted = [&](const Quaternion& from, int joint, double sign) {
    const auto twist = [&] { return Eigen::AngleAxisd(sign * natural_->twist[joint], Vector3::UnitX()); };
    return natural_->empty() ? from : Quaternion(from * twist());
  };
  carry(frame, start);
  for (int i = start + 1; i < parameters_.segments; ++i) {
    carry(twisted(frames[i - 1], i - 1, 1.0), i);
  }
  for (int i = start - 1; i >= 0; --i) {
    carry(twisted(frames[i + 1], i, -1.0), i);
  }
  return frames;
}

//! The first clamped hold; null: there is none.
const HeldPoint* Rod::firstClamped() const {
  for (const HeldPoint& held : holds()) {
    if (held.type == Hold::CLAMPED) {
      return &held;
    }
  }
  return nullptr;
}

void Rod::setShape(const double* points) {
  std::vector<Pose> segments(parameters_.segments);
  std::vector<Vector3> directions(parameters_.segments);
  for (int i = 0; i < parameters_.segments; ++i) {
    const Eigen::Map<const Vector3> from(points + 3 * i);
    const Eigen::Map<const Vector3> to(points + 3 * (i + 1));
    directions[i] = to - from;
    segments[i].position = 0.5 * (from + to);
  }
  const HeldPoint* clamped = natural_->empty() ? nullptr : firstClamped();
  const std::vector<Quaternion> frames = clamped != nullptr
                                             ? framesFrom(clamped->particle, clamped->pose.orientation, directions)
                                             : framesFrom(0, pose(0).orientation, directions);
  for (int i = 0; i < parameters_.segments; ++i) {
    segments[i].orientation = frames[i];
  }
  placeCopy(0, segments);
  state_->groups.fill(&RodLanes::multiplier, 0.0);
  state_->groups.fill(&RodLanes::twist, 0.0);
  stop();
}

//! The frame of the first clamped hold runs along the rod, so that the rod is not twisted there.
void Rod::placeState(const double* points, const double* velocities) {
  const int n = parameters_.segments;
  const auto row = [](const double* from, int i) { return Eigen::Map<const Vector3>(from + 3 * i); };
  std::vector<Vector3> directions(n);
  for (int i = 0; i < n; ++i) {
    directions[i] = row(points, i + 1) - row(points, i);
    if (directions[i].norm() < kLeastChord * pieces_->lengths[i]) {
      throw std::invalid_argument("points " + std::to_string(i) + " and " + std::to_string(i + 1) + " coincide");
    }
  }
  setShape(points);
  const HeldPoint* clamped = firstClamped();
  const int start = clamped != nullptr ? clamped->particle : 0;
  const Quaternion frame = clamped != nullptr ? clamped->pose.orientation : pose(0).orientation;
  const std::vector<Quaternion> frames = framesFrom(start, frame, directions);
  std::vector<Pose> segments(n);
  for (int i = 0; i < n; ++i) {
    segments[i] = {centre(i, 0), frames[i]};
  }
  placeCopy(0, segments);
  closeGaps();
  for (int i = 0; i < n; ++i) {
    const Vector3 spreading = row(velocities, i + 1) - row(velocities, i);
    const Vector3 turning = directions[i].cross(spreading) / directions[i].squaredNorm();
    const Vector3 arm = state_->offset[i] * directions[i].normalized();
    write3(state_->groups[0].velocity, i, 0,
           Vector3(0.5 * (row(velocities, i) + row(velocities, i + 1)) + turning.cross(arm)));
    write3(state_->groups[0].angular_velocity, i, 0, turning);
  }
}

//! Brings the segments end to end by substeps so short that nothing else happens.
void Rod::closeGaps() {
  constexpr double kAtOnce = 1e-7;  // s
  constexpr int kMost = 2000;       // the direct solver needs a few, sweeps many
  for (int i = 0; i < kMost && std::abs(stretch()) > 1e-9; ++i) {
    step(kAtOnce, 1);
    stop();
  }
  state_->groups.fill(&RodLanes::multiplier, 0.0);
}

void Rod::stop() {
  state_->groups.fill(&RodLanes::velocity, 0.0);
  state_->groups.fill(&RodLanes::angular_velocity, 0.0);
}

void Rod::displace(int particle, const Vector3& by) { state_->groups.displace(&RodLanes::position, particle, by); }

}  // namespace pbd
}  // namespace deformable_manipulation
