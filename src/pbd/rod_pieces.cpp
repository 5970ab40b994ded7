#include "rod_pieces.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace pbd {
namespace {

// The segment next to a grip of a length, as a part of the usual length. With kGrowth it has the least error for the
// rope of the paper in 28 segments.
constexpr double kFirst = 0.26;
constexpr double kGrowth = 9.42;  // logarithm of how much longer segments would become all along the rod
constexpr double kLargestGrowth = 2.0;
constexpr double kShortest = 0.1;  // of the segment next to a grip

//! A stretch of the rod that a grip keeps where it is.
struct Anchor {
  int segment;
  double begin, end;  // m
  double held;        // m, that does not bend
  bool graded;        // whether the segments next to it are shorter
};

Anchor anchorOf(const Grip& grip, const RodParameters& rod) {
  const double usual = rod.segmentLength();
  const bool graded = grip.length.has_value();
  const double held = grip.length.value_or(0.0);
  const double half = 0.5 * (graded ? held + kFirst * usual : usual);
  double centre = (grip.particle + 0.5) * usual;
  if (grip.particle == 0) {
    centre = half;
  } else if (grip.particle == rod.segments - 1) {
    centre = rod.length - half;
  }
  return {grip.particle, centre - half, centre + half, held, graded};
}

//! The largest length with which segments that are no longer than that, or than they want to be, fill a span.
double longestToFill(const std::vector<double>& wanted, double span) {
  double longest = span / static_cast<double>(wanted.size());
  for (bool changed = true; changed;) {
    double kept = 0.0;
    int others = 0;
    for (double length : wanted) {
      kept += length < longest ? length : 0.0;
      others += length < longest ? 0 : 1;
    }
    const double next = (span - kept) / others;
    changed = next > longest * (1.0 + 1e-12);
    longest = std::max(longest, next);
  }
  return longest;
}

//! How much longer each segment is than the one before it, away from a grip. More segments grow as slowly along the
//! rod, or the error would only fall as their length does.
double growthOf(int segments) { return std::min(kLargestGrowth, std::exp(kGrowth / segments)); }

//! Divides a span [m] into segments; one that is not left between two grips, into negative lengths.
//! @param first [m] of a segment next to a grip of a length, which may be before and after the span
std::vector<double> divided(double span, int count, double first, double growth, bool graded_before,
                            bool graded_after) {
  const double share = span / count;
  std::vector<double> lengths(count, share);
  if (span <= 0.0 || (!graded_before && !graded_after)) {
    return lengths;
  }
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const int from_before = graded_before ? i : count;
    const int from_after = graded_after ? count - 1 - i : count;
    lengths[i] = first * std::pow(growth, std::min(from_before, from_after));
    sum += lengths[i];
  }
  const double longest = sum > span ? longestToFill(lengths, span) : 0.0;
  for (double& length : lengths) {
    length = sum > span ? std::min(length, longest) : length * (span / sum);
  }
  return lengths;
}

void appendSpan(const RodParameters& rod, const Anchor& before, const Anchor& after, RodPieces& pieces) {
  const int count = after.segment - before.segment - 1;
  if (count > 0) {
    const double first = kFirst * rod.segmentLength();
    const std::vector<double> lengths =
        divided(after.begin - before.end, count, first, growthOf(rod.segments), before.graded, after.graded);
    pieces.lengths.insert(pieces.lengths.end(), lengths.begin(), lengths.end());
  }
}

}  // namespace

double RodPieces::shorterAt(int joint) const { return std::min(lengths[joint], lengths[joint + 1]); }

int RodPieces::at(double place) const {
  const int last = static_cast<int>(lengths.size()) - 1;
  if (equal) {
    return std::min(static_cast<int>(place / usual), last);
  }
  const auto after = std::upper_bound(ends.begin() + 1, ends.end() - 1, place);
  return static_cast<int>(after - ends.begin()) - 1;
}

RodPieces rodPieces(const RodParameters& rod) {
  const int n = rod.segments;
  RodPieces pieces;
  pieces.usual = rod.segmentLength();
  const auto has_length = [](const Grip& grip) { return grip.length.has_value(); };
  pieces.equal = std::none_of(rod.grips.begin(), rod.grips.end(), has_length);
  std::vector<double> bending;  // [N] m of each segment
  if (pieces.equal) {
    pieces.lengths.assign(n, pieces.usual);
    bending = pieces.lengths;
  } else {
    Anchor before{-1, 0.0, 0.0, 0.0, false};
    for (const Grip& grip : rod.grips) {
      const Anchor anchor = anchorOf(grip, rod);
      appendSpan(rod, before, anchor, pieces);
      pieces.lengths.push_back(anchor.end - anchor.begin);
      before = anchor;
    }
    appendSpan(rod, before, {n, rod.length, rod.length, 0.0, false}, pieces);
    bending = pieces.lengths;
    for (const Grip& grip : rod.grips) {
      bending[grip.particle] -= grip.length.value_or(0.0);
    }
  }
  pieces.ends.assign(1, 0.0);
  for (int i = 0; i < n; ++i) {
    pieces.ends.push_back(pieces.equal ? (i + 1) * pieces.usual : pieces.ends.back() + pieces.lengths[i]);
  }
  for (int j = 0; j + 1 < n; ++j) {
    pieces.joint_lengths.push_back(pieces.equal ? pieces.usual : 0.5 * (bending[j] + bending[j + 1]));
  }
  return pieces;
}

double shortestPiece(const RodParameters& rod) { return kShortest * kFirst * rod.segmentLength(); }

}  // namespace pbd
}  // namespace deformable_manipulation
