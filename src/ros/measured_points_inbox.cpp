#include "measured_points_inbox.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace deformable_manipulation {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr std::uint64_t kMostPoints = 1000000;  // more are no measurement of a rope

//! Where the numbers of a field are in a point; size 0: there is no such field, or it is not of floating point.
struct Layout {
  std::uint32_t offset = 0;
  std::uint32_t size = 0;
};

Layout layoutOf(const PointCloud2& cloud, const char* name) {
  const auto field = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [name](const PointField& candidate) { return candidate.name == name; });
  if (field == cloud.fields.end() ||
      (field->datatype != PointField::FLOAT32 && field->datatype != PointField::FLOAT64)) {
    return {};
  }
  return {field->offset, field->datatype == PointField::FLOAT32 ? 4U : 8U};
}

double numberAt(const std::uint8_t* point, const Layout& layout) {
  if (layout.size == 0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  float single = 0.0F;
  double number = 0.0;
  std::memcpy(layout.size == 4 ? static_cast<void*>(&single) : &number, point + layout.offset, layout.size);
  return layout.size == 4 ? static_cast<double>(single) : number;
}

bool fits(const PointCloud2& cloud, const Layout& layout) {
  return std::uint64_t{layout.offset} + layout.size <= cloud.point_step;
}

}  // namespace

std::string MeasuredPointsInbox::read(const PointCloud2& cloud) {
  const Layout coordinates[3] = {layoutOf(cloud, "x"), layoutOf(cloud, "y"), layoutOf(cloud, "z")};
  const Layout place = layoutOf(cloud, "arc_length");
  const std::uint64_t count = std::uint64_t{cloud.width} * cloud.height;
  if (cloud.header.frame_id != frame_) {
    return "they are in frame '" + cloud.header.frame_id + "', not in '" + frame_ + "'";
  }
  if (std::any_of(coordinates, coordinates + 3, [](const Layout& each) { return each.size == 0; })) {
    return "the cloud lacks one of the fields x, y and z as float32 or float64";
  }
  if (cloud.is_bigendian) {
    return "the cloud is big-endian";
  }
  if (count > kMostPoints || cloud.row_step < std::uint64_t{cloud.width} * cloud.point_step ||
      cloud.data.size() < std::uint64_t{cloud.row_step} * cloud.height ||
      !std::all_of(coordinates, coordinates + 3, [&](const Layout& each) { return fits(cloud, each); }) ||
      !fits(cloud, place)) {
    return "the cloud's sizes do not fit its data";
  }
  points_.clear();
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    for (std::uint32_t column = 0; column < cloud.width; ++column) {
      const std::uint8_t* point =
          cloud.data.data() + std::size_t{row} * cloud.row_step + std::size_t{column} * cloud.point_step;
      points_.push_back(
          {{numberAt(point, coordinates[0]), numberAt(point, coordinates[1]), numberAt(point, coordinates[2])},
           numberAt(point, place)});
    }
  }
  return "";
}

}  // namespace deformable_manipulation
