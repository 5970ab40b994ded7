// Bodies put into measured states, and held points that go to given poses.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "fabric_fixture.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

std::vector<double> pointsOf(const Body& body) {
  std::vector<double> all(3 * body.pointCount() * body.copyCount());
  body.points(all.data());
  all.resize(3 * body.pointCount());
  return all;
}

class RodState : public testing::TestWithParam<RodSolver> {
 protected:
  RodState() {
    RodParameters p = rope();
    p.solver = GetParam();
    rod_ = hangingRope(p, 1.5, Hold::CLAMPED);
    rod_->settle(settling(20));
  }

  std::vector<double> atRest() const { return std::vector<double>(3 * rod_->pointCount(), 0.0); }

  std::unique_ptr<Rod> rod_;
};

TEST_P(RodState, atRestStays) {
  const std::vector<double> points = pointsOf(*rod_);
  auto other = hangingRope(rod_->parameters(), 1.5, Hold::CLAMPED);
  other->setState(points.data(), atRest().data());
  EXPECT_LT(difference(*other, 0, *rod_, 0), 3e-4);  // Gauss-Seidel leaves gaps at rest
  for (int i = 0; i < 100; ++i) {
    other->step(0.01, 20);
  }
  EXPECT_LT(difference(*other, 0, *rod_, 0), 2e-4);
}

TEST_P(RodState, hasTheVelocitiesOfItsPoints) {
  std::vector<double> rates(3 * rod_->pointCount());
  for (int i = 0; i < rod_->pointCount(); ++i) {
    rates[3 * i] = 0.01 * i;  // sideways
  }
  rod_->setState(pointsOf(*rod_).data(), rates.data());
  for (int i = 1; i < 27; ++i) {
    EXPECT_NEAR((velocities(*rod_)[i] - Vector3(0.01 * (i + 0.5), 0.0, 0.0)).norm(), 0.0, 1e-9);
  }
}

TEST_P(RodState, closesTheGapsOfMeasuredLengths) {
  std::vector<double> points = pointsOf(*rod_);
  for (int i = 2; i < 27; ++i) {
    points[3 * i + 2] += i % 2 == 0 ? 0.003 : -0.003;  // the polyline is too long
  }
  rod_->setState(points.data(), atRest().data());
  EXPECT_LT(std::abs(rod_->stretch()), 1e-6);
  EXPECT_LT(positions(*rod_)[0].norm(), 1e-9);  // held
  const std::vector<double> closed = pointsOf(*rod_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(closed[i], points[i], 0.02);
  }
}

TEST_P(RodState, bringsItsCopiesAlong) {
  rod_->addCopy(27, Vector3(0.0, 0.0, 0.05));
  rod_->settle(settling(20));
  std::vector<double> points = pointsOf(*rod_);
  rod_->setState(points.data(), atRest().data());
  EXPECT_LT(difference(*rod_, 1, *rod_, 0), 1e-9);  // undisplaced
  EXPECT_FALSE(rod_->copies()[0].ready());
  rod_->settle(settling(20));
  EXPECT_GT(difference(*rod_, 1, *rod_, 0), 0.04);
}

TEST_P(RodState, isRefusedWhereItIsNone) {
  std::vector<double> points = pointsOf(*rod_);
  const std::vector<Vector3> before = positions(*rod_);
  points[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(rod_->setState(points.data(), atRest().data()), std::invalid_argument);
  points = pointsOf(*rod_);
  std::copy_n(&points[9], 3, &points[12]);
  EXPECT_THROW(rod_->setState(points.data(), atRest().data()), std::invalid_argument);
  EXPECT_EQ(positions(*rod_), before);
}

INSTANTIATE_TEST_SUITE_P(BothSolvers, RodState, testing::Values(RodSolver::DIRECT, RodSolver::GAUSS_SEIDEL),
                         [](const testing::TestParamInfo<RodSolver>& info) {
                           return info.param == RodSolver::DIRECT ? "direct" : "gaussSeidel";
                         });

TEST(FabricState, isThatOfItsVertices) {
  auto fabric = hangingCloth(cloth());
  std::vector<double> points = pointsOf(*fabric);
  for (std::size_t i = 2; i < points.size(); i += 3) {
    points[i] += 0.1;
  }
  const std::vector<double> rates(points.size(), 0.2);
  fabric->setState(points.data(), rates.data());
  EXPECT_EQ(pointsOf(*fabric), points);
  EXPECT_EQ(velocities(*fabric)[7], Vector3::Constant(0.2));
}

TEST(MoveTo, endsAtThePose) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  rod->settle(settling());
  Pose target = rod->held(27).pose;
  for (double angle : {0.3, -3.0, 3.1}) {
    target.position += Vector3(0.01, -0.02, 0.005);
    target.orientation = Quaternion(Eigen::AngleAxisd(angle, Vector3(1.0, 2.0, -1.0).normalized()));
    rod->moveTo(27, target, 0.01);
    rod->step(0.01, 3);
    EXPECT_LT((rod->held(27).pose.position - target.position).norm(), 1e-12);
    EXPECT_LT(rod->held(27).pose.orientation.angularDistance(target.orientation), 1e-7);
  }
}

TEST(MoveTo, refusesWhatCannotBe) {
  auto rod = hangingRope(rope(), 1.5, Hold::CLAMPED);
  EXPECT_THROW(rod->moveTo(3, Pose(), 0.01), std::invalid_argument);
  EXPECT_THROW(rod->moveTo(27, Pose(), 0.0), std::invalid_argument);
  Pose bent;
  bent.orientation.coeffs() *= 2.0;
  EXPECT_THROW(rod->moveTo(27, bent, 0.01), std::invalid_argument);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
