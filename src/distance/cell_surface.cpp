#include "cell_surface.h"

#include <cstdint>
#include <numeric>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr int kSides = 6;  // of a cube: -x, +x, -y, +y, -z, +z

Cell stepTo(int side) {
  Cell step = {0, 0, 0};
  step[side / 2] = side % 2 == 0 ? -1 : 1;
  return step;
}

Cell operator+(const Cell& a, const Cell& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

//! Cells by their indices, in a table with open addresses.
class CellTable {
 public:
  explicit CellTable(std::size_t most) {
    std::size_t size = 16;
    while (size < 2 * most) {
      size *= 2;
    }
    keys_.assign(size, kEmpty);
    numbers_.resize(size);
  }

  //! The number of a cell, which is the given one if it has not been there.
  int insert(const Cell& cell, int number) {
    const std::size_t slot = slotOf(cell);
    if (keys_[slot] == kEmpty) {
      keys_[slot] = keyOf(cell);
      numbers_[slot] = number;
    }
    return numbers_[slot];
  }

  //! -1: it is not there.
  int find(const Cell& cell) const {
    const std::size_t slot = slotOf(cell);
    return keys_[slot] == kEmpty ? -1 : numbers_[slot];
  }

 private:
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};

  static std::uint64_t keyOf(const Cell& cell) {
    std::uint64_t key = 0;
    for (int index : cell) {
      key = (key << 21) | static_cast<std::uint64_t>(index + (1 << 20));
    }
    return key;
  }

  std::size_t slotOf(const Cell& cell) const {
    const std::uint64_t key = keyOf(cell);
    std::uint64_t mixed = (key ^ (key >> 31)) * 0x9E3779B97F4A7C15U;
    std::size_t slot = (mixed ^ (mixed >> 29)) & (keys_.size() - 1);
    while (keys_[slot] != kEmpty && keys_[slot] != key) {
      slot = (slot + 1) & (keys_.size() - 1);
    }
    return slot;
  }

  std::vector<std::uint64_t> keys_;
  std::vector<int> numbers_;
};

class CellSurface {
 public:
  explicit CellSurface(const std::vector<Cell>& cells) : table_(cells.size()) {
    for (const Cell& cell : cells) {
      if (table_.insert(cell, static_cast<int>(cells_.size())) == static_cast<int>(cells_.size())) {
        cells_.push_back(cell);
      }
    }
    findFaces();
    joinFaces();
  }

  MeshPart mesh(double size, bool endless) {
    MeshPart part;
    part.closed = true;
    part.endless = endless;
    std::vector<int> vertex_of(group_.size(), -1);
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      std::array<int, 4> corner;
      for (int k = 0; k < 4; ++k) {
        int& vertex = vertex_of[find(static_cast<int>(4 * face + k))];
        if (vertex < 0) {
          vertex = static_cast<int>(part.vertices.size());
          const Cell place = cornerOf(faces_[face], k);
          part.vertices.push_back(size * Vector3(place[0], place[1], place[2]));
        }
        corner[k] = vertex;
      }
      if (endless) {
        std::swap(corner[1], corner[3]);
      }
      part.triangles.push_back({corner[0], corner[1], corner[2]});
      part.triangles.push_back({corner[0], corner[2], corner[3]});
    }
    return part;
  }

 private:
  struct Face {
    int cell, side;
  };

  void findFaces() {
    face_of_.assign(kSides * cells_.size(), -1);
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      for (int side = 0; side < kSides; ++side) {
        if (table_.find(cells_[cell] + stepTo(side)) < 0) {
          face_of_[kSides * cell + side] = static_cast<int>(faces_.size());
          faces_.push_back({static_cast<int>(cell), side});
        }
      }
    }
  }

  //! Which corner k = 0 to 3 of a face is, counter-clockwise as seen from outside.
  Cell cornerOf(const Face& face, int k) const {
    const int axis = face.side / 2, first = (axis + 1) % 3, second = (axis + 2) % 3;
    const bool far = face.side % 2 == 1;
    const int around = far ? k : 3 - k;
    Cell corner = cells_[face.cell];
    corner[axis] += far ? 1 : 0;
    corner[first] += around == 1 || around == 2 ? 1 : 0;
    corner[second] += around >= 2 ? 1 : 0;
    return corner;
  }

  //! The side of the cube that a face meets at the edge from its corner k to the next one.
  int sideAcross(const Face& face, int k) const {
    const Cell a = cornerOf(face, k), b = cornerOf(face, (k + 1) % 4);
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != face.side / 2 && a[axis] == b[axis]) {
        return 2 * axis + (a[axis] > cells_[face.cell][axis] ? 1 : 0);
      }
    }
    return -1;
  }

  //! The face on the other side of an edge: of the cube across, of the next cube, or of the same one.
  int faceAcross(const Face& face, int k) const {
    const int across = sideAcross(face, k);
    const Cell next = cells_[face.cell] + stepTo(across);
    const int rising = table_.find(next + stepTo(face.side));
    if (rising >= 0) {
      return face_of_[kSides * rising + (across ^ 1)];
    }
    const int level = table_.find(next);
    return level >= 0 ? face_of_[kSides * level + face.side] : face_of_[kSides * face.cell + across];
  }

  void joinFaces() {
    group_.resize(4 * faces_.size());
    std::iota(group_.begin(), group_.end(), 0);
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      for (int k = 0; k < 4; ++k) {
        const int other = faceAcross(faces_[face], k);
        for (int end : {k, (k + 1) % 4}) {
          join(static_cast<int>(4 * face + end), 4 * other + cornerAt(faces_[other], cornerOf(faces_[face], end)));
        }
      }
    }
  }

  int cornerAt(const Face& face, const Cell& place) const {
    int k = 0;
    while (k < 3 && cornerOf(face, k) != place) {
      ++k;
    }
    return k;
  }

  int find(int corner) {
    while (group_[corner] != corner) {
      corner = group_[corner] = group_[group_[corner]];
    }
    return corner;
  }

  void join(int a, int b) { group_[find(a)] = find(b); }

  CellTable table_;
  std::vector<Cell> cells_;
  std::vector<int> face_of_;  // [cells x sides] -1: there is none
  std::vector<Face> faces_;
  std::vector<int> group_;  // of the faces' corners: one of those that are the same vertex
};

}  // namespace

MeshPart surfaceOfCells(const std::vector<Cell>& cells, double size, bool endless) {
  return CellSurface(cells).mesh(size, endless);
}

}  // namespace distance
}  // namespace deformable_manipulation
