#include "rod_masses.h"

#include <algorithm>

namespace deformable_manipulation {
namespace pbd {

SegmentMasses segmentMasses(const RodParameters& rod) {
  const double l = rod.segmentLength();
  SegmentMasses masses;
  masses.relative.assign(rod.segments, 1.0);
  masses.moment.assign(rod.segments, 0.0);
  masses.inertia.assign(rod.segments, 0.0);
  for (const PointMass& point : rod.point_masses) {
    const int segment = std::min(static_cast<int>(point.at / l), rod.segments - 1);
    const double offset = point.at - (segment + 0.5) * l;
    masses.relative[segment] += point.mass / rod.segmentMass();
    masses.moment[segment] += point.mass * offset;
    masses.inertia[segment] += point.mass * offset * offset;
  }
  masses.before.assign(1, 0.0);
  for (double relative : masses.relative) {
    masses.before.push_back(masses.before.back() + relative);
  }
  return masses;
}

}  // namespace pbd
}  // namespace deformable_manipulation
