// What a mesh must be to be a fabric.

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "fabric_mesh.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// A triangle whose area is less than this part of its longest side's square has none.
constexpr double kFlatTriangle = 1e-9;

// A broken mesh is usually broken in many places of the same kind.
constexpr int kProblemsOfAKind = 5;

//! Notes the first problems of a kind and how many more there are.
class Kind {
 public:
  Kind(ParameterCheck& check, const std::string& key, const std::string& allowed)
      : check_(check), key_(key), allowed_(allowed) {}

  void note(const std::string& what) {
    if (++count_ <= kProblemsOfAKind) {
      check_.require(false, key_, what, allowed_);
    }
  }

  ~Kind() {
    if (count_ > kProblemsOfAKind) {
      check_.require(false, key_, std::to_string(count_ - kProblemsOfAKind) + " more like the last", allowed_);
    }
  }

  bool any() const { return count_ > 0; }

 private:
  ParameterCheck& check_;
  const std::string key_;
  const std::string allowed_;
  int count_ = 0;
};

std::string toText(const Triangle& t) {
  return "(" + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) + ")";
}

std::string name(std::size_t triangle, const Triangle& t) {
  return "triangle " + std::to_string(triangle) + " " + toText(t);
}

bool requireIndices(int vertices, const std::vector<Triangle>& triangles, ParameterCheck& check) {
  Kind outside(check, "triangles", "of vertices 0 to " + std::to_string(vertices - 1));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (*std::min_element(triangles[t].begin(), triangles[t].end()) < 0 ||
        *std::max_element(triangles[t].begin(), triangles[t].end()) >= vertices) {
      outside.note(name(t, triangles[t]));
    }
  }
  return !outside.any();
}

bool requireFinite(const std::vector<Vector3>& vertices, ParameterCheck& check) {
  Kind infinite(check, "vertices", "three finite numbers [m] each");
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite()) {
      infinite.note("vertex " + std::to_string(i) + " is not finite");
    }
  }
  return !infinite.any();
}

void requireAreas(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles, ParameterCheck& check) {
  Kind flat(check, "triangles", "of three corners that are not in line; remove it or move a corner");
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      longest = std::max(longest, (vertices[triangles[t][k]] - vertices[triangles[t][(k + 1) % 3]]).squaredNorm());
    }
    if (!(triangleArea(vertices, triangles[t]) > kFlatTriangle * longest)) {
      flat.note(name(t, triangles[t]) + " has no area");
    }
  }
}

void requireDifferent(const std::vector<Triangle>& triangles, ParameterCheck& check) {
  Kind repeated(check, "triangles", "given once; remove the repetition");
  std::map<Triangle, std::size_t> first;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Triangle sorted = triangles[t];
    std::sort(sorted.begin(), sorted.end());
    const auto inserted = first.emplace(sorted, t);
    if (!inserted.second) {
      repeated.note(name(t, triangles[t]) + " is triangle " + std::to_string(inserted.first->second) + " again");
    }
  }
}

void requireManifoldEdges(const std::vector<Triangle>& triangles, ParameterCheck& check) {
  std::map<std::array<int, 2>, std::set<std::size_t>> of_edge;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[t][k];
      const int b = triangles[t][(k + 1) % 3];
      of_edge[{std::min(a, b), std::max(a, b)}].insert(t);
    }
  }
  Kind shared(check, "triangles",
              "a surface, with one or two triangles at an edge; remove the others or give them vertices of their own");
  for (const auto& [edge, owners] : of_edge) {
    if (owners.size() > 2) {
      std::string text = "the edge from vertex " + std::to_string(edge[0]) + " to " + std::to_string(edge[1]) +
                         " belongs to triangles";
      for (std::size_t t : owners) {
        text += " " + std::to_string(t);
      }
      shared.note(text);
    }
  }
}

//! Vertices joined by triangles have the same root.
class Pieces {
 public:
  explicit Pieces(std::size_t vertices) : parent_(vertices) { std::iota(parent_.begin(), parent_.end(), 0); }

  int root(int vertex) {
    while (parent_[vertex] != vertex) {
      vertex = parent_[vertex] = parent_[parent_[vertex]];
    }
    return vertex;
  }

  void join(int a, int b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

 private:
  std::vector<int> parent_;
};

void requireOnePiece(std::size_t vertices, const std::vector<Triangle>& triangles, ParameterCheck& check) {
  Pieces pieces(vertices);
  std::vector<bool> used(vertices, false);
  for (const Triangle& t : triangles) {
    pieces.join(t[0], t[1]);
    pieces.join(t[0], t[2]);
    used[t[0]] = used[t[1]] = used[t[2]] = true;
  }
  Kind unused(check, "vertices", "a corner of a triangle; remove it");
  Kind apart(check, "triangles",
             "one connected surface; merge vertices that lie at the same place, or keep one of the pieces");
  for (std::size_t i = 0; i < vertices; ++i) {
    if (!used[i]) {
      unused.note("vertex " + std::to_string(i) + " is in no triangle");
    } else if (pieces.root(static_cast<int>(i)) == static_cast<int>(i) && i != 0 &&
               std::find(used.begin(), used.begin() + i, true) != used.begin() + i) {
      apart.note("a piece that begins with vertex " + std::to_string(i) +
                 " is not connected to the vertices before it");
    }
  }
}

}  // namespace

void checkMesh(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles, ParameterCheck& check) {
  if (triangles.empty()) {
    check.require(false, "triangles", "none", "at least one triangle");
    return;
  }
  const bool finite = requireFinite(vertices, check);
  if (!requireIndices(static_cast<int>(vertices.size()), triangles, check)) {
    return;
  }
  if (finite) {
    requireAreas(vertices, triangles, check);
  }
  requireDifferent(triangles, check);
  requireManifoldEdges(triangles, check);
  requireOnePiece(vertices.size(), triangles, check);
}

}  // namespace pbd
}  // namespace deformable_manipulation
