#include "mesh_cleaning.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "coordinate_limit.h"
#include "mesh_components.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kFlat = 1e-12;  // height of a triangle over its longest side: below it is a line

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

void check(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles,
           std::vector<std::string>* problems) {
  if (triangles.empty()) {
    problems->push_back("the mesh has no triangles");
  }
  const auto out_of_range = std::find_if(vertices.begin(), vertices.end(), [](const Vector3& v) {
    return !(v.cwiseAbs().maxCoeff() <= kLargestCoordinate) || !v.allFinite();
  });
  if (out_of_range != vertices.end()) {
    problems->push_back("vertex " + std::to_string(out_of_range - vertices.begin()) +
                        " is not finite, or beyond 1e6 m");
  }
  const int count = static_cast<int>(vertices.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto outside =
        std::find_if(triangles[t].begin(), triangles[t].end(), [&](int v) { return v < 0 || v >= count; });
    if (outside != triangles[t].end()) {
      problems->push_back("triangle " + std::to_string(t) + " refers to vertex " + std::to_string(*outside) +
                          "; there are " + std::to_string(count) + " vertices");
      return;
    }
  }
}

std::size_t hashOf(const Vector3& v) {
  std::uint64_t hash = 0;
  for (int k = 0; k < 3; ++k) {
    std::uint64_t bits;
    std::memcpy(&bits, &v[k], sizeof bits);
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29U;
  }
  return hash;
}

//! Makes one of equal vertices.
std::vector<Vector3> weld(const std::vector<Vector3>& vertices, std::vector<Triangle>* triangles) {
  std::size_t size = 16;
  while (size < 2 * vertices.size()) {
    size *= 2;
  }
  std::vector<int> table(size, -1), renumbered(vertices.size());
  std::vector<Vector3> distinct;
  distinct.reserve(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vector3 vertex = vertices[i] + Vector3::Zero();  // -0 becomes 0
    std::size_t at = hashOf(vertex) & (size - 1);
    while (table[at] >= 0 && distinct[table[at]] != vertex) {
      at = (at + 1) & (size - 1);
    }
    if (table[at] < 0) {
      table[at] = static_cast<int>(distinct.size());
      distinct.push_back(vertex);
    }
    renumbered[i] = table[at];
  }
  for (Triangle& triangle : *triangles) {
    for (int& vertex : triangle) {
      vertex = renumbered[vertex];
    }
  }
  return distinct;
}

bool isFlat(const Triangle& t, const std::vector<Vector3>& vertices) {
  const Vector3 a = vertices[t[1]] - vertices[t[0]], b = vertices[t[2]] - vertices[t[1]],
                c = vertices[t[0]] - vertices[t[2]];
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
  return !(a.cross(b).norm() > kFlat * longest) || t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

void dropFlat(const std::vector<Vector3>& vertices, std::vector<Triangle>* triangles,
              std::vector<std::string>* warnings) {
  const auto end = std::remove_if(triangles->begin(), triangles->end(),
                                  [&](const Triangle& triangle) { return isFlat(triangle, vertices); });
  if (end != triangles->end()) {
    warnings->push_back(
        counted(triangles->end() - end, "triangle without area is dropped", "triangles without area are dropped"));
    triangles->erase(end, triangles->end());
  }
}

//! Of triangles with the same corners the first stays.
void dropRepeated(std::size_t vertices, std::vector<Triangle>* triangles, std::vector<std::string>* warnings) {
  std::vector<int> next(triangles->size()), last(vertices, -1);  // kept triangles by their smallest vertex
  std::size_t kept = 0;
  const auto sorted = [](Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  for (const Triangle triangle : *triangles) {
    const Triangle corners = sorted(triangle);
    int same = last[corners[0]];
    while (same >= 0 && sorted((*triangles)[same]) != corners) {
      same = next[same];
    }
    if (same < 0) {
      next[kept] = last[corners[0]];
      last[corners[0]] = static_cast<int>(kept);
      (*triangles)[kept++] = triangle;
    }
  }
  if (kept < triangles->size()) {
    warnings->push_back(
        counted(triangles->size() - kept, "repeated triangle is dropped", "repeated triangles are dropped"));
    triangles->resize(kept);
  }
}

//! Components that make one obstacle: a closed one with its cavities, or all that are not closed.
struct Solid {
  std::vector<int> components;
  Box box;
};

class Partition {
 public:
  Partition(const std::vector<Vector3>& vertices, std::vector<Triangle>* triangles)
      : vertices_(vertices), triangles_(*triangles), components_(windComponents(vertices, triangles)) {}

  std::vector<MeshPart> parts(std::vector<std::string>* warnings) {
    findSolids();
    warn(warnings);
    std::vector<MeshPart> made;
    for (const std::vector<int>& group : groups()) {
      made.push_back(partOf(group));
    }
    return made;
  }

 private:
  void findSolids() {
    solid_of_.assign(components_.size(), -1);
    for (std::size_t c = 0; c < components_.size(); ++c) {
      if (!components_[c].closed) {
        open_.push_back(static_cast<int>(c));
      } else if (!components_[c].inside_out || enclosing(components_[c]) < 0) {
        solid_of_[c] = static_cast<int>(solids_.size());
        solids_.push_back({{static_cast<int>(c)}, components_[c].box});
      }
    }
    for (std::size_t c = 0; c < components_.size(); ++c) {
      if (components_[c].closed && solid_of_[c] < 0) {
        turnIntoCavity(static_cast<int>(c));
      }
    }
  }

  void turnIntoCavity(int c) {
    for (int t : components_[c].triangles) {
      std::swap(triangles_[t][1], triangles_[t][2]);
    }
    components_[c].turned = 0;
    solids_[solid_of_[enclosing(components_[c])]].components.push_back(c);
  }

  //! The smallest closed component, not inside out, around another one; -1: none.
  int enclosing(const MeshComponent& inner) const {
    const Vector3& point = vertices_[triangles_[inner.triangles[0]][0]];
    int found = -1;
    for (std::size_t c = 0; c < components_.size(); ++c) {
      const MeshComponent& outer = components_[c];
      const bool smaller = found < 0 || outer.volume < components_[found].volume;
      if (outer.closed && !outer.inside_out && outer.volume > inner.volume && smaller &&
          outer.box.overlaps(inner.box) && encloses(outer, vertices_, triangles_, point)) {
        found = static_cast<int>(c);
      }
    }
    return found;
  }

  void warn(std::vector<std::string>* warnings) const {
    std::size_t turned = 0;
    for (const MeshComponent& component : components_) {
      turned += component.turned;
    }
    if (turned > 0) {
      warnings->push_back(counted(turned, "triangle was wound the wrong way and is turned",
                                  "triangles were wound the wrong way and are turned"));
    }
    if (!open_.empty()) {
      warnings->push_back(std::to_string(open_.size()) + " of " + std::to_string(components_.size()) +
                          " components are not closed surfaces: distances to them have no sign, and are 0 where the "
                          "object crosses them");
    }
  }

  //! Solids whose boxes are apart share a part.
  std::vector<std::vector<int>> groups() const {
    std::vector<std::vector<int>> groups;
    std::vector<std::vector<Box>> boxes;
    for (const Solid& solid : solids_) {
      std::size_t g = 0;
      const auto overlaps = [&](const Box& box) { return box.overlaps(solid.box); };
      while (g < groups.size() && std::any_of(boxes[g].begin(), boxes[g].end(), overlaps)) {
        ++g;
      }
      if (g == groups.size()) {
        groups.emplace_back();
        boxes.emplace_back();
      }
      groups[g].insert(groups[g].end(), solid.components.begin(), solid.components.end());
      boxes[g].push_back(solid.box);
    }
    if (!open_.empty()) {
      groups.push_back(open_);
    }
    return groups;
  }

  MeshPart partOf(const std::vector<int>& group) {
    MeshPart part;
    part.closed = components_[group[0]].closed;
    renumbered_.assign(vertices_.size(), -1);
    for (int c : group) {
      for (int t : components_[c].triangles) {
        Triangle triangle = triangles_[t];
        for (int& vertex : triangle) {
          if (renumbered_[vertex] < 0) {
            renumbered_[vertex] = static_cast<int>(part.vertices.size());
            part.vertices.push_back(vertices_[vertex]);
          }
          vertex = renumbered_[vertex];
        }
        part.triangles.push_back(triangle);
      }
    }
    return part;
  }

  const std::vector<Vector3>& vertices_;
  std::vector<Triangle>& triangles_;
  std::vector<MeshComponent> components_;
  std::vector<int> open_;
  std::vector<Solid> solids_;
  std::vector<int> solid_of_;
  std::vector<int> renumbered_;
};

}  // namespace

std::vector<MeshPart> cleanMesh(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles,
                                std::vector<std::string>* problems, std::vector<std::string>* warnings) {
  const std::size_t before = problems->size();
  check(vertices, triangles, problems);
  if (problems->size() > before) {
    return {};
  }
  std::vector<Triangle> kept = triangles;
  const std::vector<Vector3> distinct = weld(vertices, &kept);
  dropFlat(distinct, &kept, warnings);
  dropRepeated(distinct.size(), &kept, warnings);
  if (kept.empty()) {
    problems->push_back("the mesh has no triangle with an area");
    return {};
  }
  return Partition(distinct, &kept).parts(warnings);
}

}  // namespace distance
}  // namespace deformable_manipulation
