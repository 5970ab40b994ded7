// A body comes to rest whatever its damping, and not in a balance that ends with the first breath.

#include <gtest/gtest.h>

#include "fabric_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

//! A stiff rod that stands upright on a pinned end, with nothing that makes it fall to a side.
std::unique_ptr<Rod> standingRod() {
  RodParameters p = rope(12);
  p.length = 1.0;
  p.young_modulus = 1e9;
  p.torsion_modulus = 4e8;
  p.pose.orientation = Quaternion(Eigen::AngleAxisd(-M_PI / 2.0, Vector3::UnitY()));  // along z
  auto rod = std::make_unique<Rod>(p);
  rod->hold(0, Hold::PINNED);
  return rod;
}

TEST(Settling, endsInTheSameShapeWhateverTheDamping) {
  std::vector<std::unique_ptr<Rod>> rods;
  for (double damping : {0.0, 10.0, 1000.0, 10000.0}) {
    RodParameters p = rope();
    p.damping = damping;
    rods.push_back(hangingRope(p, 1.5, Hold::PINNED));
    SettleOptions options = settling(2);
    options.speed_tolerance = 1e-7;
    ASSERT_TRUE(rods.back()->settle(options)) << damping;
    EXPECT_EQ(rods.back()->parameters().damping, damping);
    EXPECT_LT(difference(*rods.back(), 0, *rods.front(), 0), 1e-5) << damping;
  }
}

TEST(Settling, leavesAnUnstableBalance) {
  auto rod = standingRod();
  ASSERT_TRUE(rod->settle(settling(2)));
  EXPECT_NEAR(rod->pose(11).position.z(), 11.5 / 12.0, 1e-3);  // settling alone does not

  rod = standingRod();
  ASSERT_EQ(rod->settleStably(settling(2)), Rest::STABLE);
  EXPECT_NEAR(rod->pose(11).position.z(), 0.5 / 12.0 - 11.0 / 12.0, 2e-3);
}

TEST(Settling, takesTheCopiesAlongWhenItLeavesABalance) {
  auto rod = standingRod();
  const int id = rod->addCopy(0, Vector3(0.05, 0.0, 0.0));
  ASSERT_EQ(rod->settleStably(settling(2)), Rest::STABLE);
  ASSERT_EQ(rod->copies().size(), 1u);
  EXPECT_EQ(rod->copies()[0].id, id);
  EXPECT_TRUE(rod->copies()[0].ready());
  const std::vector<Vector3> object = positions(*rod, 0), copy = positions(*rod, 1);
  for (std::size_t i = 0; i < object.size(); ++i) {
    EXPECT_NEAR((copy[i] - object[i] - Vector3(0.05, 0.0, 0.0)).norm(), 0.0, 5e-3) << i;
  }
}

TEST(Settling, pushesNothingThatIsStable) {
  for (const bool fabric : {false, true}) {
    std::unique_ptr<Body> settled, pushed;
    if (fabric) {
      settled = hangingCloth(cloth());
    } else {
      settled = hangingRope(rope(), 1.5, Hold::CLAMPED);
    }
    pushed = settled->clone();
    ASSERT_TRUE(settled->settle(settling(10)));
    ASSERT_EQ(pushed->settleStably(settling(10)), Rest::STABLE);
    EXPECT_EQ(difference(*settled, 0, *pushed, 0), 0.0);
  }
}

TEST(Settling, tellsThatAnObjectStillMoves) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  SettleOptions options = settling(2);
  options.time_limit = 0.1;
  EXPECT_EQ(rod->settleStably(options), Rest::MOVING);
}

TEST(Settling, hasWordsForEveryRest) {
  EXPECT_STREQ(describe(Rest::STABLE), "");
  for (Rest rest : {Rest::MOVING, Rest::BALANCED}) {
    EXPECT_GT(std::string(describe(rest)).size(), 50u);
  }
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
