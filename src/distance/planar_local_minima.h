#pragma once

#include <vector>

#include "planar_polyline.h"
#include "segment_extrema.h"

namespace deformable_manipulation {
namespace distance {

//! The local minima of the signed distance along polylines.
//!
//! A stretch that is level with the obstacle counts once, by its middle, if the distance grows at both its ends.
//! Minima nearer to each other than kProbe count once.
class PlanarLocalMinima {
 public:
  PlanarLocalMinima(PlanarRegion& region, PlanarPolyline& polyline)
      : region_(region), polyline_(polyline), extrema_(region.boundary(), region.tree()) {}

  //! Appends those whose signed distance is at most `limit` [m].
  void find(const PlanarCopy& line, double limit, std::vector<MaterialPoint>* found);

 private:
  struct Place {
    double position;       // m, along the line
    double distance;       // m, signed
    double before, after;  // m, signed distances at kProbe before and after it
    bool joined;           // level with the next one
  };

  void measureLine(const PlanarCopy& line);
  void collect(double limit);
  void collectOnSegment(int segment, double limit);
  void thinOut();
  void probe();
  bool isLowest(std::size_t first, std::size_t last) const;
  int segmentAt(double position) const;
  double parameterAt(double position, int segment) const;
  double distanceAt(double position) const;

  PlanarRegion& region_;
  PlanarPolyline& polyline_;
  SegmentExtrema extrema_;
  PlanarCopy line_ = {nullptr, 0};
  std::vector<double> reached_;  // m, arc length up to each point
  std::vector<double> parameters_;
  std::vector<Place> places_;
};

}  // namespace distance
}  // namespace deformable_manipulation
