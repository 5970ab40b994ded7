#include <gtest/gtest.h>

#include "../../src/ros/pose_inbox.h"

namespace deformable_manipulation {
namespace {

constexpr double kLongTime = 1000.0;  // s, so that no pose is lost while the test runs
constexpr double kCycle = 0.01;       // s

geometry_msgs::PoseStamped poseAt(double stamp, double x) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "map";
  pose.header.stamp = ros::Time(1000.0 + stamp);
  pose.pose.position.x = x;
  pose.pose.orientation.w = 1.0;
  return pose;
}

//! Poses of an agent that moves at 0.1 m/s for three seconds.
PoseInbox moving() {
  PoseInbox inbox("map", kLongTime, 0.1);
  for (int cycle = 0; cycle <= 300; ++cycle) {
    EXPECT_EQ(inbox.receive(poseAt(kCycle * cycle, 0.1 * kCycle * cycle)), "");
  }
  return inbox;
}

TEST(PoseInbox, PredictsFromTheStampToTheEndOfTheCycle) {
  const PoseInbox inbox = moving();
  pbd::Pose present;
  present.position = {0.304, 0.0, 0.0};
  const double delay = 0.05;  // s; the agent is then at 0.305 m, and a cycle later at 0.306 m
  const pbd::Twist twist = inbox.twistFrom(present, ros::Time(1003.0 + delay), kCycle);
  EXPECT_NEAR(twist.linear.x(), (0.306 - 0.304) / kCycle, 1e-4);
  EXPECT_NEAR(inbox.velocity().x(), 0.1, 1e-6);
}

TEST(PoseInbox, TakesNoiseOutOfTheVelocity) {
  PoseInbox inbox = moving();
  inbox.receive(poseAt(3.01, 0.301 + 0.002));
  EXPECT_NEAR(inbox.velocity().x(), 0.1, 0.002);  // the difference of the newest two poses would be 0.3 m/s
}

TEST(PoseInbox, StartsAfreshAfterALeap) {
  PoseInbox inbox = moving();
  inbox.receive(poseAt(3.01, 1.0));
  EXPECT_EQ(inbox.velocity(), pbd::Vector3::Zero());
  pbd::Pose present;
  present.position = {0.999, 0.0, 0.0};
  EXPECT_NEAR(inbox.twistFrom(present, ros::Time(1003.01), kCycle).linear.x(), 0.1, 1e-6);
}

TEST(PoseInbox, NeverFasterThanItsLimit) {
  const PoseInbox inbox = moving();
  EXPECT_NEAR(inbox.twistFrom(pbd::Pose(), ros::Time(1003.0), kCycle).linear.x(), PoseInbox::kMaxSpeed, 1e-12);
}

}  // namespace
}  // namespace deformable_manipulation
