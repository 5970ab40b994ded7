#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "deformable_manipulation/distance/obstacle.h"

namespace deformable_manipulation {
namespace distance {

class PointTree;

//! Points that are ready to be searched. It never changes, so that one thread can make it while others search another.
//!
//! Points are kept relative to the middle of all, in single precision: off by at most 6e-8 of the cloud's size.
class PointCloud {
 public:
  //! @param xyz [count x 3] m in the obstacle's own frame; points not finite or beyond 1e6 m are left out
  PointCloud(const float* xyz, std::size_t count);
  PointCloud(const double* xyz, std::size_t count);
  ~PointCloud();

  std::size_t size() const;                          //!< points that are there
  std::size_t leftOut() const { return left_out_; }  //!< points that are not
  std::size_t bytes() const;                         //!< of memory

  const Vector3& middle() const { return middle_; }                       //!< [m] from which points are kept
  const std::shared_ptr<const PointTree>& tree() const { return tree_; }  //!< null if there are no points

 private:
  template <typename Number>
  void build(const Number* xyz, std::size_t count);

  std::size_t left_out_ = 0;
  Vector3 middle_ = Vector3::Zero();
  std::shared_ptr<const PointTree> tree_;
};

//! The points of several clouds as balls of one radius.
//!
//! Distances are exact to rounding. They are signed in each ball by itself: at its centre the distance is minus the
//! radius. Normals point from the nearest point to the object, inside a ball, too. Without points, distances are
//! infinite.
//!
//! Features: the nearest point to each segment or triangle, however many points are near.
class CloudObstacle : public Obstacle {
 public:
  //! @param clouds each with its own tree, so that one of them can be replaced while the others are kept; none: nothing
  //! @param radius [m] of the balls, may be 0
  //! @throw std::invalid_argument the radius is negative or not finite, or a cloud is null
  CloudObstacle(const std::vector<std::shared_ptr<const PointCloud>>& clouds, double radius);
  ~CloudObstacle() override;

  void minima(const ObjectView& object, Feature* nearest) override;
  void features(const ObjectView& object, double limit, std::vector<Feature>* found) override;

 private:
  class Search;
  void place(const Vector3& translation, const pbd::Quaternion& rotation, const pbd::Twist& velocity) override;

  std::vector<std::unique_ptr<Search>> searches_;  // of the clouds that have points
  std::vector<Feature> of_one_;                    // [copies] of one cloud
};

}  // namespace distance
}  // namespace deformable_manipulation
