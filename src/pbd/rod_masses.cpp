#include "rod_masses.h"

#include <algorithm>
#include <cmath>

namespace deformable_manipulation {
namespace pbd {

SegmentMasses segmentMasses(const RodParameters& rod) {
  const double l = rod.segmentLength();
  const int last = rod.segments - 1;
  SegmentMasses masses;
  masses.relative.assign(rod.segments, 1.0);
  masses.moment.assign(rod.segments, 0.0);
  masses.inertia.assign(rod.segments, 0.0);
  for (const PointMass& point : rod.point_masses) {
    const double relative = point.mass / rod.segmentMass();
    const double place = point.at / l - 0.5;  // in segments from the first centre
    const double within = std::min(std::max(place, 0.0), static_cast<double>(last));
    const int first = std::min(static_cast<int>(within), last - 1);
    const double share = within - first;
    masses.relative[first] += (1.0 - share) * relative;
    masses.relative[first + 1] += share * relative;
    const double beyond = (place - within) * l;
    const int end = beyond < 0.0 ? 0 : last;
    masses.moment[end] += point.mass * beyond;
    masses.inertia[end] += point.mass * beyond * beyond;
  }
  masses.before.assign(1, 0.0);
  for (double relative : masses.relative) {
    masses.before.push_back(masses.before.back() + relative);
  }
  return masses;
}

}  // namespace pbd
}  // namespace deformable_manipulation
