#include "element_depth.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr double kEnough = 0.5;  // of the gap that a sample must close for a piece not to be halved

}  // namespace

DeepPoint ElementDepth::find(const Corners<3>& corners, int count, const std::array<SurfacePoint, 3>& samples,
                             double threshold) {
  count_ = count;
  best_ = DeepPoint();
  cuts_.clear();
  samples_ = 0;
  threshold_ = threshold;
  pieces_.clear();
  Piece whole;
  whole.corners = corners;
  for (int k = 0; k < count; ++k) {
    whole.weights[k] = {0.0, 0.0, 0.0};
    whole.weights[k][k] = 1.0;
    sample(corners[k], whole.weights[k], samples[k]);
  }
  solve(&whole);
  push(whole);
  while (!pieces_.empty()) {
    gap_ = pieces_.front().solution.bound - best_.depth;
    if (pieces_.front().solution.bound <= threshold) {
      return {};
    }
    if (gap_ <= 0.5 * tolerance(best_.depth) || samples_ >= kMostSamples) {
      break;
    }
    refine(pop());
  }
  return best_;
}

void ElementDepth::sample(const Vector3& point, const Weights& weights, const SurfacePoint& at) {
  const double depth = -at.distance;
  cut(point, depth, at.triangle);
  if (depth <= 0.0) {
    cut(point, depth, -1);
  }
  ++samples_;
  if (depth > best_.depth) {
    best_ = {depth, at.triangle, weights};
  }
}

void ElementDepth::cut(const Vector3& point, double depth, int triangle) {
  const auto same = [triangle](const Cut& cut) { return cut.triangle == triangle; };
  if (triangle < 0 || std::none_of(cuts_.begin(), cuts_.end(), same)) {
    cuts_.push_back({point, depth, triangle});
  }
}

double ElementDepth::value(const Cut& cut, const Vector3& point) const {
  return cut.triangle >= 0 ? surface_.distanceTo(cut.triangle, point) : cut.depth + (point - cut.point).norm();
}

//! With all cuts, or those that are lowest on the piece.
void ElementDepth::solve(Piece* piece) const {
  std::array<std::array<double, 3>, MatrixGame::kMostFunctions> chosen;
  std::array<double, MatrixGame::kMostFunctions> means;
  std::size_t size = 0;
  for (const Cut& cut : cuts_) {
    std::array<double, 3> values = {0.0, 0.0, 0.0};
    double mean = 0.0;
    for (int k = 0; k < count_; ++k) {
      values[k] = value(cut, piece->corners[k]);
      mean += values[k];
    }
    std::size_t at = size;
    if (size < chosen.size()) {
      ++size;
    } else {
      at = std::max_element(means.begin(), means.end()) - means.begin();
      if (means[at] <= mean) {
        continue;
      }
    }
    chosen[at] = values;
    means[at] = mean;
  }
  MatrixGame game(count_);
  for (std::size_t i = 0; i < size; ++i) {
    game.add(chosen[i]);
  }
  piece->solution = game.solve();
  piece->cuts = cuts_.size();
}

void ElementDepth::push(const Piece& piece) {
  pieces_.push_back(piece);
  std::push_heap(pieces_.begin(), pieces_.end(),
                 [](const Piece& a, const Piece& b) { return a.solution.bound < b.solution.bound; });
}

ElementDepth::Piece ElementDepth::pop() {
  std::pop_heap(pieces_.begin(), pieces_.end(),
                [](const Piece& a, const Piece& b) { return a.solution.bound < b.solution.bound; });
  const Piece piece = pieces_.back();
  pieces_.pop_back();
  return piece;
}

void ElementDepth::refine(Piece piece) {
  const double before = piece.solution.bound;
  if (piece.cuts < cuts_.size()) {
    solve(&piece);
    piece.solution.bound = std::min(piece.solution.bound, before);
    if (piece.solution.bound < before) {
      push(piece);
      return;
    }
  }
  Vector3 point = Vector3::Zero();
  Weights weights = {0.0, 0.0, 0.0};
  for (int k = 0; k < count_; ++k) {
    const double share = piece.solution.weights[k];
    point += share * piece.corners[k];
    for (int i = 0; i < 3; ++i) {
      weights[i] += share * piece.weights[k][i];
    }
  }
  // What is not deeper than what is known need not be known better: a triangle that near bounds the depth there.
  const double enough = std::max(best_.depth, threshold_);
  const SurfacePoint there = surface_.nearest(point, -1, enough);
  if (std::fabs(there.distance) <= enough) {
    cut(point, std::fabs(there.distance), there.triangle);
    ++samples_;
  } else {
    sample(point, weights, there);
  }
  const double wanted = before - kEnough * (before - std::max(-there.distance, best_.depth));
  solve(&piece);
  piece.solution.bound = std::min(piece.solution.bound, before);
  if (piece.solution.bound <= wanted) {
    push(piece);
  } else {
    halve(piece);
  }
}

//! Across its longest edge.
void ElementDepth::halve(const Piece& piece) {
  int from = 0;
  double longest = -1.0;
  for (int k = 0; k < (count_ == 3 ? 3 : 1); ++k) {
    const double squared = (piece.corners[(k + 1) % count_] - piece.corners[k]).squaredNorm();
    if (squared > longest) {
      longest = squared;
      from = k;
    }
  }
  const int to = (from + 1) % count_;
  Weights middle;
  for (int i = 0; i < 3; ++i) {
    middle[i] = 0.5 * (piece.weights[from][i] + piece.weights[to][i]);
  }
  for (int replaced : {from, to}) {
    Piece half = piece;
    half.corners[replaced] = 0.5 * (piece.corners[from] + piece.corners[to]);
    half.weights[replaced] = middle;
    solve(&half);
    half.solution.bound = std::min(half.solution.bound, piece.solution.bound);
    push(half);
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
