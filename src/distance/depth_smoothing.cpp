#include "deformable_manipulation/distance/depth_smoothing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "box_tree.h"

namespace deformable_manipulation {
namespace distance {
namespace {

constexpr int kHalf = 2;                 // pixels of the window to each side
constexpr int kLanes = 4;                // pixels at a time
constexpr float kLeast = 12.0F;          // neighbours with a depth, of 24
constexpr float kMostVariance = 2.0F;    // of the neighbours about their plane, in variances of the noise
constexpr float kMostDeviations = 5.0F;  // of a pixel from the plane of its neighbours

FourFloats load(const float* from) {
  FourFloats four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

void store(const FourFloats& four, float* to) { std::memcpy(to, &four, sizeof four); }

//! Inverse depths [1/m] with a border of pixels that have none.
class InverseDepths {
 public:
  InverseDepths(const float* depths, int rows, int columns)
      : width_(columns + 2 * kHalf + kLanes), values_((rows + 2 * kHalf) * width_, 0.0F), known_(values_) {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const float depth = depths[static_cast<std::size_t>(row) * columns + column];
        const bool known = depth > 0.0F && std::isfinite(depth) && std::isfinite(1.0F / depth);
        values_[place(row, column)] = known ? 1.0F / depth : 0.0F;
        known_[place(row, column)] = known ? 1.0F : 0.0F;
      }
    }
  }

  //! Of four pixels in a row, which may be out of the image.
  FourFloats values(int row, int column) const { return load(&values_[place(row, column)]); }
  //! 1 where there is a depth, 0 elsewhere.
  FourFloats known(int row, int column) const { return load(&known_[place(row, column)]); }

 private:
  std::size_t place(int row, int column) const { return (row + kHalf) * width_ + column + kHalf; }

  std::size_t width_;
  std::vector<float> values_, known_;
};

//! Sums over the neighbours of a pixel, of four pixels: places u, v in columns and rows from the pixel, and how much q
//! the inverse depth is more than its own.
struct Sums {
  FourFloats n = {}, u = {}, v = {}, q = {}, uu = {}, uv = {}, vv = {}, uq = {}, vq = {}, qq = {};
};

Sums sumsAround(const InverseDepths& image, int row, int column) {
  const FourFloats own = image.values(row, column);
  Sums sums;
  for (int dv = -kHalf; dv <= kHalf; ++dv) {
    for (int du = -kHalf; du <= kHalf; ++du) {
      if (du == 0 && dv == 0) {
        continue;
      }
      const float u = static_cast<float>(du), v = static_cast<float>(dv);
      const FourFloats known = image.known(row + dv, column + du);
      const FourFloats q = known * (image.values(row + dv, column + du) - own);
      sums.n += known;
      sums.u += u * known;
      sums.v += v * known;
      sums.uu += u * u * known;
      sums.uv += u * v * known;
      sums.vv += v * v * known;
      sums.q += q;
      sums.uq += u * q;
      sums.vq += v * q;
      sums.qq += q * q;
    }
  }
  return sums;
}

//! How much [1/m] the inverse depths of four pixels are to be changed; 0 where noise does not explain their neighbours.
FourFloats changes(const Sums& sums, float noise) {
  const FourFloats zero = {}, one = zero + 1.0F;
  const FourFloats n = larger(sums.n, one);
  const FourFloats u = sums.u / n, v = sums.v / n, q = sums.q / n;  // means
  const FourFloats uu = sums.uu - sums.u * u, uv = sums.uv - sums.u * v, vv = sums.vv - sums.v * v,
                   uq = sums.uq - sums.u * q, vq = sums.vq - sums.v * q, qq = sums.qq - sums.q * q;
  const FourFloats determinant = uu * vv - uv * uv, divisor = determinant > 1.0F ? determinant : one;
  const FourFloats along_u = (vv * uq - uv * vq) / divisor, along_v = (uu * vq - uv * uq) / divisor;
  const FourFloats plane = q - along_u * u - along_v * v;    // at the pixel itself
  const FourFloats left = qq - along_u * uq - along_v * vq;  // sum of the neighbours' squares about it
  const FourFloats doubt = one / n + (vv * u * u - 2.0F * uv * u * v + uu * v * v) / divisor;  // variances of the noise
  const FourFloats most = kMostVariance * noise * noise * (n - 3.0F);
  const auto explained = (determinant > 1.0F) & (sums.n >= kLeast) & (doubt < 0.5F) & (left <= most) &
                         (absolute(plane) <= kMostDeviations * noise);
  return explained ? plane / (one + doubt) : zero;
}

}  // namespace

void smoothDepths(const float* depths, int rows, int columns, double noise, float* factors) {
  const InverseDepths image(depths, rows, columns);
  std::vector<float> row_factors(columns + kLanes);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; column += kLanes) {
      const FourFloats own = image.values(row, column), known = image.known(row, column), one = known * 0.0F + 1.0F;
      const FourFloats smooth = own + changes(sumsAround(image, row, column), static_cast<float>(noise));
      store((known > 0.0F) & (smooth > 0.0F) ? own / smooth : one, &row_factors[column]);
    }
    std::copy_n(row_factors.begin(), columns, factors + static_cast<std::ptrdiff_t>(row) * columns);
  }
}

}  // namespace distance
}  // namespace deformable_manipulation
