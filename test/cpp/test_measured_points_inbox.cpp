#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <limits>
#include <vector>

#include "../../src/ros/measured_points_inbox.h"

namespace deformable_manipulation {
namespace {

//! A cloud as others make them: padded, with an intensity between the coordinates and the arc length.
sensor_msgs::PointCloud2 cloudOf(const std::vector<pbd::Vector3>& points) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = "map";
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  using sensor_msgs::PointField;
  modifier.setPointCloud2Fields(5, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                                PointField::FLOAT32, "intensity", 1, PointField::UINT8, "arc_length", 1,
                                PointField::FLOAT64);
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
  sensor_msgs::PointCloud2Iterator<double> place(cloud, "arc_length");
  for (std::size_t i = 0; i < points.size(); ++i, ++x, ++place) {
    for (int axis = 0; axis < 3; ++axis) {
      x[axis] = static_cast<float>(points[i][axis]);
    }
    *place = 0.25 * static_cast<double>(i);
  }
  return cloud;
}

const std::vector<pbd::Vector3> kPoints = {{1.0, 2.0, 3.0}, {0.5, -0.25, 8.0}, {0.0, 0.0, -1.0}};

void expectPoints(const MeasuredPointsInbox& inbox) {
  ASSERT_EQ(inbox.points().size(), kPoints.size());
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    EXPECT_EQ(inbox.points()[i].position, kPoints[i]);
    EXPECT_EQ(inbox.points()[i].place, 0.25 * static_cast<double>(i));
  }
}

TEST(MeasuredPointsInbox, ReadsFieldsWhereverTheyAre) {
  MeasuredPointsInbox inbox("map");
  EXPECT_EQ(inbox.read(cloudOf(kPoints)), "");
  expectPoints(inbox);
}

TEST(MeasuredPointsInbox, ReadsRowsWithPadding) {
  MeasuredPointsInbox inbox("map");
  sensor_msgs::PointCloud2 cloud = cloudOf(kPoints);
  const std::vector<std::uint8_t> packed = cloud.data;
  cloud.data.clear();
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    const auto row = packed.begin() + static_cast<std::ptrdiff_t>(i * cloud.point_step);
    cloud.data.insert(cloud.data.end(), row, row + cloud.point_step);
    cloud.data.resize(cloud.data.size() + 7);
  }
  cloud.height = cloud.width;
  cloud.width = 1;
  cloud.row_step = cloud.point_step + 7;
  EXPECT_EQ(inbox.read(cloud), "");
  expectPoints(inbox);
}

TEST(MeasuredPointsInbox, PlacesMayBeUnknown) {
  MeasuredPointsInbox inbox("map");
  sensor_msgs::PointCloud2 cloud = cloudOf(kPoints);
  cloud.fields.pop_back();
  EXPECT_EQ(inbox.read(cloud), "");
  EXPECT_TRUE(std::isnan(inbox.points()[0].place));
}

TEST(MeasuredPointsInbox, DropsWhatItCannotRead) {
  MeasuredPointsInbox inbox("map");
  EXPECT_EQ(inbox.read(cloudOf(kPoints)), "");
  const auto refusal = [&inbox](auto spoil) {
    sensor_msgs::PointCloud2 cloud = cloudOf(kPoints);
    spoil(cloud);
    return inbox.read(cloud);
  };
  EXPECT_NE(refusal([](auto& cloud) { cloud.header.frame_id = "camera"; }).find("'camera'"), std::string::npos);
  EXPECT_NE(refusal([](auto& cloud) { cloud.fields[2].name = "range"; }).find("x, y and z"), std::string::npos);
  EXPECT_NE(refusal([](auto& cloud) { cloud.fields[0].datatype = sensor_msgs::PointField::INT32; }).find("x, y and z"),
            std::string::npos);
  EXPECT_NE(refusal([](auto& cloud) { cloud.is_bigendian = true; }).find("big-endian"), std::string::npos);
  EXPECT_NE(refusal([](auto& cloud) { cloud.data.pop_back(); }).find("sizes"), std::string::npos);
  EXPECT_NE(refusal([](auto& cloud) { cloud.fields[1].offset = cloud.point_step - 1; }).find("sizes"),
            std::string::npos);
  EXPECT_NE(refusal([](auto& cloud) { cloud.width = std::numeric_limits<std::uint32_t>::max(); }).find("sizes"),
            std::string::npos);
  expectPoints(inbox);  // those of the last one that was accepted
}

}  // namespace
}  // namespace deformable_manipulation
