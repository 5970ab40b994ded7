// How a fabric moves, hangs and is held.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "deformable_manipulation/pbd/errors.h"
#include "deformable_manipulation/pbd/simulation.h"
#include "fabric_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

std::vector<Vector3> pointsOf(const Body& body) { return positions(body); }

double area(const FabricParameters& p) {
  double sum = 0.0;
  for (const Triangle& t : p.triangles) {
    sum += 0.5 * (p.vertices[t[1]] - p.vertices[t[0]]).cross(p.vertices[t[2]] - p.vertices[t[0]]).norm();
  }
  return sum;
}

TEST(Fabric, hasTheMassOfItsArea) {
  const FabricParameters p = cloth();
  EXPECT_NEAR(Fabric(p).mass(), p.density * area(p), 1e-12);
  EXPECT_NEAR(Fabric(p).mass(), 4.0, 1e-12);
}

TEST(Fabric, beginsAtItsPose) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.pose = {Vector3(1.0, 2.0, 3.0), Quaternion(Eigen::AngleAxisd(0.7, Vector3::UnitY()))};
  const Fabric fabric(p);
  const std::vector<Vector3> vertices = pointsOf(fabric);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    EXPECT_LT((vertices[i] - p.pose.position - p.pose.orientation * p.vertices[i]).norm(), 1e-14);
  }
  EXPECT_NEAR(fabric.stretch(), 0.0, 1e-14);
}

TEST(Fabric, settlesBetweenItsCorners) {
  for (double compliance : {0.0, 1e-5, 1e-4}) {
    FabricParameters p = cloth();
    p.stretching_compliance = compliance;
    const auto fabric = hangingCloth(p);
    EXPECT_TRUE(fabric->settle(smallSubsteps())) << compliance;
    EXPECT_LT(std::abs(fabric->stretch()), 0.01) << compliance;
  }
}

TEST(Fabric, settlesWithNoBendingStiffness) {
  FabricParameters p = cloth();
  p.bending_compliance = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(hangingCloth(p)->settle(smallSubsteps()));
}

TEST(Fabric, carriesItsWeightAtItsHolds) {
  const auto fabric = hangingCloth(cloth());
  ASSERT_TRUE(fabric->settle(smallSubsteps()));
  fabric->step(0.01, 10);
  Vector3 sum = Vector3::Zero();
  for (const HeldPoint& held : fabric->holds()) {
    const Wrench wrench = fabric->wrench(held.particle);
    EXPECT_EQ(wrench.torque, Vector3::Zero());
    sum += wrench.force;
  }
  const double weight = 9.81 * fabric->mass();
  EXPECT_LT((sum - Vector3(0.0, 0.0, -weight)).norm(), 1e-3 * weight);
}

TEST(Fabric, hangsFromOneHold) {
  const FabricParameters p = cloth();
  for (int particle : {0, 112, 224}) {
    const auto fabric = hangingFabric(p, {particle}, 1.0);
    EXPECT_NEAR(fabric->stretch(), 0.0, 1e-9);
    for (int step = 0; step < 1500; ++step) {  // limp folds swing for long
      fabric->step(0.01, 5);
    }
    Vector3 mean = Vector3::Zero();
    for (const Vector3& vertex : pointsOf(*fabric)) {
      mean += vertex / fabric->particleCount();
      EXPECT_LT(vertex.z(), p.vertices[particle].z() + 0.3);
    }
    const Vector3 arm = mean - p.vertices[particle];
    EXPECT_LT(std::hypot(arm.x(), arm.y()), 0.05) << particle;
    EXPECT_LT(arm.z(), -0.3) << particle;
  }
}

TEST(Fabric, keepsItsShapeWhenCarried) {
  const auto fabric = hangingCloth(cloth());
  ASSERT_TRUE(fabric->settle(smallSubsteps()));
  const std::vector<Vector3> rest = pointsOf(*fabric);
  const Vector3 velocity(0.06, -0.07, 0.04);
  for (const HeldPoint& held : fabric->holds()) {
    fabric->setTwist(held.particle, {velocity, Vector3::Zero()});
  }
  for (int step = 0; step < 1000; ++step) {
    fabric->step(0.01, 10);
  }
  const std::vector<Vector3> carried = pointsOf(*fabric);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    EXPECT_LT((carried[i] - rest[i] - 10.0 * velocity).norm(), 1e-3) << i;
  }
}

TEST(Fabric, fallsFreely) {
  FabricParameters p = sheet(6, 5, 0.1);
  p.bending_compliance = 10.0;
  Fabric fabric(p);
  fabric.hold(7, Hold::PINNED);  // sets it swinging and folding
  for (int step = 0; step < 60; ++step) {
    fabric.step(0.01, 5);
  }
  fabric.release(7);
  // Momentum by the masses, which are the reactions' weights: corner, edge and inner vertices.
  const auto momenta = [&] {
    std::vector<double> masses(p.vertices.size(), 0.0);
    for (const Triangle& t : p.triangles) {
      for (int vertex : t) {
        masses[vertex] += p.density * 0.005 / 3.0;
      }
    }
    const std::vector<Vector3> x = positions(fabric);
    const std::vector<Vector3> v = velocities(fabric);
    Vector3 centre = Vector3::Zero(), momentum = Vector3::Zero(), spin = Vector3::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
      centre += masses[i] * x[i] / fabric.mass();
      momentum += masses[i] * v[i];
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      spin += masses[i] * (x[i] - centre).cross(v[i]);
    }
    return std::make_pair(momentum, spin);
  };
  const auto before = momenta();
  ASSERT_GT(before.second.norm(), 1e-3);
  for (int step = 0; step < 100; ++step) {
    fabric.step(0.01, 20);
  }
  const auto after = momenta();
  EXPECT_LT((after.first - before.first - fabric.mass() * p.gravity).norm(), 1e-9 * fabric.mass());
  EXPECT_LT((after.second - before.second).norm(), 0.02 * before.second.norm());
}

TEST(Fabric, holdsAreTakenAndReleasedWhileRunning) {
  const auto fabric = hangingCloth(cloth());
  fabric->step(0.01, 10);
  fabric->release(224);
  fabric->addCopy(0, Vector3(0.0, 0.0, 0.05));
  for (int step = 0; step < 50; ++step) {
    fabric->step(0.01, 10);
  }
  EXPECT_LT(positions(*fabric)[224].z(), -0.05);
  const Vector3 caught = positions(*fabric)[100];
  fabric->hold(100, Hold::CLAMPED);
  fabric->step(0.01, 10);
  EXPECT_EQ(positions(*fabric)[100], caught);
  EXPECT_NEAR((positions(*fabric, 1)[100] - caught).norm(), 0.0, 1e-12);
  EXPECT_NEAR((positions(*fabric, 1)[0] - positions(*fabric)[0] - Vector3(0.0, 0.0, 0.05)).norm(), 0.0, 1e-12);
}

TEST(Fabric, forgetsHowItWasSqueezed) {
  FabricParameters p = sheet(4, 3, 0.1);
  p.stretching_compliance = 0.0;
  Fabric fabric(p);
  fabric.hold(5, Hold::PINNED);
  fabric.hold(6, Hold::PINNED, {p.vertices[6] - Vector3(0.02, 0.0, 0.0), Quaternion::Identity()});
  for (int step = 0; step < 200; ++step) {
    fabric.step(0.01, 10);
  }
  fabric.release(6);
  for (int step = 0; step < 20; ++step) {
    fabric.step(0.01, 10);
  }
  EXPECT_NEAR((positions(fabric)[6] - positions(fabric)[5]).norm(), 0.1, 1e-3);
}

TEST(Fabric, measuresFreeLengthsAlongItsSurface) {
  const Fabric flat(cloth());
  EXPECT_NEAR(flat.freeLength(0, 224), 2.0 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(flat.freeLength(3, 17), (flat.parameters().vertices[17] - flat.parameters().vertices[3]).norm(), 1e-12);
  FabricParameters p = sheet(9, 5, 0.1);
  for (Vector3& vertex : p.vertices) {  // bent into a gutter, without stretching
    const double angle = vertex.x() / 0.4;
    vertex = Vector3(0.4 * std::sin(angle), vertex.y(), 0.4 * std::cos(angle));
  }
  const Fabric bent(p);
  const double chord = 2.0 * 0.4 * std::sin(0.125);
  EXPECT_NEAR(bent.freeLength(0, 8), 8.0 * chord, 1e-12);
  EXPECT_GE(bent.freeLength(0, 44), std::hypot(8.0 * chord, 0.4) - 1e-12);
  EXPECT_LT(bent.freeLength(0, 44), 1.06 * std::hypot(8.0 * chord, 0.4));
  EXPECT_NEAR(bent.freeLength(0, 44), bent.freeLength(44, 0), 1e-12);
}

TEST(Fabric, hasItsFreeLengthAfterAHoldToo) {
  FabricParameters p = sheet(9, 5, 0.1);
  p.vertices[20].z() += 0.05;
  Fabric fabric(p);
  const double before = fabric.freeLength(2, 40);
  fabric.hold(40, Hold::PINNED);
  EXPECT_NEAR(fabric.freeLength(2, 40), before, 1e-12);
  EXPECT_NEAR(fabric.freeLength(40, 2), before, 1e-12);
}

TEST(Fabric, changesItsMaterialWhileRunning) {
  const auto fabric = hangingCloth(cloth());
  ASSERT_TRUE(fabric->settle(smallSubsteps()));
  const double before = positions(*fabric)[112].z();
  fabric->setMaterial({{"stretching_compliance", 5e-3}});
  ASSERT_TRUE(fabric->settle(smallSubsteps()));
  EXPECT_LT(positions(*fabric)[112].z(), before - 0.01);
}

TEST(Fabric, isCarriedByASimulation) {
  const FabricParameters p = cloth();
  std::vector<Agent> agents;
  for (int particle : {0, 14, 210, 224}) {
    agents.push_back({"agent_" + std::to_string(particle),
                      particle,
                      Hold::CLAMPED,
                      {0.9 * p.vertices[particle], Quaternion::Identity()}});
  }
  Simulation simulation(std::make_unique<Fabric>(p), agents, {{1, Vector3(0.0, 0.0, 0.1)}}, {0.01, 10, 1});
  EXPECT_EQ(simulation.rest(), Rest::STABLE);
  std::vector<double> response(4 * 9 * 225);
  ASSERT_EQ(simulation.response(response.data()), ResponseStatus::VALID);
  for (int k = 0; k < 9; ++k) {  // moved by all agents alike, the middle moves as they do
    double sum = 0.0;
    for (int agent = 0; agent < 4; ++agent) {
      sum += response[9 * (225 * agent + 112) + k];
    }
    EXPECT_NEAR(sum, k % 4 == 0 ? 1.0 : 0.0, 1e-9);
  }
  simulation.setCommand(0, {Vector3(0.1, 0.0, 0.0), Vector3::Zero()});
  for (int cycle = 0; cycle < 20; ++cycle) {
    simulation.advance();
  }
  EXPECT_NEAR((simulation.pose(0).position - Vector3(0.02, 0.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(Fabric, copiesAreTheFabricWithADisplacedHold) {
  const FabricParameters p = cloth();
  const auto together = hangingCloth(p);
  std::vector<std::unique_ptr<Fabric>> separate;
  for (int i = 0; i < 9; ++i) {  // more than one group of lanes
    const Vector3 displacement(0.01 * std::cos(i), 0.03 * std::sin(i), 0.02 + 0.005 * i);
    together->addCopy(224, displacement);
    separate.push_back(hangingCloth(p));
    separate.back()->addCopy(224, displacement);
  }
  for (int step = 0; step < 30; ++step) {
    together->step(0.01, 5);
    for (auto& fabric : separate) {
      fabric->step(0.01, 5);
    }
  }
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(difference(*together, i + 1, *separate[i], 1), 0.0) << "copy " << i + 1;
  }
}

TEST(Fabric, threadsDoNotChangeTheResult) {
  FabricParameters p = cloth();
  const auto one = hangingCloth(p);
  p.threads = 2;
  const auto two = hangingCloth(p);
  for (Fabric* fabric : {one.get(), two.get()}) {
    for (int i = 0; i < 12; ++i) {
      fabric->addCopy(0, Vector3(0.0, 0.0, 0.01 * (i + 1)));
    }
    fabric->step(0.1, 40);
  }
  for (int copy = 0; copy < 13; ++copy) {
    EXPECT_EQ(difference(*one, copy, *two, copy), 0.0);
  }
}

TEST(Fabric, movesAlikeInOneCallAndInSeveral) {
  FabricParameters p = cloth();
  p.damping = 0.0;  // rest lengths, which adapt once per call, stay
  for (int substeps : {3, 4, 20}) {
    const auto at_once = hangingCloth(p);
    const auto one_by_one = at_once->clone();
    at_once->step(0.001 * substeps, substeps);
    for (int i = 0; i < substeps; ++i) {
      one_by_one->step(0.001, 1);
    }
    EXPECT_LT(difference(*at_once, 0, *one_by_one, 0), 1e-9) << substeps << " substeps";
  }
}

TEST(Fabric, clonesAreIndependentAndEqual) {
  const auto fabric = hangingCloth(cloth());
  fabric->step(0.01, 5);
  const auto clone = fabric->clone();
  fabric->step(0.01, 5);
  EXPECT_GT(difference(*fabric, 0, *clone, 0), 1e-6);
  clone->step(0.01, 5);
  EXPECT_EQ(difference(*fabric, 0, *clone, 0), 0.0);
}

TEST(Fabric, reportsAStateThatIsNotFinite) {
  Fabric fabric(sheet(3, 3, 0.1));
  fabric.hold(4, Hold::PINNED, {Vector3(1e200, 0.0, 0.0), Quaternion::Identity()});
  EXPECT_THROW(
      {
        for (int step = 0; step < 10; ++step) {
          fabric.step(0.01, 2);
        }
      },
      NonFiniteState);
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
