#include "detection/alignment/homography_sums.hpp"

#include <Eigen/LU>
#include <cmath>

namespace window_ingress::detection {
namespace {

/// A signed monomial; sign 0 means no term.
struct Term {
  int x, y;
  float sign;
};

// By how much each of the eight parameters moves a point in x and in y.
constexpr Term kInX[8] = {{1, 0, 1.0F}, {0, 1, 1.0F}, {0, 0, 1.0F},  {0, 0, 0.0F},
                          {0, 0, 0.0F}, {0, 0, 0.0F}, {2, 0, -1.0F}, {1, 1, -1.0F}};
constexpr Term kInY[8] = {{0, 0, 0.0F}, {0, 0, 0.0F}, {0, 0, 0.0F},  {1, 0, 1.0F},
                          {0, 1, 1.0F}, {0, 0, 1.0F}, {1, 1, -1.0F}, {0, 2, -1.0F}};

constexpr int placeOf(int x, int y) { return (x + y) * (x + y + 1) / 2 + y; }

template <typename Sums>
float termOf(const Sums& sums, const Term& p, const Term& q) {
  return p.sign * q.sign * sums[placeOf(p.x + q.x, p.y + q.y)];
}

}  // namespace

Monomials monomialsOf(float x, float y) {
  Monomials m;
  m << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y,  // up to degree three
      x * x * x * x, x * x * x * y, x * x * y * y, x * y * y * y, y * y * y * y, 0;
  return m;
}

std::optional<Eigen::Matrix3d> homographyOf(const Vector8f& p) {
  if (!p.allFinite()) return std::nullopt;
  Eigen::Matrix3d change = Eigen::Matrix3d::Identity();
  change.row(0) += Eigen::RowVector3f(p[0], p[1], p[2]).cast<double>();
  change.row(1) += Eigen::RowVector3f(p[3], p[4], p[5]).cast<double>();
  change(2, 0) += p[6], change(2, 1) += p[7];
  if (!(std::abs(change.determinant()) > 0.1)) return std::nullopt;
  return change;
}

// Local copies of the sums stay in registers during the loop.
void DerivativeSum::add(const float* monomials, const float* slopes_a, const float* slopes_b, int count) {
  Eigen::Array<float, 8, 1> sum_a = a, sum_b = b;
  for (int i = 0; i < count; ++i, monomials += 16) {
    const Eigen::Map<const Eigen::Array<float, 8, 1>> m(monomials);
    sum_a += slopes_a[i] * m, sum_b += slopes_b[i] * m;
  }
  a = sum_a, b = sum_b;
}

void NormalSum::add(const float* monomials, const float* slopes_aa, const float* slopes_ab,
                    const float* slopes_bb, int count) {
  Monomials sum_aa = aa, sum_ab = ab, sum_bb = bb;
  for (int i = 0; i < count; ++i, monomials += 16) {
    const Eigen::Map<const Monomials> m(monomials);
    sum_aa += slopes_aa[i] * m, sum_ab += slopes_ab[i] * m, sum_bb += slopes_bb[i] * m;
  }
  aa = sum_aa, ab = sum_ab, bb = sum_bb;
}

Vector8f DerivativeSum::vector() const {
  constexpr Term one{0, 0, 1.0F};
  Vector8f v;
  for (int k = 0; k < 8; ++k) v[k] = termOf(a, kInX[k], one) + termOf(b, kInY[k], one);
  return v;
}

Matrix8f NormalSum::matrix() const {
  Matrix8f m;
  for (int k = 0; k < 8; ++k)
    for (int l = 0; l < 8; ++l)
      m(k, l) = termOf(aa, kInX[k], kInX[l]) + termOf(ab, kInX[k], kInY[l]) + termOf(ab, kInY[k], kInX[l]) +
                termOf(bb, kInY[k], kInY[l]);
  return m;
}

}  // namespace window_ingress::detection
