#include "fabric_constraints.h"

#include <algorithm>
#include <array>
#include <list>

namespace deformable_manipulation {
namespace pbd {
namespace {

// Compliance of an edge in equilibrium, at least, as a part of its response: below, the folds of a cloth between its
// holds do not always come to rest.
constexpr double kLeastCompliance = 0.4;

// Places between two constraints that touch a common vertex, and how far ahead such are searched for.
constexpr int kApart = 3;
constexpr int kLookAhead = 96;

int place(int vertex) { return 3 * kLanes * vertex; }

std::array<double, 4> weightsOf(const HingeConstraint& hinge) {
  const double* w = hinge.weight;
  return {-(w[0] + w[1] + w[2]), w[0], w[1], w[2]};
}

//! Multiplier per violation, 1 / (response + compliance); 0 where nothing can move and nothing yields.
double stiffness(double response, double compliance) {
  const double sum = response + compliance;
  return sum > 0.0 ? 1.0 / sum : 0.0;
}

//! The same for a spring in a net in equilibrium. A substep is one sweep from zero. Springs that are solved later undo
//! part of what an earlier one did, half its response as the forces on each vertex balance: in the state of rest they
//! would be longer by that. What they yield too much is taken off their compliance, as far as that goes without
//! over-relaxation, which is not stable.
double stiffnessInNet(double response, double compliance) {
  return stiffness(response, std::max(0.0, compliance - 0.5 * response));
}

}  // namespace

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
  const auto note = [this](const MeshEdge& edge) {
    rest_.push_back({edge.length * edge.length / edge.area, edge.area});
  };
  const int count = static_cast<int>(vertices.size());
  for (int i : independentOrder(interior_vertices, count)) {
    HingeConstraint hinge{};
    const std::array<double, 4> weights = foldWeights(vertices, *interior[i]);
    std::copy(weights.begin() + 1, weights.end(), hinge.weight);
    for (int k = 0; k < 4; ++k) {
      hinge.at[k] = place(interior_vertices[i][k]);
    }
    hinge.stretch.rest_length = interior[i]->length;
    hinges_.push_back(hinge);
    note(*interior[i]);
  }
  for (int i : independentOrder(boundary_vertices, count)) {
    BoundaryConstraint constraint{};
    constraint.stretch.rest_length = boundary[i]->length;
    for (int k = 0; k < 2; ++k) {
      constraint.at[k] = place(boundary_vertices[i][k]);
    }
    boundaries_.push_back(constraint);
    note(*boundary[i]);
  }
  spring_.resize(rest_.size());
  fold_spring_.resize(hinges_.size());
}

void FabricConstraints::update(const std::vector<double>& inverse_mass, double stretching_compliance,
                               double bending_compliance, double h) {
  const double per_h2 = 1.0 / (h * h);
  const auto mobility = [&inverse_mass](int at) { return inverse_mass[at / (3 * kLanes)]; };
  const auto updateStretch = [&](StretchConstraint& stretch, const int* at, std::size_t i) {
    const double w0 = mobility(at[0]);
    const double w1 = mobility(at[1]);
    const double compliance = stretching_compliance * rest_[i].length_share * per_h2;
    const double s = stiffnessInNet(w0 + w1, compliance);
    stretch.yield = s > 0.0 ? s * std::max(compliance, kLeastCompliance * (w0 + w1)) : 1.0;
    stretch.gain[0] = s * w0;
    stretch.gain[1] = -s * w1;
    spring_[i] = s * per_h2;
  };
  for (std::size_t i = 0; i < hinges_.size(); ++i) {
    HingeConstraint& hinge = hinges_[i];
    const std::array<double, 4> weights = weightsOf(hinge);
    updateStretch(hinge.stretch, hinge.at, i);
    double response = 0.0;
    for (int k = 0; k < 4; ++k) {
      response += mobility(hinge.at[k]) * weights[k] * weights[k];
    }
    const double s = stiffness(response, bending_compliance * rest_[i].fold_area * per_h2);
    for (int k = 0; k < 4; ++k) {
      hinge.gain[k] = -s * mobility(hinge.at[k]) * weights[k];
    }
    hinge.weight_of_stretch = weights[0] * hinge.stretch.gain[0] + weights[1] * hinge.stretch.gain[1];
    fold_spring_[i] = s * per_h2;
  }
  for (std::size_t i = 0; i < boundaries_.size(); ++i) {
    updateStretch(boundaries_[i].stretch, boundaries_[i].at, hinges_.size() + i);
  }
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
