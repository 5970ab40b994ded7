#include "mesh_components.h"

#include <cmath>
#include <utility>

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kFlatVolume =
    1e-12;  // volume over the cube of the extent: below it is a sheet folded back onto itself

class Winding {
 public:
  Winding(const std::vector<Vector3>& vertices, std::vector<Triangle>* triangles)
      : vertices_(vertices),
        triangles_(*triangles),
        neighbours_(edgeNeighbours(*triangles, vertices.size())),
        state_(triangles->size(), kUnseen) {}

  std::vector<MeshComponent> run() {
    std::vector<MeshComponent> components;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (state_[t] == kUnseen) {
        components.push_back(componentOf(static_cast<int>(t)));
      }
    }
    return components;
  }

 private:
  enum State : char { kUnseen, kAsIs, kTurned };

  MeshComponent componentOf(int seed) {
    MeshComponent component;
    component.triangles.push_back(seed);
    state_[seed] = kAsIs;
    for (std::size_t i = 0; i < component.triangles.size(); ++i) {
      visit(component.triangles[i], &component);
    }
    wind(&component);
    return component;
  }

  void visit(int t, MeshComponent* component) {
    for (int k = 0; k < 3; ++k) {
      component->box.include(vertices_[triangles_[t][k]]);
      const int next = neighbours_[t][k];
      if (next < 0) {
        component->closed = false;
        continue;
      }
      const bool alike = !runsAlong(triangles_[next], triangles_[t][k], triangles_[t][(k + 1) % 3]);
      const State wanted = alike == (state_[t] == kAsIs) ? kAsIs : kTurned;
      if (state_[next] == kUnseen) {
        state_[next] = wanted;
        component->triangles.push_back(next);
      } else if (state_[next] != wanted) {
        component->closed = false;
      }
    }
  }

  static bool runsAlong(const Triangle& t, int from, int to) {
    return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
  }

  void wind(MeshComponent* component) {
    int turned = 0;
    const Vector3 origin = component->box.middle();
    for (int t : component->triangles) {
      Triangle& triangle = triangles_[t];
      if (state_[t] == kTurned) {
        std::swap(triangle[1], triangle[2]);
        ++turned;
      }
      const Vector3 a = vertices_[triangle[0]] - origin;
      component->volume += a.dot((vertices_[triangle[1]] - origin).cross(vertices_[triangle[2]] - origin)) / 6.0;
    }
    const int count = static_cast<int>(component->triangles.size());
    const double extent = component->box.extent();
    component->closed = component->closed && std::fabs(component->volume) > kFlatVolume * extent * extent * extent;
    if (component->closed && component->volume < 0.0) {
      for (int t : component->triangles) {
        std::swap(triangles_[t][1], triangles_[t][2]);
      }
      component->volume = -component->volume;
      turned = count - turned;
      component->inside_out = turned == count;
    }
    component->turned = component->closed ? turned : 0;
  }

  const std::vector<Vector3>& vertices_;
  std::vector<Triangle>& triangles_;
  std::vector<Triangle> neighbours_;
  std::vector<State> state_;
};

}  // namespace

std::vector<MeshComponent> windComponents(const std::vector<Vector3>& vertices, std::vector<Triangle>* triangles) {
  return Winding(vertices, triangles).run();
}

bool encloses(const MeshComponent& component, const std::vector<Vector3>& vertices,
              const std::vector<Triangle>& triangles, const Vector3& point) {
  double half_angle = 0.0;  // van Oosterom and Strackee, The solid angle of a plane triangle, 1983
  for (int t : component.triangles) {
    const Vector3 a = vertices[triangles[t][0]] - point, b = vertices[triangles[t][1]] - point,
                  c = vertices[triangles[t][2]] - point;
    const double na = a.norm(), nb = b.norm(), nc = c.norm();
    half_angle += std::atan2(a.dot(b.cross(c)), na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
  }
  return half_angle > M_PI;
}

}  // namespace distance
}  // namespace deformable_manipulation
