#include "reference_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace deformable_manipulation {
namespace pbd {
namespace {

void write(double* to, int i, const Vector3& value) { std::copy(value.data(), value.data() + 3, to + 3 * i); }

}  // namespace

void carriedMotion(const std::vector<HeldPoint>& holds, const std::vector<double>& places, double* velocity,
                   double* angular_velocity) {
  std::size_t next = 0;  // first hold at or after the particle
  const int n = static_cast<int>(places.size());
  for (int i = 0; i < n; ++i) {
    while (next < holds.size() && holds[next].particle < i) {
      ++next;
    }
    const HeldPoint& a = holds[next > 0 ? next - 1 : 0];
    const HeldPoint& b = holds[next < holds.size() ? next : holds.size() - 1];
    const double gap = places[b.particle] - places[a.particle];
    const double t = gap > 0.0 ? (places[i] - places[a.particle]) / gap : 0.0;
    write(velocity, i, (1.0 - t) * a.twist.linear + t * b.twist.linear);
    write(angular_velocity, i, (1.0 - t) * a.twist.angular + t * b.twist.angular);
  }
}

void rigidMotion(const std::vector<SegmentMotion>& segments, double mass, double transverse_inertia, double* velocity,
                 double* angular_velocity) {
  Vector3 centre = Vector3::Zero();
  Vector3 drift = Vector3::Zero();
  double total = 0.0;
  for (const SegmentMotion& segment : segments) {
    total += segment.relative_mass;
  }
  for (const SegmentMotion& segment : segments) {
    centre += segment.position / (total / segment.relative_mass);
    drift += segment.velocity / (total / segment.relative_mass);
  }
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Vector3 angular_momentum = Vector3::Zero();
  for (const SegmentMotion& segment : segments) {
    const Vector3 arm = segment.position - centre;
    const double across = transverse_inertia + segment.added_inertia;
    const double own_mass = segment.relative_mass * mass;
    const Eigen::Matrix3d own = across * Eigen::Matrix3d::Identity() +
                                (segment.axial_inertia - across) * segment.tangent * segment.tangent.transpose();
    inertia += own + own_mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
    angular_momentum += own * segment.angular_velocity + own_mass * arm.cross(segment.velocity - drift);
  }
  const Vector3 spin = inertia.ldlt().solve(angular_momentum);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    write(velocity, static_cast<int>(i), drift + spin.cross(segments[i].position - centre));
    write(angular_velocity, static_cast<int>(i), spin);
  }
}

void rigidMotion(const std::vector<PointMotion>& points, double* velocity) {
  double mass = 0.0;
  Vector3 centre = Vector3::Zero();
  Vector3 drift = Vector3::Zero();
  for (const PointMotion& point : points) {
    mass += point.mass;
    centre += point.mass * point.position;
    drift += point.mass * point.velocity;
  }
  centre /= mass;
  drift /= mass;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Vector3 angular_momentum = Vector3::Zero();
  for (const PointMotion& point : points) {
    const Vector3 arm = point.position - centre;
    inertia += point.mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
    angular_momentum += point.mass * arm.cross(point.velocity - drift);
  }
  const Vector3 spin = inertia.ldlt().solve(angular_momentum);
  for (std::size_t i = 0; i < points.size(); ++i) {
    write(velocity, static_cast<int>(i), drift + spin.cross(points[i].position - centre));
  }
}

}  // namespace pbd
}  // namespace deformable_manipulation
