#include "rod_masses.h"

namespace deformable_manipulation {
namespace pbd {

SegmentMasses segmentMasses(const RodParameters& rod, const RodPieces& pieces) {
  SegmentMasses masses;
  masses.moment.assign(rod.segments, 0.0);
  for (int i = 0; i < rod.segments; ++i) {
    masses.relative.push_back(pieces.share(i));
    masses.inertia.push_back(pieces.equal ? 0.0 : rod.transverseInertia(pieces.lengths[i]) - rod.transverseInertia());
  }
  for (const PointMass& point : rod.point_masses) {
    const int segment = pieces.at(point.at);
    const double offset = point.at - pieces.centre(segment);
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
