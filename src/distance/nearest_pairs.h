#pragma once

#include <cmath>
#include <vector>

#include "element_distance.h"
#include "moving_bounds.h"
#include "object_tree.h"

namespace deformable_manipulation {
namespace distance {

//! Nearest pairs of an object's elements and pieces (triangles, points) of an obstacle: only those elements are
//! searched that can be near enough, as far as is known of them from calls before.
//!
//! @tparam Search has these functions, and no influence of what is known on what is found:
//!   `double search<K>(element, known, nearest)` replaces `nearest` by what is nearer than it; returns a lower bound
//!   [m^2] of the element's squared distance;
//!   `void improve(pair)` compares the element and the piece of a pair;
//!   `Vector3 towards(pair)`, the unit vector from the obstacle to the element, or zero if they touch;
//!   `double heightAlong(normal, range, box, squared_reach)`, how far [m] pieces reach along a unit vector.
template <typename Search>
class NearestPairs {
 protected:
  static constexpr double kSlack = 1e-9;  // m, of bounds that earlier results give: far more than rounding

  struct Nearest {
    int element = -1, piece = -1;
    ElementNearest at{INFINITY};
    Vector3 direction = Vector3::Zero();  // about from the piece to the element, at most 1 long; for speed only
  };

  void startPairs(ObjectTree& object, MovingBounds* bounds) {
    object_ = &object;
    bounds_ = bounds;
    last_pieces_.resize(object.size(), -1);
  }

  //! The nearest pair of all, if it is not farther apart than the bound [m]. Of pairs as near to rounding it is always
  //! the same one, whatever was known before.
  Nearest nearestPair(double bound) {
    Nearest nearest;
    nearest.at.squared = (bound + kSlack) * (bound + kSlack);
    if (bounds_->least() >= bound + kSlack) {
      return nearest;
    }
    for (int element = 0; element < object_->size() && nearest.at.squared > 0.0; ++element) {
      if (bounds_->of(element) < bound + kSlack &&
          !bounds_->renew(element, object_->corners<3>(element), bound + kSlack)) {
        Nearest known;
        known.direction = bounds_->normal(element);
        const Nearest found = nearestOf(element, bound + kSlack + bounds_->reserve(), known);
        if (found.at.squared < nearest.at.squared) {
          nearest = found;
          bound = std::sqrt(found.at.squared);
        } else if (found.element >= 0 && found.at.squared > (bound + kSlack) * (bound + kSlack)) {
          bounds_->set(element, separate(found, bound));  // no plane spares those as near as the nearest
        }
      }
    }
    if (nearest.element < 0) {
      bounds_->findLeast();
    }
    return nearest;
  }

  //! An element and the piece that nearestWithin() found for it last, as they are now; infinitely far apart if none.
  Nearest lastPair(int element) {
    Nearest last;
    last.element = element;
    last.piece = last_pieces_[element];
    if (last.piece >= 0) {
      self().improve(&last);
    }
    return last;
  }

  //! The nearest pair of one element, if it is not farther apart than the bound [m].
  Nearest nearestWithin(int element, double bound) { return nearestWithin(element, bound, lastPair(element)); }

  //! @param last of lastPair()
  Nearest nearestWithin(int element, double bound, Nearest last) {
    if (last.piece >= 0) {
      last.direction = self().towards(last);
    }
    const double reach = std::min(bound + bounds_->reserve(), std::sqrt(last.at.squared));
    const Nearest found = nearestOf(element, reach + kSlack, last);
    last_pieces_[element] = found.piece >= 0 ? found.piece : last.piece;
    return found;
  }

  ObjectTree* object_ = nullptr;
  MovingBounds* bounds_ = nullptr;

 private:
  Search& self() { return static_cast<Search&>(*this); }

  //! The nearest pair of one element, if it is not farther apart than the reach [m].
  //! @param known a pair of it, which need not be compared again, or none
  Nearest nearestOf(int element, double reach, const Nearest& known) {
    Nearest nearest;
    nearest.at.squared = reach * reach;
    const double lowest = object_->surface() ? self().template search<3>(element, known, &nearest)
                                             : self().template search<2>(element, known, &nearest);
    bounds_->set(element, std::sqrt(lowest));
    return nearest;
  }

  //! A plane through the nearest point of the obstacle, square to the way to the element, or as far behind it as
  //! needed, but not so far that it does not tell that the element is farther than the bound [m].
  MovingBounds::Plane separate(const Nearest& nearest, double bound) {
    const Corners<3> corners = object_->corners<3>(nearest.element);
    const double distance = std::sqrt(nearest.at.squared);
    MovingBounds::Plane plane;
    plane.normal = self().towards(nearest);
    HeightRange range;
    range.lowest = plane.normal.dot(weighted<3>(corners, nearest.at.weights)) - distance;
    range.enough = range.lowest + kSlack;
    plane.height = self().heightAlong(plane.normal, range, boxAround(corners), INFINITY);
    plane.beyond = INFINITY;
    if (plane.height > range.lowest + kSlack) {
      plane.beyond = distance + bounds_->reserve();
      range.enough = range.lowest + distance - bound;
      plane.height = self().heightAlong(plane.normal, range, boxAround(corners), plane.beyond * plane.beyond);
    }
    plane.height += kSlack;
    return plane;
  }

  std::vector<int> last_pieces_;  // that was the nearest to each element; a guess only
};

}  // namespace distance
}  // namespace deformable_manipulation
