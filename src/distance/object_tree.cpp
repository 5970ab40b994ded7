#include "object_tree.h"

#include <algorithm>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kUnseen = -1.0;

}  // namespace

bool ObjectTree::setElements(const ObjectView& object) {
  if (same(object)) {
    return false;
  }
  surface_ = object.triangles != nullptr;
  elements_.clear();
  if (surface_) {
    elements_.assign(object.triangles, object.triangles + object.triangle_count);
  } else {
    for (int i = 0; i + 1 < object.point_count; ++i) {
      elements_.push_back({i, i + 1, i + 1});
    }
  }
  listElementsOfPoints(object.point_count);
  const std::vector<Vector3> places = layOut(object.point_count);
  boxes_.assign(elements_.size(), Box());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    for (int point : elements_[e]) {
      boxes_[e].include(places[point]);
    }
  }
  tree_ = buildBoxTree(boxes_);
  chooseRepresentatives(places);
  return true;
}

void ObjectTree::chooseRepresentatives(const std::vector<Vector3>& places) {
  representatives_.assign(tree_.size(), 0);
  for (std::size_t n = tree_.size(); n-- > 0;) {
    double least = INFINITY;
    for (int child : tree_[n].children) {
      const int point = child == BoxNode::kNone ? -1 : representative(child);
      const double away = point < 0 ? INFINITY : (places[point] - tree_[n].box.middle()).squaredNorm();
      if (away < least) {
        least = away;
        representatives_[n] = point;
      }
    }
  }
}

bool ObjectTree::same(const ObjectView& object) const {
  if (object.point_count + 1 != static_cast<int>(first_of_.size()) || surface_ != (object.triangles != nullptr)) {
    return false;
  }
  return !surface_ ||
         (object.triangle_count == size() && std::equal(elements_.begin(), elements_.end(), object.triangles));
}

void ObjectTree::listElementsOfPoints(int points) {
  first_of_.assign(points + 1, 0);
  const int corners = cornerCount();
  for (const Triangle& element : elements_) {
    for (int k = 0; k < corners; ++k) {
      ++first_of_[element[k]];
    }
  }
  for (int i = 1; i <= points; ++i) {
    first_of_[i] += first_of_[i - 1];
  }
  elements_of_.resize(first_of_[points]);
  for (int e = size() - 1; e >= 0; --e) {
    for (int k = corners - 1; k >= 0; --k) {
      elements_of_[--first_of_[elements_[e][k]]] = e;
    }
  }
}

//! Places for the points that show what is near what on the object: by edges away from three far points of each piece.
std::vector<Vector3> ObjectTree::layOut(int points) {
  std::vector<Vector3> places(points, Vector3::Constant(kUnseen));
  pieces_.clear();
  piece_of_.assign(points, -1);
  for (int start = 0; start < points; ++start) {
    if (places[start].x() != kUnseen || first_of_[start] == first_of_[start + 1]) {
      continue;
    }
    const int first = spread(start, 2, &places);  // only to find a far one
    const std::vector<int> piece = queue_;
    for (int point : piece) {
      places[point].z() = kUnseen;
      piece_of_[point] = static_cast<int>(pieces_.size());
    }
    const int second = spread(first, 0, &places);
    spread(second, 1, &places);
    const auto nearer = [&](int a, int b) {
      return std::min(places[a].x(), places[a].y()) < std::min(places[b].x(), places[b].y());
    };
    spread(*std::max_element(piece.begin(), piece.end(), nearer), 2, &places);
    for (int point : piece) {
      places[point].x() += 2.0 * points * pieces_.size();  // apart from the other pieces
    }
    pieces_.push_back(start);
  }
  return places;
}

//! Writes how many edges each point of a piece is away from its start; returns the farthest.
int ObjectTree::spread(int start, int axis, std::vector<Vector3>* places) {
  queue_.assign(1, start);
  (*places)[start][axis] = 0.0;
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    const int point = queue_[i];
    for (int k = first_of_[point]; k < first_of_[point + 1]; ++k) {
      for (int next : elements_[elements_of_[k]]) {
        if ((*places)[next][axis] == kUnseen) {
          (*places)[next][axis] = (*places)[point][axis] + 1.0;
          queue_.push_back(next);
        }
      }
    }
  }
  return queue_.back();
}

void ObjectTree::fit() {
  if (fitted_) {
    return;
  }
  fitted_ = true;
  const int corners = cornerCount();
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    boxes_[e] = Box();
    for (int k = 0; k < corners; ++k) {
      boxes_[e].include(point(elements_[e][k]));
    }
  }
  for (std::size_t n = tree_.size(); n-- > 0;) {  // children come after their parents
    BoxNode& node = tree_[n];
    node.box = Box();
    for (int slot = 0; slot < 4; ++slot) {
      const int child = node.children[slot];
      if (child != BoxNode::kNone) {
        node.set(slot, child, child < 0 ? boxes_[~child] : tree_[child].box);
      }
    }
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
