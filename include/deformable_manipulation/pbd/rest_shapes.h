#pragma once

#include <vector>

#include "deformable_manipulation/pbd/types.h"

namespace deformable_manipulation {
namespace pbd {

//! Shapes in which an object would rest if its agents held it elsewhere than they do, for looking ahead.
class RestShapes {
 public:
  virtual ~RestShapes() = default;

  //! Geometry points P of a shape.
  virtual int pointCount() const = 0;

  //! The shape from which searches start where no shape nearby is known.
  //! @param points [P x 3] m, of the object itself as it is now
  //! @param correction [P x 3] m, of these points beside the model, which all shapes get; null: none
  void setPresent(const double* points, const double* correction = nullptr);

  //! Where grips turn: the orientations [agents] of all of them in the shapes to be found.
  virtual void setOrientations(const std::vector<Quaternion>& /*orientations*/) {}

  //! Forgets the shapes found: the next searches start from the present shape.
  virtual void forget() = 0;

  //! Looks for shapes; each search starts from the shape of the same number that was found last.
  //! @param held [shapes x agents] m, where the agents hold it
  virtual void find(const std::vector<Vector3>& held) = 0;

  //! Whether a shape was found.
  virtual bool known(int shape) const = 0;

  //! Points [P x 3] m of a shape that is known.
  void points(int shape, double* to) const;

  //! Derivative [agents x P x 3 x 3] of a known shape's points with respect to each held point.
  virtual void response(int shape, double* to) const = 0;

 protected:
  //! setPresent() of the model.
  virtual void placePresent(const double* points) = 0;

  //! points() of the model.
  virtual void readPoints(int shape, double* to) const = 0;

 private:
  std::vector<double> correction_;     // [P x 3] m, or empty
  std::vector<double> model_present_;  // [P x 3] m
};

}  // namespace pbd
}  // namespace deformable_manipulation
