// Rods that are not straight without load.

#include <gtest/gtest.h>

#include <cmath>

#include "deformable_manipulation/pbd/rod_equilibrium.h"
#include "rod_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

class NaturallyBent : public testing::TestWithParam<RodSolver> {
 protected:
  NaturallyBent() : parameters_(rope()) {
    parameters_.length = 1.4;
    parameters_.solver = GetParam();
    parameters_.natural_shape.curvature = {2.0, -1.0};
    parameters_.natural_shape.twist = 1.5;
  }

  RodParameters parameters_;
};

std::vector<Vector3> pointsOfShape(const Rod& rod) {
  std::vector<Vector3> points(rod.pointCount());
  rod.points(points.front().data());
  return points;
}

double farthest(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, (a[i] - b[i]).norm());
  }
  return most;
}

//! The ends of segments along a helix of a Darboux vector: each turns the next one by the same rotation.
std::vector<Vector3> helix(const RodParameters& p) {
  const double l = p.segmentLength();
  const Vector3 turn = l * Vector3(p.natural_shape.twist, p.natural_shape.curvature[0], p.natural_shape.curvature[1]);
  Eigen::Matrix3d frame = p.pose.orientation.toRotationMatrix();
  std::vector<Vector3> points{Vector3::Zero()};
  for (int i = 0; i < p.segments; ++i) {
    points.push_back(points.back() + l * frame.col(0));
    frame = frame * Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  return points;
}

TEST_P(NaturallyBent, isAHelixWithoutLoad) {
  parameters_.gravity.setZero();
  Rod rod(parameters_);
  EXPECT_LT(farthest(pointsOfShape(rod), helix(parameters_)), 1e-12);
  for (int i = 0; i < 100; ++i) {
    rod.step(0.01, 5);
  }
  EXPECT_LT(farthest(pointsOfShape(rod), helix(parameters_)), 1e-9);
}

TEST_P(NaturallyBent, takesThatShapeFromAnother) {
  parameters_.gravity.setZero();
  parameters_.young_modulus = 3e8;
  parameters_.torsion_modulus = 1e8;
  Rod rod(parameters_);
  rod.hold(0, Hold::CLAMPED);
  rod.hold(27, Hold::CLAMPED, gripAt(parameters_, Vector3(0.1, 0.8, 0.0)));
  rod.layOut();
  rod.settle(settling(20));
  rod.release(27);
  ASSERT_TRUE(rod.settle({0.01, 40, 1e-6, 200.0}));
  EXPECT_LT(farthest(pointsOfShape(rod), helix(parameters_)), 1e-4);
}

TEST_P(NaturallyBent, settlesInTheEquilibrium) {
  Rod rod(parameters_);
  rod.hold(0, Hold::CLAMPED, gripAt(parameters_, Vector3::Zero()));
  rod.hold(27, Hold::CLAMPED, gripAt(parameters_, Vector3(0.1, 0.8, 0.1)));
  rod.layOut();
  const bool direct = GetParam() == RodSolver::DIRECT;
  ASSERT_TRUE(rod.settle({0.01, direct ? 2 : 200, 1e-7, 200.0}));
  RodEquilibrium equilibrium;
  equilibrium.update(rod, 1);
  ASSERT_EQ(equilibrium.status(0), ResponseStatus::VALID) << describe(equilibrium.status(0));
  std::vector<Vector3> shape(rod.pointCount());
  equilibrium.points(0, shape.front().data());
  EXPECT_LT(farthest(pointsOfShape(rod), shape), direct ? 1e-6 : 5e-3);
}

TEST_P(NaturallyBent, movesAllCopiesAlike) {
  Rod rod(parameters_);
  rod.hold(0, Hold::CLAMPED, gripAt(parameters_, Vector3::Zero()));
  rod.hold(27, Hold::CLAMPED, gripAt(parameters_, Vector3(0.1, 0.8, 0.1)));
  rod.layOut();
  rod.addCopy(27, Vector3(0.0, 0.05, 0.0));
  Rod moved(parameters_);
  moved.hold(0, Hold::CLAMPED, gripAt(parameters_, Vector3::Zero()));
  moved.hold(27, Hold::CLAMPED, gripAt(parameters_, Vector3(0.1, 0.85, 0.1)));
  moved.layOut();
  ASSERT_TRUE(moved.settle({0.01, 20, 1e-6, 200.0}));
  ASSERT_TRUE(rod.settle({0.01, 20, 1e-6, 200.0}));
  EXPECT_LT(difference(rod, 1, moved, 0), 1e-4);
}

TEST_P(NaturallyBent, keepsItsTwistInAShapeThatIsSet) {
  Rod rod(parameters_);
  std::vector<double> points;
  for (int i = 0; i < rod.pointCount(); ++i) {
    points.insert(points.end(), {0.0, 0.05 * i, 0.0});
  }
  rod.setShape(points.data());
  std::vector<double> orientations(4 * rod.particleCount());
  rod.orientations(0, orientations.data());
  const Eigen::Map<const Eigen::Vector4d> first(orientations.data());
  const Eigen::Map<const Eigen::Vector4d> second(orientations.data() + 4);
  const Quaternion turn = Quaternion(first).conjugate() * Quaternion(second);
  const Vector3 natural = 0.05 * Vector3(1.5, 2.0, -1.0);
  const Quaternion bent(Eigen::AngleAxisd(natural.norm(), natural.normalized()));
  EXPECT_NEAR(2.0 * std::atan2(turn.x(), turn.w()), 2.0 * std::atan2(bent.x(), bent.w()), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(BothSolvers, NaturallyBent, testing::Values(RodSolver::DIRECT, RodSolver::GAUSS_SEIDEL),
                         [](const testing::TestParamInfo<RodSolver>& info) {
                           return std::string(info.param == RodSolver::DIRECT ? "direct" : "gauss_seidel");
                         });

//! A rod whose natural shape is given by points on a circle is the one of that curvature.
TEST(NaturalPoints, areTheCurvatureThatTheyHave) {
  RodParameters p = rope(40);
  p.gravity.setZero();
  RodParameters by_points = p;
  const double radius = 0.5;
  for (int i = 0; i <= 4000; ++i) {
    const double angle = p.length / radius * i / 4000.0;
    by_points.natural_shape.points.emplace_back(radius * std::sin(angle), radius * (1.0 - std::cos(angle)), 0.0);
  }
  p.natural_shape.curvature = {0.0, 1.0 / radius};
  EXPECT_LT(farthest(pointsOfShape(Rod(by_points)), pointsOfShape(Rod(p))), 1e-3 * p.length);
}

TEST(NaturalShape, isRefusedWhereItIsTooSharp) {
  RodParameters p = rope();
  p.natural_shape.curvature = {0.0, 20.0};
  EXPECT_THROW(Rod{p}, ParameterError);
  p = rope();
  p.natural_shape.points = {Vector3::Zero(), Vector3::Zero()};
  EXPECT_THROW(Rod{p}, ParameterError);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
