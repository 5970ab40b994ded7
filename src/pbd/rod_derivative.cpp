#include "rod_derivative.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace pbd {
namespace {

constexpr double kLeastLeanOfJoint = 1e-4;  // as in rod_joint.h

Eigen::Matrix3d crossMatrixOf(const Vector3& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

Eigen::Matrix3d symmetricProductOf(const Vector3& a, const Vector3& b) {
  return 0.5 * (a * b.transpose() + b * a.transpose());
}

}  // namespace

RodDerivative::RodDerivative(const RodEquilibriumInput& input, const RodEquilibriumLanes& lanes, int lane)
    : in_(input), lanes_(lanes), lane_(lane), force_changes_(input.span_count, Vector3::Zero()) {
  for (int i = 0; i < in_.segments; ++i) {
    tangents_.emplace_back(orientation(i) * Vector3::UnitX());
  }
  turns_.assign(tangents_.size(), Vector3::Zero());
}

Vector3 RodDerivative::vector(const AlignedArray& array, int item) const { return read3(array, item, lane_); }

Eigen::Matrix3d RodDerivative::columns(const AlignedArray& array, int item) const {
  Eigen::Matrix3d m;
  for (int column = 0; column < 3; ++column) {
    m.col(column) = vector(array, 3 * item + column);
  }
  return m;
}

Eigen::Matrix3d RodDerivative::inversePivot(int i) const {
  const Vector3 first = vector(lanes_.inverse_pivot, 2 * i);       // xx, yx, yy
  const Vector3 second = vector(lanes_.inverse_pivot, 2 * i + 1);  // zx, zy, zz
  Eigen::Matrix3d m;
  m << first[0], first[1], second[0], first[1], first[2], second[1], second[0], second[1], second[2];
  return m;
}

Quaternion RodDerivative::orientation(int i) const {
  const double* at = &lanes_.orientation[4 * kLanes * i + lane_];
  return {at[3 * kLanes], at[0], at[kLanes], at[2 * kLanes]};
}

double RodDerivative::closure(int row, int column) const {
  return lanes_.closure[(row * (6 * in_.span_count + 1) + column) * kLanes + lane_];
}

//! [rad] The kernel's count of it is from before the last turn.
double RodDerivative::twist(int joint) const {
  constexpr double kTurn = 2.0 * M_PI;
  const Quaternion between = orientation(joint).conjugate() * orientation(joint + 1);
  const double now = 2.0 * std::atan2(between.x(), between.w());
  return now + kTurn * std::round((lanes_.twist[joint * kLanes + lane_] - now) / kTurn);
}

//! That of bending; a and b are what it brings together, such as the tangents.
RodDerivative::Moment RodDerivative::bending(const Vector3& a, const Vector3& b, double flexural) {
  return {flexural * a.cross(b), flexural * (a.dot(b) * Eigen::Matrix3d::Identity() - symmetricProductOf(a, b))};
}

RodDerivative::Moment RodDerivative::bending(int joint) const {
  const Vector3& d0 = tangents_[joint];
  const Vector3& d1 = tangents_[joint + 1];
  const double flexural = in_.flexural[joint];
  if (in_.natural_ahead == nullptr) {
    return bending(d0, d1, flexural);
  }
  const Vector3 ahead = orientation(joint) * Vector3(Eigen::Map<const Vector3>(in_.natural_ahead + 3 * joint));
  const Vector3 behind = orientation(joint + 1) * Vector3(Eigen::Map<const Vector3>(in_.natural_behind + 3 * joint));
  const Moment first = bending(ahead, d1, flexural);
  const Moment second = bending(d0, behind, flexural);
  return {0.5 * (first.value + second.value), 0.5 * (first.slope + second.slope)};
}

RodDerivative::Moment RodDerivative::moment(int joint) const {
  const Vector3& d0 = tangents_[joint];
  const Vector3& d1 = tangents_[joint + 1];
  const double torsional = in_.torsional[joint];
  const double lean = 1.0 / std::max(1.0 + d0.dot(d1), kLeastLeanOfJoint);
  const double natural_twist = in_.natural_ahead == nullptr ? 0.0 : in_.natural_twist[joint];
  const double torque = torsional * (twist(joint) - natural_twist);
  const Vector3 normal = d0.cross(d1);
  const Vector3 axis = lean * (d0 + d1);
  const Moment bent = bending(joint);
  const Vector3 value = bent.value + torque * axis;
  Eigen::Matrix3d slope = bent.slope;
  slope += torsional * axis * axis.transpose() + torque * lean * symmetricProductOf(axis, normal);
  return {value, slope - 0.5 * crossMatrixOf(value)};
}

//! In the fixed frame: in the one that turns with the first segment, and by that turn.
Vector3 RodDerivative::momentChange(int joint) const {
  const Moment m = moment(joint);
  return m.slope * (turns_[joint + 1] - turns_[joint]) + turns_[joint].cross(m.value);
}

//! [N] On the joint's first segment.
Vector3 RodDerivative::force(int joint) const {
  const Vector3 weight(in_.weight[0], in_.weight[1], in_.weight[2]);
  if (joint < 0 || joint + 1 >= in_.segments) {
    return Vector3::Zero();
  }
  const double before = in_.weights_before[joint + 1];
  const int span = in_.span_of_joint[joint];
  if (span >= 0) {
    return vector(lanes_.force, span) - (before - in_.weights_before[in_.spans[span].first + 1]) * weight;
  }
  return (joint < in_.held[0] ? -before : in_.weights_before[in_.segments] - before) * weight;
}

Vector3 RodDerivative::forceChange(int joint) const {
  const bool spanned = joint >= 0 && joint + 1 < in_.segments && in_.span_of_joint[joint] >= 0;
  return spanned ? force_changes_[in_.span_of_joint[joint]] : Vector3::Zero();
}

//! [N] What turns a segment at the arm of half its length.
Vector3 RodDerivative::pull(int i) const {
  const Vector3 weight(in_.weight[0], in_.weight[1], in_.weight[2]);
  return force(i) + force(i - 1) + in_.lean_weight[i] * weight;
}

Wrench RodDerivative::wrench(int hold) const {
  const int i = in_.held[hold];
  const Vector3 weight(in_.weight[0], in_.weight[1], in_.weight[2]);
  Wrench result;
  result.force = (in_.weights_before[i + 1] - in_.weights_before[i]) * weight + force(i) - force(i - 1);
  result.torque = in_.half_length[i] * tangents_[i].cross(pull(i));
  if (i + 1 < in_.segments) {
    result.torque += moment(i).value;
  }
  if (i > 0) {
    result.torque -= moment(i - 1).value;
  }
  return result;
}

int RodDerivative::jointsIn(int span, int segment) const {
  const bool before = segment > 0 && in_.span_of_joint[segment - 1] == span;
  const bool after = segment + 1 < in_.segments && in_.span_of_joint[segment] == span;
  return static_cast<int>(before) + static_cast<int>(after);
}

//! Whether the segments i and i + 1 both turn.
bool RodDerivative::isCoupled(int i) const {
  return i >= 0 && i + 1 < in_.segments && !in_.clamped[i] && !in_.clamped[i + 1];
}

//! How the axial extension of a joint changes with the tangent of its first segment.
Vector3 RodDerivative::gapChange(int joint, const Vector3& tangent_change) const {
  const Vector3& d = tangents_[joint];
  const Vector3 pull = force(joint);
  return in_.extension[joint] * (tangent_change.dot(pull) * d + d.dot(pull) * tangent_change);
}

Vector3 RodDerivative::opening(int joint, const Vector3& tangent_change) const {
  const Vector3& d = tangents_[joint];
  return gapChange(joint, tangent_change) + in_.extension[joint] * d.dot(forceChange(joint)) * d;
}

void RodDerivative::displace(int hold, const Vector3& by) {
  std::fill(turns_.begin(), turns_.end(), Vector3::Zero());
  displaced_ = hold;
  displacement_ = by;
  std::vector<Vector3> missing(force_changes_.size(), Vector3::Zero());
  for (int span = 0; span < in_.span_count; ++span) {
    if (in_.spans[span].last == in_.held[hold]) {
      missing[span] = by;
    } else if (in_.spans[span].first == in_.held[hold]) {
      missing[span] = -by;
    }
  }
  close(missing);
}

void RodDerivative::turn(int hold, const Vector3& by) {
  std::fill(turns_.begin(), turns_.end(), Vector3::Zero());
  displaced_ = -1;
  if (in_.clamped[in_.held[hold]]) {
    turnChain(in_.held[hold], by);
  }
  std::vector<Vector3> missing(force_changes_.size(), Vector3::Zero());
  for (int span = 0; span < in_.span_count; ++span) {
    for (int i = in_.spans[span].first; i <= in_.spans[span].last; ++i) {
      const Vector3 change = turns_[i].cross(tangents_[i]);
      missing[span] -= in_.half_length[i] * jointsIn(span, i) * change;
      if (i < in_.spans[span].last) {
        missing[span] -= gapChange(i, change);
      }
    }
  }
  close(missing);
}

//! Rotations of all segments when a clamped one turns, without a change of the spans' forces.
void RodDerivative::turnChain(int segment, const Vector3& by) {
  const int n = in_.segments;
  if (segment > 0 && !in_.clamped[segment - 1]) {
    turns_[segment - 1] = -(columns(lanes_.coupling, segment - 1) * by);
  }
  if (segment + 1 < n && !in_.clamped[segment + 1]) {
    turns_[segment + 1] = -(columns(lanes_.coupling, segment).transpose() * by);
  }
  for (int i = 1; i < n; ++i) {
    if (isCoupled(i - 1)) {
      turns_[i] -= columns(lanes_.coupling, i - 1).transpose() * (inversePivot(i - 1) * turns_[i - 1]);
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    if (in_.clamped[i]) {
      continue;
    }
    if (isCoupled(i)) {
      turns_[i] -= columns(lanes_.coupling, i) * turns_[i + 1];
    }
    turns_[i] = inversePivot(i) * turns_[i];
  }
  turns_[segment] = by;
}

//! Changes of the spans' forces that let each span end where it is held, and the rotations by these.
void RodDerivative::close(std::vector<Vector3>& missing) {
  const int rows = 3 * in_.span_count;
  for (int r = 0; r < rows; ++r) {
    double sum = 0.0;
    for (int k = 0; k < rows; ++k) {
      sum += closure(r, rows + 1 + k) * missing[k / 3][k % 3];
    }
    force_changes_[r / 3][r % 3] = sum;
  }
  for (int i = 0; i < in_.segments; ++i) {
    for (int span = 0; span < in_.span_count; ++span) {
      turns_[i] += columns(lanes_.force_response, i * in_.span_count + span) * force_changes_[span];
    }
  }
}

Wrench RodDerivative::wrenchChange(int hold) const {
  const int i = in_.held[hold];
  const Vector3& d = tangents_[i];
  const double half = in_.half_length[i];
  Wrench change;
  change.force = forceChange(i) - forceChange(i - 1);
  change.torque = half * turns_[i].cross(d).cross(pull(i));
  change.torque += half * d.cross(forceChange(i) + forceChange(i - 1));
  if (i + 1 < in_.segments) {
    change.torque += momentChange(i);
  }
  if (i > 0) {
    change.torque -= momentChange(i - 1);
  }
  return change;
}

//! Walks along the chain from the first hold to both ends.
void RodDerivative::pointChanges(std::vector<Vector3>& to) const {
  const int n = in_.segments;
  const int start = in_.held[0];
  const auto tangentChange = [this](int i) { return Vector3(turns_[i].cross(tangents_[i])); };
  const Vector3 centre = displaced_ == 0 ? displacement_ : Vector3::Zero();
  to.resize(static_cast<std::size_t>(n) + 1);
  Vector3 end = centre + in_.half_length[start] * tangentChange(start);
  for (int i = start; i + 1 < n; ++i) {
    const Vector3 gap = opening(i, tangentChange(i));
    to[i + 1] = end + 0.5 * gap;
    end += gap + 2.0 * in_.half_length[i + 1] * tangentChange(i + 1);
  }
  to[n] = end;
  end = centre - in_.half_length[start] * tangentChange(start);
  for (int i = start; i > 0; --i) {
    const Vector3 gap = opening(i - 1, tangentChange(i - 1));
    to[i] = end - 0.5 * gap;
    end -= gap + 2.0 * in_.half_length[i - 1] * tangentChange(i - 1);
  }
  to[0] = end;
}

}  // namespace pbd
}  // namespace deformable_manipulation
