#pragma once

#include <vector>

#include "box_tree.h"
#include "mesh_cleaning.h"
#include "triangle_geometry.h"

namespace deformable_manipulation {
namespace distance {

//! The object's segments or triangles with a tree of boxes over them, which is fitted to the copies that need it.
//! How it branches depends on what is connected with what alone.
class ObjectTree {
 public:
  //! Takes the object's elements, if they are not the ones it has.
  //! @return whether they are others
  bool setElements(const ObjectView& object);

  //! @param points [m] of one copy; used until the next call
  void setPoints(const std::vector<Vector3>& points) {
    points_ = &points;
    fitted_ = false;
  }

  //! Fits the tree's boxes to the points, if they are not.
  void fit();

  bool surface() const { return surface_; }
  int pointCount() const { return static_cast<int>(piece_of_.size()); }
  int size() const { return static_cast<int>(elements_.size()); }
  const BoxTree& tree() const { return tree_; }  //!< needs fit()
  const Vector3& point(int index) const { return (*points_)[index]; }

  //! Geometry points of an element; those of a segment: start, end, end.
  const Triangle& element(int index) const { return elements_[index]; }
  int cornerCount() const { return surface_ ? 3 : 2; }

  template <int K>
  Corners<K> corners(int element) const {
    Corners<K> corners;
    for (int k = 0; k < K; ++k) {
      corners[k] = point(elements_[element][k]);
    }
    return corners;
  }

  //! A point in the middle of a node, or of a leaf (~index).
  int representative(int child) const { return child < 0 ? elements_[~child][0] : representatives_[child]; }

  //! A point of each connected piece of the object, and which piece a point is of.
  const std::vector<int>& pieces() const { return pieces_; }
  int pieceOf(int point) const { return piece_of_[point]; }

  //! Elements of a point: of_points()[k] for k from firstOf(point) to firstOf(point + 1) - 1.
  int firstOf(int point) const { return first_of_[point]; }
  int elementOf(int k) const { return elements_of_[k]; }

 private:
  bool same(const ObjectView& object) const;
  void listElementsOfPoints(int points);
  std::vector<Vector3> layOut(int points);
  void chooseRepresentatives(const std::vector<Vector3>& places);
  int spread(int start, int axis, std::vector<Vector3>* places);

  bool surface_ = false;
  std::vector<Triangle> elements_;
  BoxTree tree_;
  std::vector<int> representatives_;  // of the nodes
  std::vector<Box> boxes_;
  std::vector<int> pieces_, piece_of_;
  std::vector<int> first_of_, elements_of_;
  std::vector<int> queue_;
  const std::vector<Vector3>* points_ = nullptr;
  bool fitted_ = false;
};

}  // namespace distance
}  // namespace deformable_manipulation
