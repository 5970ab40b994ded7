// The exact response of a rod to its holds against differences of settled shapes.

#include <gtest/gtest.h>

#include "deformable_manipulation/pbd/rod_equilibrium.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

std::vector<double> pointsOf(const Rod& rod) {
  std::vector<double> points(3 * rod.pointCount() * rod.copyCount());
  rod.points(points.data());
  return points;
}

struct Grips {
  const char* name;
  std::vector<std::pair<int, Hold>> holds;  // along y, 1.5 m from the first to the last
  Stretch stretch;
  double young_modulus;
  double twist = 0.0;                 // rad, of the last hold
  Vector3 natural = {0.0, 0.0, 0.0};  // twist and curvatures without load [1/m]
  std::vector<PointMass> point_masses = {};
  std::vector<Grip> lengths = {};
};

std::unique_ptr<Rod> heldRod(const Grips& grips) {
  RodParameters p = rope();
  p.young_modulus = grips.young_modulus;
  p.torsion_modulus = grips.young_modulus / 3.0;
  p.stretch = grips.stretch;
  p.natural_shape.twist = grips.natural[0];
  p.natural_shape.curvature = grips.natural.tail<2>();
  p.point_masses = grips.point_masses;
  p.grips = grips.lengths;
  auto rod = std::make_unique<Rod>(p);
  for (const auto& [particle, type] : grips.holds) {
    const double along = 1.5 * particle / (p.segments - 1);
    rod->hold(particle, type, gripAt(p, Vector3(0.02 * particle / p.segments, along, 0.1 * along)));
  }
  rod->layOut();
  if (grips.twist != 0.0) {
    const int last = grips.holds.back().first;
    rod->setTwist(last, {Vector3::Zero(), grips.twist * Vector3::UnitY()});
    for (int i = 0; i < 100; ++i) {
      rod->step(0.01, 2);
    }
    rod->setTwist(last, Twist());
  }
  return rod;
}

class Equilibrium : public testing::TestWithParam<Grips> {};

TEST_P(Equilibrium, isWhereTheRodSettles) {
  auto rod = heldRod(GetParam());
  SettleOptions options = settling();
  options.speed_tolerance = 1e-8;
  options.substeps = 2;
  ASSERT_TRUE(rod->settle(options));
  RodEquilibrium equilibrium;
  equilibrium.update(*rod, 1);
  ASSERT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0));
  std::vector<double> found(3 * rod->pointCount());
  equilibrium.points(0, found.data());
  const std::vector<double> settled = pointsOf(*rod);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], settled[i], 1e-6) << "coordinate " << i;
  }
}

TEST_P(Equilibrium, respondsAsSmallDifferencesDo) {
  auto rod = heldRod(GetParam());
  SettleOptions options = settling();
  ASSERT_TRUE(rod->settle(options));
  EquilibriumOptions exact;
  exact.tolerance = 1e-10;
  RodEquilibrium equilibrium;
  equilibrium.update(*rod, 1, exact);
  ASSERT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0));
  const int coordinates = 3 * rod->pointCount();
  std::vector<double> response(rod->holds().size() * 3 * coordinates);
  equilibrium.response(0, response.data());

  const double step = 1e-5;
  for (std::size_t h = 0; h < rod->holds().size(); ++h) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> shapes[2];
      for (int side = 0; side < 2; ++side) {
        const HeldPoint& held = rod->holds()[h];
        Pose pose = held.pose;
        pose.position[axis] += side == 0 ? step : -step;
        const auto displaced = rod->clone();
        displaced->setPose(held.particle, pose);
        RodEquilibrium there;
        there.update(dynamic_cast<const Rod&>(*displaced), 1, exact);
        ASSERT_EQ(there.status(0), ResponseStatus::VALID) << describe(there.status(0));
        shapes[side].resize(coordinates);
        there.points(0, shapes[side].data());
      }
      for (int i = 0; i < coordinates; ++i) {
        const double difference = (shapes[0][i] - shapes[1][i]) / (2.0 * step);
        EXPECT_NEAR(response[h * 3 * coordinates + 3 * i + axis], difference, 1e-7)
            << "hold " << h << ", axis " << axis << ", coordinate " << i;
      }
    }
  }
}

TEST(EquilibriumOfCopies, isWhereTheySettle) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  for (int axis = 0; axis < 3; ++axis) {
    rod->addCopy(27, 0.1 * Vector3::Unit(axis));
    rod->addCopy(27, -0.1 * Vector3::Unit(axis));
    rod->addCopy(0, 0.1 * Vector3::Unit(axis));
  }
  SettleOptions options = settling();
  options.speed_tolerance = 1e-8;
  options.substeps = 2;
  ASSERT_TRUE(rod->settle(options));
  RodEquilibrium equilibrium;
  equilibrium.update(*rod, rod->copyCount());
  const std::vector<double> settled = pointsOf(*rod);
  const std::size_t coordinates = 3 * rod->pointCount();
  std::vector<double> found(coordinates);
  for (int copy = 0; copy < rod->copyCount(); ++copy) {
    ASSERT_EQ(equilibrium.status(copy), ResponseStatus::VALID) << describe(equilibrium.status(copy));
    equilibrium.points(copy, found.data());
    for (std::size_t i = 0; i < coordinates; ++i) {
      EXPECT_NEAR(found[i], settled[copy * coordinates + i], 1e-6) << "copy " << copy << ", coordinate " << i;
    }
  }
}

TEST(Response, followsTheHoldsWarmStarted) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  ASSERT_TRUE(rod->settle(settling()));
  RodEquilibrium equilibrium;
  equilibrium.update(*rod, 1);
  rod->setTwist(27, {Vector3(0.05, -0.1, 0.1), Vector3::Zero()});
  for (int i = 0; i < 300; ++i) {
    rod->step(0.01, 2);
    equilibrium.update(*rod, 1);
    ASSERT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0)) << ", step " << i;
    EXPECT_LE(equilibrium.iterations(), 3);
  }
}

TEST(Response, followsTurnsThatItWasNotAskedAbout) {
  RodParameters p = rope();
  p.gravity.setZero();
  p.stretch = Stretch::FROM_MODULI;
  Rod rod(p);
  rod.hold(0, Hold::CLAMPED);
  rod.hold(27, Hold::CLAMPED);
  rod.setPose(27,
              {rod.pose(27).position + Vector3(0.0, 0.01, 0.0), rod.pose(27).orientation});  // taut: it stays straight
  ASSERT_TRUE(rod.settle(settling(2)));
  std::vector<double> response(2 * rod.pointCount() * 9), other(response.size());
  ASSERT_EQ(rod.response(response.data()), ResponseStatus::VALID);
  rod.setTwist(27, {Vector3::Zero(), 2.0 * M_PI * Vector3::UnitY()});
  for (int i = 0; i < 1000; ++i) {
    rod.step(0.01, 2);
  }
  rod.setTwist(27, Twist());
  ASSERT_TRUE(rod.settle(settling(2)));
  ASSERT_EQ(rod.response(response.data()), ResponseStatus::VALID);
  RodEquilibrium fresh;
  fresh.update(rod, 1);
  ASSERT_EQ(fresh.status(0), ResponseStatus::VALID);
  fresh.response(0, other.data());
  for (std::size_t i = 0; i < response.size(); ++i) {
    ASSERT_NEAR(response[i], other[i], 1e-4) << i;
  }
}

TEST(Response, movesAllPointsWithAllHolds) {
  auto rod = hangingRope(rope(), 1.5, Hold::PINNED);
  ASSERT_TRUE(rod->settle(settling()));
  std::vector<double> response(2 * rod->pointCount() * 9);
  ASSERT_EQ(rod->response(response.data()), ResponseStatus::VALID);
  for (int point = 0; point < rod->pointCount(); ++point) {
    for (int i = 0; i < 9; ++i) {
      const double sum = response[9 * point + i] + response[9 * (rod->pointCount() + point) + i];
      EXPECT_NEAR(sum, i % 4 == 0 ? 1.0 : 0.0, 1e-9);
    }
  }
}

TEST(Response, saysWhyThereIsNone) {
  std::vector<double> response(2 * 29 * 9);
  Rod free(rope());
  EXPECT_EQ(free.response(response.data()), ResponseStatus::NOT_HELD);

  auto taut = hangingRope(rope(), 2.5, Hold::CLAMPED);
  EXPECT_EQ(taut->response(response.data()), ResponseStatus::OUT_OF_REACH);

  auto swinging = hangingRope(rope(), 1.5, Hold::CLAMPED);
  ASSERT_TRUE(swinging->settle(settling()));
  swinging->setPose(27, gripAt(rope(), Vector3(0.0, 0.3, 0.0)));
  EXPECT_EQ(swinging->response(response.data()), ResponseStatus::OTHER_SHAPE);
  ASSERT_TRUE(swinging->settle(settling()));
  EXPECT_EQ(swinging->response(response.data()), ResponseStatus::VALID);
}

TEST(Response, isNotGivenForAnUnstableShape) {
  RodParameters p = rope();  // stands upright on a clamped end, though it is far too soft to
  p.pose.orientation = Quaternion(Eigen::AngleAxisd(-M_PI / 2.0, Vector3::UnitY()));
  Rod rod(p);
  rod.hold(0, Hold::CLAMPED);
  std::vector<double> response(rod.pointCount() * 9);
  EXPECT_EQ(rod.response(response.data()), ResponseStatus::UNSTABLE);
}

INSTANTIATE_TEST_SUITE_P(
    Holds, Equilibrium,
    testing::Values(
        Grips{"clampedEnds", {{0, Hold::CLAMPED}, {27, Hold::CLAMPED}}, Stretch::ZERO, 30e6},
        Grips{"pinnedEnds", {{0, Hold::PINNED}, {27, Hold::PINNED}}, Stretch::ZERO, 30e6},
        Grips{"extensible", {{0, Hold::CLAMPED}, {27, Hold::PINNED}}, Stretch::FROM_MODULI, 1e6},
        Grips{"threeHolds", {{2, Hold::CLAMPED}, {13, Hold::PINNED}, {24, Hold::CLAMPED}}, Stretch::ZERO, 30e6},
        Grips{"interiorClamped",
              {{0, Hold::PINNED}, {14, Hold::CLAMPED}, {27, Hold::PINNED}},
              Stretch::FROM_MODULI,
              30e6},
        Grips{"twisted", {{0, Hold::CLAMPED}, {27, Hold::CLAMPED}}, Stretch::ZERO, 30e6, 5.0},
        Grips{"twistedBetweenPins",
              {{0, Hold::CLAMPED}, {14, Hold::PINNED}, {27, Hold::CLAMPED}},
              Stretch::FROM_MODULI,
              30e6,
              -4.0},
        Grips{"coil", {{0, Hold::CLAMPED}, {27, Hold::CLAMPED}}, Stretch::ZERO, 30e6, 0.0, {1.0, 0.6, -0.8}},
        Grips{"bentAndLoaded",
              {{2, Hold::CLAMPED}, {13, Hold::PINNED}, {24, Hold::CLAMPED}},
              Stretch::FROM_MODULI,
              30e6,
              0.0,
              {0.5, 0.3, 0.2},
              {{0.0, 0.01}, {0.7, 0.02}, {2.25, 0.01}}},
        Grips{"gripped",
              {{0, Hold::CLAMPED}, {27, Hold::CLAMPED}},
              Stretch::ZERO,
              30e6,
              0.0,
              {0.0, 0.0, 0.0},
              {},
              {{0, 0.02}, {27, 0.02}}},
        Grips{"grippedInside",
              {{2, Hold::CLAMPED}, {13, Hold::PINNED}, {24, Hold::CLAMPED}},
              Stretch::FROM_MODULI,
              30e6,
              0.0,
              {0.3, 0.2, 0.1},
              {{0.5, 0.05}},
              {{2, 0.03}, {13, {}}, {24, 0.0}}},
        Grips{"oneHold", {{5, Hold::CLAMPED}}, Stretch::ZERO, 30e6}),
    [](const testing::TestParamInfo<Grips>& info) { return info.param.name; });

//! Shapes that the rope of a fixture would have with its second grip elsewhere.
struct Elsewhere {
  RodParameters p = rope();
  std::unique_ptr<Rod> present = hangingRope(p, 1.5, Hold::CLAMPED);
  std::vector<HeldPoint> agents{{p.segments - 1, Hold::CLAMPED, gripAt(p, {0.0, 1.5, 0.0}), {}},
                                {0, Hold::CLAMPED, gripAt(p, Vector3::Zero()), {}}};
  std::unique_ptr<RestShapes> shapes = Rod(p).restShapes(agents);
  std::vector<double> points = std::vector<double>(3 * (p.segments + 1));

  Elsewhere() {
    present->settle(settling());
    present->points(points.data());
    shapes->setPresent(points.data());
  }

  //! Points of the settled rope, held there.
  std::vector<double> settled(const Vector3& second) const {
    auto rod = hangingRope(p, 1.5, Hold::CLAMPED);
    rod->setPose(p.segments - 1, gripAt(p, second));
    rod->layOut();
    EXPECT_TRUE(rod->settle(settling()));
    std::vector<double> result(points.size());
    rod->points(result.data());
    return result;
  }

  std::vector<double> found(int shape) const {
    std::vector<double> result(points.size());
    shapes->points(shape, result.data());
    return result;
  }
};

double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

TEST(RestShapes, areThoseInWhichTheRodSettles) {
  Elsewhere elsewhere;
  const std::vector<Vector3> seconds{{0.0, 1.55, 0.1}, {0.1, 1.3, 0.2}, {-0.2, 1.6, -0.1}};
  std::vector<Vector3> held;
  for (const Vector3& second : seconds) {
    held.push_back(second);
    held.push_back(Vector3::Zero());
  }
  elsewhere.shapes->find(held);
  for (int shape = 0; shape < 3; ++shape) {
    ASSERT_TRUE(elsewhere.shapes->known(shape)) << shape;
    EXPECT_LT(largestDifference(elsewhere.found(shape), elsewhere.settled(seconds[shape])), 1e-3) << shape;
  }
}

TEST(RestShapes, haveTheirResponseInTheOrderOfTheAgents) {
  Elsewhere elsewhere;
  const Vector3 second(0.05, 1.4, 0.1);
  const double step = 1e-4;
  elsewhere.shapes->find(
      {second, Vector3::Zero(), second + Vector3(0.0, step, 0.0), Vector3::Zero(), second, Vector3(0.0, 0.0, step)});
  std::vector<double> response(2 * 3 * elsewhere.points.size());
  elsewhere.shapes->response(0, response.data());
  const std::vector<double> before = elsewhere.found(0);
  for (int agent = 0; agent < 2; ++agent) {
    const int axis = agent + 1;
    const std::vector<double> after = elsewhere.found(agent + 1);
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double derivative = response[3 * (agent * before.size() + k) + axis];
      EXPECT_NEAR((after[k] - before[k]) / step, derivative, 2e-3);
    }
  }
}

TEST(RestShapes, areUnknownOutOfReach) {
  Elsewhere elsewhere;
  elsewhere.shapes->find({{0.0, 2.5, 0.0}, Vector3::Zero(), {0.0, 1.5, 0.0}, Vector3::Zero()});
  EXPECT_FALSE(elsewhere.shapes->known(0));
  EXPECT_TRUE(elsewhere.shapes->known(1));
}

TEST(RestShapes, startAgainWhenTheObjectHasTakenAnotherShape) {
  Elsewhere elsewhere;
  const std::vector<Vector3> held{{0.0, 1.5, 0.0}, Vector3::Zero()};
  elsewhere.shapes->find(held);
  std::vector<double> turned = elsewhere.points;  // by a half turn about the line through the grips: a rope that stands
  for (std::size_t i = 0; i < turned.size(); i += 3) {
    turned[i] = -turned[i];
    turned[i + 2] = -turned[i + 2];
  }
  elsewhere.shapes->setPresent(turned.data());
  elsewhere.shapes->find(held);
  // The hanging shape is not taken for the standing one, which is none that could be relied on.
  EXPECT_FALSE(elsewhere.shapes->known(0) && largestDifference(elsewhere.found(0), turned) > 0.5);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
