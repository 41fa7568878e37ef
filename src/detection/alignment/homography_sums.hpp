#pragma once

#include <Eigen/Core>
#include <optional>

namespace window_ingress::detection {

/// Monomials of x and y up to degree four, lower degrees first. The 16th entry is 0.
using Monomials = Eigen::Array<float, 16, 1>;
Monomials monomialsOf(float x, float y);

using Vector8f = Eigen::Matrix<float, 8, 1>;
using Matrix8f = Eigen::Matrix<float, 8, 8>;

/// Sum over points of an image's derivatives by the eight parameters of a homography near the identity,
/// (1 + p0, p1, p2; p3, 1 + p4, p5; p6, p7, 1). Each derivative is the image's slope (a, b) times polynomials
/// of the point's coordinates. So sums of slopes times monomials suffice: 8 per component for a vector and 48
/// for the normal equations, whatever the number of channels.
struct DerivativeSum {
  Eigen::Array<float, 8, 1> a = Eigen::Array<float, 8, 1>::Zero(), b = Eigen::Array<float, 8, 1>::Zero();

  /// \param monomials 16 per point \param count number of points
  void add(const float* monomials, const float* slopes_a, const float* slopes_b, int count);
  Vector8f vector() const;
};

/// The homography 1 + P of these parameters; nothing if it is not near the identity.
std::optional<Eigen::Matrix3d> homographyOf(const Vector8f& p);

/// Sum of the derivatives' outer products.
struct NormalSum {
  Monomials aa = Monomials::Zero(), ab = Monomials::Zero(), bb = Monomials::Zero();

  void add(const float* monomials, const float* slopes_aa, const float* slopes_ab, const float* slopes_bb,
           int count);
  Matrix8f matrix() const;
};

}  // namespace window_ingress::detection
