// Fabrics come to rest, whatever they are made of and however long the substeps are.

#include <gtest/gtest.h>

#include <limits>
#include <ostream>

#include "fabric_fixture.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

//! A square cloth of 2 m, held at its corners.
struct HungCloth {
  int particles;      // along each side
  double stretching;  // m/N, compliance
  double rigidity;    // N m, of bending
  double density;     // kg/m^2
  double part;        // of its size: distance of its corners
  int substeps;       // of 10 ms
};

std::ostream& operator<<(std::ostream& to, const HungCloth& c) {
  return to << c.particles << " particles, " << c.stretching << " m/N, " << c.rigidity << " N m, " << c.density
            << " kg/m^2, " << c.part << ", " << c.substeps << " substeps";
}

class FabricAtRest : public testing::TestWithParam<HungCloth> {};

TEST_P(FabricAtRest, isReached) {
  const HungCloth& c = GetParam();
  const int n = c.particles;
  FabricParameters p = sheet(n, n, 2.0 / (n - 1));
  p.stretching_compliance = c.stretching;
  p.bending_compliance = c.rigidity > 0.0 ? 1.0 / c.rigidity : std::numeric_limits<double>::infinity();
  p.density = c.density;
  const auto fabric = hangingFabric(p, {0, n - 1, n * (n - 1), n * n - 1}, c.part);
  SettleOptions options = settling();
  options.substeps = c.substeps;
  EXPECT_TRUE(fabric->settle(options));
}

// Each of them moved for ever, or came apart, with less compliance or with more adaptation of the rest lengths.
INSTANTIATE_TEST_SUITE_P(StiffEdges, FabricAtRest,
                         testing::Values(HungCloth{30, 1e-4, 1e-3, 1.0, 0.9, 5},
                                         HungCloth{30, 1e-4, 1e-3, 1.0, 0.9, 10},
                                         HungCloth{30, 1e-4, 1e-3, 1.0, 0.9, 20},
                                         HungCloth{25, 6.5e-6, 1.9e-3, 2.3, 0.9, 33},
                                         HungCloth{40, 2.1e-5, 3.4e-4, 1.8, 0.8, 5}));
INSTANTIATE_TEST_SUITE_P(Limp, FabricAtRest,
                         testing::Values(HungCloth{40, 1.76e-4, 1.1e-4, 0.45, 0.9, 10},
                                         HungCloth{20, 0.0, 0.0, 1.0, 0.9, 10},
                                         HungCloth{15, 0.0, 1e-5, 0.1, 0.6, 20}));
INSTANTIATE_TEST_SUITE_P(StiffFolds, FabricAtRest,
                         testing::Values(HungCloth{40, 0.0, 0.97, 0.144, 0.99, 5},
                                         HungCloth{30, 6.4e-5, 0.024, 1.55, 0.6, 5},
                                         HungCloth{20, 1e-6, 1.0, 0.1, 1.0, 5}));
INSTANTIATE_TEST_SUITE_P(Soft, FabricAtRest,
                         testing::Values(HungCloth{15, 1e-2, 1e-3, 0.3, 0.9, 10},
                                         HungCloth{8, 1e-3, 1e-3, 1.0, 1.02, 33}));

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
