#include "fabric_constraints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <list>

namespace deformable_manipulation {
namespace pbd {
namespace {

// What springs solved later undo of an earlier one in a net in equilibrium, as a part of its response: half, as the
// forces on each vertex balance. In the state of rest an edge would be longer by that, so it is taken off its
// compliance.
constexpr double kUndone = 0.5;

// Where a substep takes away more than this part of a fold, folds undo the edges too, and rest lengths do not adapt.
constexpr double kStiffFold = 0.5;

// m^2, area of two triangles in a mesh that needs no more compliance than a coarser one, however limp.
constexpr double kCoarse = 0.02;

// 1/s^2, about the square of the highest frequency of folds: below, fine meshes need more compliance.
constexpr double kLimp = 2000.0;

// Adapted rest lengths stay within this part of the true ones.
constexpr double kMostAdapted = 0.1;

// Places between two constraints that touch a common vertex, and how far ahead such are searched for.
constexpr int kApart = 3;
constexpr int kLookAhead = 96;

int place(int vertex) { return 3 * kLanes * vertex; }

//! Whether a hinge moves an end of another one's edge.
bool touches(const HingeConstraint& hinge, const HingeConstraint& other) {
  return std::find_first_of(hinge.at, hinge.at + 4, other.at, other.at + 2) != hinge.at + 4;
}

//! Multiplier per violation, 1 / (response + compliance); 0 if nothing can move and nothing yields.
double stiffness(double response, double compliance) {
  const double sum = response + compliance;
  return sum > 0.0 ? 1.0 / sum : 0.0;
}

//! Least compliance of an edge as a part of its response, for a damping per substep; found by trial. One sweep is not
//! symmetric, and feeds energy into the folds of a net of stiff edges. Compliance stops that; the shorter the substeps,
//! the less damping there is in each to help.
double leastCompliance(double damping) {
  constexpr double kLeast = 0.6, kMost = 3.0;
  return std::min(kMost, kLeast * std::max(1.0, std::pow(0.01 / damping, 0.75)));
}

}  // namespace

int vertexAt(int place) { return place / (3 * kLanes); }

std::array<double, 4> weightsOf(const HingeConstraint& hinge) {
  const double end = hinge.weight_of_end;
  const double opposite = hinge.weight_of_opposite;
  return {-(end + 1.0 + opposite), end, 1.0, opposite};
}

std::vector<int> independentOrder(const std::vector<std::vector<int>>& vertices_of_items, int vertices) {
  std::list<int> waiting;
  for (std::size_t i = 0; i < vertices_of_items.size(); ++i) {
    waiting.push_back(static_cast<int>(i));
  }
  std::vector<int> last_used(vertices, -kApart);
  std::vector<int> order;
  while (!waiting.empty()) {
    const int now = static_cast<int>(order.size());
    auto best = waiting.begin();
    int longest_ago = -1;
    int seen = 0;
    for (auto item = waiting.begin(); item != waiting.end() && seen < kLookAhead && longest_ago < kApart;
         ++item, ++seen) {
      int ago = kApart;
      for (int vertex : vertices_of_items[*item]) {
        ago = std::min(ago, now - last_used[vertex]);
      }
      if (ago > longest_ago) {
        longest_ago = ago;
        best = item;
      }
    }
    for (int vertex : vertices_of_items[*best]) {
      last_used[vertex] = now;
    }
    order.push_back(*best);
    waiting.erase(best);
  }
  return order;
}

FabricConstraints::FabricConstraints(const std::vector<Vector3>& vertices, const std::vector<MeshEdge>& edges) {
  std::vector<const MeshEdge*> interior, boundary;
  std::vector<std::vector<int>> interior_vertices, boundary_vertices;
  for (const MeshEdge& edge : edges) {
    const auto [a, b] = edge.vertices;
    if (edge.interior()) {
      interior.push_back(&edge);
      interior_vertices.push_back({a, b, edge.opposite[0], edge.opposite[1]});
    } else {
      boundary.push_back(&edge);
      boundary_vertices.push_back({a, b});
    }
  }
  const auto note = [this](const MeshEdge& edge, double fold_area) {
    const double pair = edge.interior() ? edge.area : 2.0 * edge.area;
    const double fineness = std::max(1.0, std::cbrt(kCoarse / pair));
    rest_.push_back({edge.length * edge.length / edge.area, fold_area, fineness});
  };
  const int count = static_cast<int>(vertices.size());
  for (int i : independentOrder(interior_vertices, count)) {
    HingeConstraint hinge{};
    const std::array<double, 4> weights = foldWeights(vertices, *interior[i]);
    hinge.weight_of_end = weights[1] / weights[2];
    hinge.weight_of_opposite = weights[3] / weights[2];
    for (int k = 0; k < 4; ++k) {
      hinge.at[k] = place(interior_vertices[i][k]);
    }
    hinge.stretch.rest_length = interior[i]->length;
    hinge.waits = hinges_.empty() || touches(hinges_.back(), hinge);
    hinges_.push_back(hinge);
    note(*interior[i], interior[i]->area / (weights[2] * weights[2]));
  }
  for (int i : independentOrder(boundary_vertices, count)) {
    boundaries_.push_back(
        {{boundary[i]->length, {}, 1.0, 0.0}, {place(boundary_vertices[i][0]), place(boundary_vertices[i][1])}});
    note(*boundary[i], 0.0);
  }
  unfolded_.resize(vertices.size());
  spring_.resize(rest_.size());
  fold_spring_.resize(hinges_.size());
  elastic_.resize(rest_.size());
  elastic_fold_.resize(hinges_.size());
}

void FabricConstraints::update(const std::vector<double>& inverse_mass, double stretching_compliance,
                               double bending_compliance, double damping, double h) {
  updateFolds(inverse_mass, bending_compliance, h);
  const double least = leastCompliance(damping * h);
  const auto updateStretch = [&](StretchConstraint& stretch, const int* at, std::size_t i) {
    const int start = vertexAt(at[0]);
    const int end = vertexAt(at[1]);
    const double response = inverse_mass[start] + inverse_mass[end];
    const double unfolded = std::max(unfolded_[start], unfolded_[end]);
    const double floor = least * (unfolded < kLimp * h * h ? rest_[i].fineness : 1.0) + unfolded;
    const double compliance = std::max(stretching_compliance * rest_[i].length_share / (h * h), floor * response);
    const double s = stiffness(response, compliance - kUndone * response);
    stretch.yield = s > 0.0 ? s * compliance : 1.0;
    stretch.most_adapted = unfolded > kStiffFold ? 0.0 : kMostAdapted * stretch.rest_length;
    stretch.gain[0] = s * inverse_mass[start];
    stretch.gain[1] = -s * inverse_mass[end];
    spring_[i] = s / (h * h);
    elastic_[i] = stiffness(0.0, compliance * h * h);
  };
  for (std::size_t i = 0; i < hinges_.size(); ++i) {
    HingeConstraint& hinge = hinges_[i];
    updateStretch(hinge.stretch, hinge.at, i);
    const std::array<double, 4> weights = weightsOf(hinge);
    hinge.weight_of_stretch = weights[0] * hinge.stretch.gain[0] + weights[1] * hinge.stretch.gain[1];
  }
  for (std::size_t i = 0; i < boundaries_.size(); ++i) {
    updateStretch(boundaries_[i].stretch, boundaries_[i].at, hinges_.size() + i);
  }
}

void FabricConstraints::updateFolds(const std::vector<double>& inverse_mass, double bending_compliance, double h) {
  std::fill(unfolded_.begin(), unfolded_.end(), 0.0);
  for (std::size_t i = 0; i < hinges_.size(); ++i) {
    HingeConstraint& hinge = hinges_[i];
    const std::array<double, 4> weights = weightsOf(hinge);
    double response = 0.0;
    for (int k = 0; k < 4; ++k) {
      response += inverse_mass[vertexAt(hinge.at[k])] * weights[k] * weights[k];
    }
    const double s = stiffness(response, bending_compliance * rest_[i].fold_area / (h * h));
    for (int k = 0; k < 4; ++k) {
      const int vertex = vertexAt(hinge.at[k]);
      hinge.gain[k] = -s * inverse_mass[vertex] * weights[k];
      unfolded_[vertex] = std::max(unfolded_[vertex], s * response);
    }
    fold_spring_[i] = s / (h * h);
    elastic_fold_[i] = stiffness(0.0, bending_compliance * rest_[i].fold_area);
  }
}

double FabricConstraints::stretchingCompliance() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    sum += 1.0 / (elastic_[i] * rest_[i].length_share);
  }
  return sum / rest_.size();
}

void FabricConstraints::restLengths(AlignedArray& to) const {
  auto at = to.begin();
  for (const HingeConstraint& hinge : hinges_) {
    at = std::fill_n(at, kLanes, hinge.stretch.rest_length);
  }
  for (const BoundaryConstraint& boundary : boundaries_) {
    at = std::fill_n(at, kLanes, boundary.stretch.rest_length);
  }
}

Vector3 FabricConstraints::force(int vertex, const double* recorded) const {
  const auto read = [](const double* from) { return Vector3(from[0], from[kLanes], from[2 * kLanes]); };
  const int at = place(vertex);
  Vector3 force = Vector3::Zero();
  for (std::size_t i = 0; i < hinges_.size(); ++i, recorded += kRecordedOfHinge) {
    for (int k = 0; k < 4; ++k) {
      if (hinges_[i].at[k] == at) {
        force -= fold_spring_[i] * weightsOf(hinges_[i])[k] * read(recorded + 3 * kLanes);
        if (k < 2) {
          force += (k == 0 ? spring_[i] : -spring_[i]) * read(recorded);
        }
      }
    }
  }
  for (std::size_t i = 0; i < boundaries_.size(); ++i, recorded += kRecordedOfBoundary) {
    const double spring = spring_[hinges_.size() + i];
    for (int k = 0; k < 2; ++k) {
      if (boundaries_[i].at[k] == at) {
        force += (k == 0 ? spring : -spring) * read(recorded);
      }
    }
  }
  return force;
}

}  // namespace pbd
}  // namespace deformable_manipulation
