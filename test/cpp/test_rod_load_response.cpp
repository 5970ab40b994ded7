// Wrenches of a rod in equilibrium, and the exact responses to turned holds, against settled rods and differences.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deformable_manipulation/pbd/rod_equilibrium.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

struct Held {
  const char* name;
  std::vector<std::pair<int, Hold>> holds;  // along y, 1.9 m from the first to the last segment
  Stretch stretch;
  double young_modulus;
  double tilt;                        // rad, of the last hold about x
  Vector3 natural = {0.0, 0.0, 0.0};  // twist and curvatures without load [1/m]
  std::vector<PointMass> point_masses = {};
  std::vector<Grip> grips = {};
};

std::unique_ptr<Rod> settled(const Held& given) {
  RodParameters p = rope();
  p.young_modulus = given.young_modulus;
  p.torsion_modulus = given.young_modulus / 3.0;
  p.stretch = given.stretch;
  p.natural_shape.twist = given.natural[0];
  p.natural_shape.curvature = given.natural.tail<2>();
  p.point_masses = given.point_masses;
  p.grips = given.grips;
  auto rod = std::make_unique<Rod>(p);
  for (const auto& [particle, type] : given.holds) {
    const double along = 1.9 * particle / (p.segments - 1);
    rod->hold(particle, type, gripAt(p, Vector3(0.03 * particle / p.segments, along, 0.1 * along)));
  }
  rod->layOut();
  const int last = given.holds.back().first;
  rod->setTwist(last, {Vector3::Zero(), given.tilt * Vector3(1.0, 0.5, -0.3)});
  for (int i = 0; i < 100; ++i) {
    rod->step(0.01, 2);
  }
  rod->setTwist(last, Twist());
  SettleOptions options = settling();
  options.speed_tolerance = 1e-9;
  options.substeps = 2;
  EXPECT_TRUE(rod->settle(options));
  return rod;
}

EquilibriumOptions exactly() {
  EquilibriumOptions options;
  options.tolerance = 1e-10;
  return options;
}

//! A rod with one of its holds moved (axes 0 to 2) or turned (3 to 5), and its equilibrium.
RodEquilibrium equilibriumOf(const Rod& rod, std::size_t hold, int axis, double by) {
  const HeldPoint& held = rod.holds()[hold];
  Pose pose = held.pose;
  if (axis < 3) {
    pose.position[axis] += by;
  } else {
    pose.orientation = (Quaternion(Eigen::AngleAxisd(by, Vector3::Unit(axis - 3))) * pose.orientation).normalized();
  }
  const auto displaced = rod.clone();
  displaced->setPose(held.particle, pose);
  RodEquilibrium equilibrium;
  equilibrium.update(dynamic_cast<const Rod&>(*displaced), 1, exactly());
  EXPECT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0));
  return equilibrium;
}

//! The difference of what `read` writes over a step to both sides.
template <typename Read>
std::vector<double> difference(const Rod& rod, std::size_t hold, int axis, std::size_t size, Read read) {
  const double step = 2e-6;
  std::vector<double> sides[2] = {std::vector<double>(size), std::vector<double>(size)};
  for (int side = 0; side < 2; ++side) {
    read(equilibriumOf(rod, hold, axis, side == 0 ? step : -step), sides[side].data());
  }
  for (std::size_t i = 0; i < size; ++i) {
    sides[0][i] = (sides[0][i] - sides[1][i]) / (2.0 * step);
  }
  return sides[0];
}

class HeldRod : public testing::TestWithParam<Held> {};

TEST_P(HeldRod, exertsInEquilibriumWhatItExertsAtRest) {
  const auto rod = settled(GetParam());
  RodEquilibrium equilibrium;
  equilibrium.update(*rod, 1, exactly());
  ASSERT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0));
  std::vector<double> wrenches(6 * rod->holds().size());
  equilibrium.wrenches(0, wrenches.data());
  for (std::size_t h = 0; h < rod->holds().size(); ++h) {
    const Vector6 simulated = rod->wrench(rod->holds()[h].particle).numbers();
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR(wrenches[6 * h + k], simulated[k], 2e-4 * std::max(1.0, simulated.norm()))
          << "hold " << h << ", component " << k;
    }
  }
}

TEST_P(HeldRod, changesItsWrenchesAsSmallDifferencesDo) {
  const auto rod = settled(GetParam());
  RodEquilibrium equilibrium;
  equilibrium.update(*rod, 1, exactly());
  ASSERT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0));
  const std::size_t holds = rod->holds().size();
  std::vector<double> response(36 * holds * holds);
  equilibrium.wrenchResponse(0, response.data());
  const double largest = std::abs(*std::max_element(response.begin(), response.end()));
  for (std::size_t h = 0; h < holds; ++h) {
    for (int axis = 0; axis < 6; ++axis) {
      const auto expected =
          difference(*rod, h, axis, 6 * holds, [](const RodEquilibrium& e, double* to) { e.wrenches(0, to); });
      for (std::size_t k = 0; k < 6 * holds; ++k) {
        EXPECT_NEAR(response[6 * (k * holds + h) + axis], expected[k], 2e-6 * largest)
            << "hold " << h << ", axis " << axis << ", component " << k;
      }
    }
  }
}

TEST_P(HeldRod, followsTurnsAsSmallDifferencesDo) {
  const auto rod = settled(GetParam());
  RodEquilibrium equilibrium;
  equilibrium.update(*rod, 1, exactly());
  ASSERT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0));
  const std::size_t coordinates = 3 * static_cast<std::size_t>(rod->pointCount());
  std::vector<double> response(3 * coordinates * rod->holds().size());
  equilibrium.turningResponse(0, response.data());
  for (std::size_t h = 0; h < rod->holds().size(); ++h) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto expected =
          difference(*rod, h, 3 + axis, coordinates, [](const RodEquilibrium& e, double* to) { e.points(0, to); });
      for (std::size_t i = 0; i < coordinates; ++i) {
        EXPECT_NEAR(response[3 * (h * coordinates + i) + axis], expected[i], 2e-7)
            << "hold " << h << ", axis " << axis << ", coordinate " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rods, HeldRod,
    testing::Values(
        Held{"clamped", {{0, Hold::CLAMPED}, {27, Hold::CLAMPED}}, Stretch::ZERO, 30e6, 0.4},
        Held{"pole", {{0, Hold::CLAMPED}, {27, Hold::CLAMPED}}, Stretch::ZERO, 3e10, 0.4},
        Held{"pinned", {{0, Hold::PINNED}, {27, Hold::CLAMPED}}, Stretch::ZERO, 1e9, 0.3},
        Held{"three", {{2, Hold::CLAMPED}, {14, Hold::CLAMPED}, {24, Hold::PINNED}}, Stretch::ZERO, 1e9, 0.0},
        Held{"elastic", {{0, Hold::CLAMPED}, {27, Hold::CLAMPED}}, Stretch::FROM_MODULI, 30e6, 0.4},
        Held{"coil",
             {{0, Hold::CLAMPED}, {27, Hold::CLAMPED}},
             Stretch::ZERO,
             30e6,
             0.4,
             {1.0, 0.6, -0.8},
             {{1.0, 0.05}}},
        Held{"bent",
             {{2, Hold::CLAMPED}, {14, Hold::PINNED}, {24, Hold::CLAMPED}},
             Stretch::FROM_MODULI,
             1e9,
             0.0,
             {0.5, 0.3, 0.2},
             {{0.0, 0.1}, {0.7, 0.02}, {2.25, 0.05}}},
        Held{"gripped",
             {{0, Hold::CLAMPED}, {14, Hold::CLAMPED}, {24, Hold::PINNED}},
             Stretch::FROM_MODULI,
             1e9,
             0.0,
             {0.5, 0.3, 0.2},
             {{0.7, 0.02}},
             {{0, 0.03}, {14, 0.05}, {24, {}}}}),
    [](const auto& info) { return std::string(info.param.name); });

//! A long limp chain between level ends.
TEST(Wrench, isThatOfACatenary) {
  RodParameters p = rope(200);
  p.young_modulus = 1e4;
  p.torsion_modulus = 1e4;
  const double length = p.length * (p.segments - 1) / p.segments;
  const double span = 1.8;
  double a = 1.0;  // [m] H / weight per length: 2 a sinh(span / 2 a) = length
  for (int i = 0; i < 100; ++i) {
    const double x = span / (2.0 * a);
    const double f = 2.0 * a * std::sinh(x) - length;
    a -= f / (2.0 * std::sinh(x) - 2.0 * x * std::cosh(x));
  }
  const auto rod = hangingRope(p, span, Hold::PINNED);
  ASSERT_TRUE(rod->settle(settling()));
  RodEquilibrium equilibrium;
  equilibrium.update(*rod, 1, exactly());
  ASSERT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0));
  double wrenches[12];
  equilibrium.wrenches(0, wrenches);
  const double weight = 9.81 * p.segmentMass() / p.segmentLength();  // N/m
  EXPECT_NEAR(wrenches[1], weight * a, 2e-3 * weight * a);
  EXPECT_NEAR(wrenches[2], -0.5 * 9.81 * rod->mass(), 1e-6);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
