#include "deformable_manipulation/control/obstacle_forecast.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace deformable_manipulation {
namespace control {

Pose PosePath::at(double time) const {
  const double last = static_cast<double>(poses.size() - 1);
  const double place = std::clamp((time - begin) / step, 0.0, last);
  const auto before = static_cast<std::size_t>(std::min(std::floor(place), std::max(0.0, last - 1.0)));
  const Pose& from = poses[before];
  const Pose& to = poses[std::min(before + 1, poses.size() - 1)];
  const double share = place - static_cast<double>(before);
  return {from.position + share * (to.position - from.position), from.orientation.slerp(share, to.orientation)};
}

ObstacleForecast::ObstacleForecast(std::shared_ptr<distance::MinimumDistance> distance, const Pose& place,
                                   PosePath path)
    : distance_(std::move(distance)), place_(place) {
  setPath(std::move(path));
}

void ObstacleForecast::setPath(PosePath path) {
  path_ = std::move(path);
  if (path_.poses.empty() || !(path_.step > 0.0)) {
    throw std::invalid_argument("the path of an obstacle needs a pose and a step of more than 0 s");
  }
}

const std::vector<distance::Feature>& ObstacleForecast::compute(const distance::ObjectView& object,
                                                                const std::vector<double>& times, double now) {
  find(object, times, &features_);
  if (std::any_of(features_.begin(), features_.end(), [](const auto& feature) { return feature.distance < 0.0; })) {
    keepSides(object, times, now);
  }
  return features_;
}

//! Shapes that the obstacle moves into are to leave by the side from which it comes.
void ObstacleForecast::keepSides(const distance::ObjectView& object, const std::vector<double>& times, double now) {
  find(object, std::vector<double>(times.size(), now), &present_);
  const Pose here = path_.at(now);
  for (int copy = 0; copy < object.copies; ++copy) {
    if (features_[copy].distance < 0.0) {
      const Pose then = path_.at(times[copy]);
      distance::Feature& feature = features_[copy] = present_[copy];
      const Vector3 arm = here.orientation.conjugate() * (feature.obstacle_point - here.position);
      const Vector3 moved = then.position + then.orientation * arm - feature.obstacle_point;
      feature.distance -= feature.normal.dot(moved);
      feature.obstacle_point += moved;
    }
  }
}

//! The nearest features of the shapes from the obstacle where it is at their times.
void ObstacleForecast::find(const distance::ObjectView& object, const std::vector<double>& times,
                            std::vector<distance::Feature>* features) {
  const Eigen::Index count = object.point_count;
  points_.resize(3 * static_cast<std::size_t>(count) * object.copies);
  features->resize(object.copies);
  for (int copy = 0; copy < object.copies; ++copy) {
    const Pose then = path_.at(times[copy]);
    const Eigen::Matrix3d turn = (place_.orientation * then.orientation.conjugate()).toRotationMatrix();
    const Vector3 shift = place_.position - turn * then.position;
    const Eigen::Map<const Eigen::Matrix3Xd> from(object.points + 3 * count * copy, 3, count);
    Eigen::Map<Eigen::Matrix3Xd> to(points_.data() + 3 * count * copy, 3, count);
    to = (turn * from).colwise() + shift;
  }
  distance::ObjectView seen = object;
  seen.points = points_.data();
  const distance::Distances& found = distance_->compute(seen);
  for (int copy = 0; copy < object.copies; ++copy) {
    const Pose then = path_.at(times[copy]);
    const Eigen::Matrix3d back = (then.orientation * place_.orientation.conjugate()).toRotationMatrix();
    distance::Feature& feature = (*features)[copy] = found.features[found.offsets[copy]];
    for (Vector3* point : {&feature.object_point, &feature.obstacle_point}) {
      *point = then.position + back * (*point - place_.position);
    }
    feature.normal = back * feature.normal;
    feature.obstacle_velocity.setZero();
  }
}

}  // namespace control
}  // namespace deformable_manipulation
