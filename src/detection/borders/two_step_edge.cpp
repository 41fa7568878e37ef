#include "detection/borders/two_step_edge.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace window_ingress::detection {
namespace {

constexpr double kUsualBlur = 0.8, kBlurSpread = 0.15;  // of an image, and its spread [px]
constexpr double kSoftest = 2.0;                        // blur up to which an edge may be two [px]
constexpr double kMinBlur = 0.35, kMaxBlur = 3.0, kMinApart = 0.15, kMaxApart = 4.5;  // of a fit [px]
constexpr double kNoise = 0.35;        // of a mean colour [grey levels]
constexpr double kModelNoise = 0.003;  // model error of a blurred step, relative to its change
constexpr double kBlackest = -5.0, kWhitest = 262.0, kColourSpread = 10.0;  // limits of a reveal's colour
constexpr double kGoodEnough = 5.0;   // mean squared residual up to which one step suffices [noise^2]
constexpr double kFits = 1.2;         // residual of two steps that ends the search [noise^2]
constexpr double kStillGood = 10.0;   // residual of two steps up to which they are accepted [noise^2]
constexpr double kBetter = 0.25;      // of one step's residual: two steps must stay below
constexpr double kWellKnownPx = 0.3;  // standard deviation up to which a front edge is accepted
constexpr double kBesidePx = 1.2;     // a front further out is fitted with more samples outside
constexpr int kFitIterations = 8;
constexpr double kSettled = 0.02;  // part of the residual that one more iteration must remove
constexpr int kMaxEdgeSamples = 2 * kMaxHalfOfEdge + 1, kMaxRests = 3 * kMaxEdgeSamples + 4;

using Params = Eigen::Vector3d;  // front, apart, blur
using Samples = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxEdgeSamples, 3>;
using Rests = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRests, 1>;
using RestSlopes = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxRests, 3>;

// The cumulative normal distribution, from a table.
double step(double z) {
  constexpr double kFrom = -4.0, kPerUnit = 128.0;
  constexpr int kSize = 1024;
  static const std::array<double, kSize + 1> values = [] {
    std::array<double, kSize + 1> made;
    for (int i = 0; i <= kSize; ++i) made[i] = 0.5 * std::erfc(-(kFrom + i / kPerUnit) * M_SQRT1_2);
    return made;
  }();
  const double place = std::clamp((z - kFrom) * kPerUnit, 0.0, kSize - 1.0);
  const int i = static_cast<int>(place);
  return values[i] + (place - i) * (values[i + 1] - values[i]);
}

/// Models the colours between two offsets as one step or two.
struct Model {
  Model(const float* mean, int channels, int half, int first_offset, int last_offset, bool two_steps)
      : first(first_offset), count(last_offset - first + 1), two(two_steps), colours(count, 3) {
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < count; ++k)
        colours(k, c) = mean[(channels == 1 ? 0 : c) * (2 * half + 1) + half + first + k];
    const double change = (colours.colwise().maxCoeff() - colours.colwise().minCoeff()).norm();
    noise = kNoise + kModelNoise * change;
    if (channels == 1) noise *= std::sqrt(3.0);  // the same residual three times
    const int steps = two ? 3 : 2;
    freedom = std::max(1, channels * (count - steps) - steps);
  }

  void rests(const Params& p, Rests& out) const {
    Samples basis(count, 3);
    for (int k = 0; k < count; ++k) {
      const double o = first + k, front = step((o - p[0]) / p[2]);
      basis.row(k) << 1.0, front, two ? step((o - p[0] + p[1]) / p[2]) - front : 0.0;
    }
    Eigen::Matrix3d normal = basis.transpose() * basis;
    normal.diagonal().array() += 1e-9;
    const Eigen::Matrix3d levels = normal.ldlt().solve(basis.transpose() * colours);
    const Samples left = (colours - basis * levels) / noise;
    const int size = 3 * count;
    out.setZero(size + 4);
    for (int c = 0; c < 3; ++c) out.segment(c * count, count) = left.col(c);
    if (!two) return;
    out[size] = (p[2] - kUsualBlur) / kBlurSpread;
    for (int c = 0; c < 3; ++c) {
      const double reveal = levels(0, c) + levels(2, c);
      out[size + 1 + c] = (reveal - std::clamp(reveal, kBlackest, kWhitest)) / kColourSpread;
    }
  }

  int first, count;
  bool two;
  Samples colours;
  double noise, freedom;
};

struct Fit {
  Params params = Params::Zero();
  double rest = 0.0;   // mean square [noise^2]
  double sigma = 0.0;  // of the front
};

void slopesOf(const Model& model, const Params& at, const Rests& rests, RestSlopes& slopes) {
  constexpr double kDifference = 0.02;
  slopes.setZero(rests.size(), 3);
  Rests moved;
  for (int i = 0; i < 3; ++i) {
    if (i == 1 && !model.two) continue;
    Params next = at;
    next[i] += kDifference;
    model.rests(next, moved);
    slopes.col(i) = (moved - rests) / kDifference;
  }
}

Fit fit(const Model& model, const Params& start) {
  Fit best;
  best.params = start;
  Rests rests, tried;
  model.rests(start, rests);
  double cost = rests.squaredNorm(), damping = 1e-2;
  RestSlopes slopes;
  Eigen::Matrix3d normal;
  for (int i = 0; i < kFitIterations; ++i) {
    slopesOf(model, best.params, rests, slopes);
    normal = slopes.transpose() * slopes;
    const Eigen::Vector3d descent = slopes.transpose() * rests;
    Eigen::Matrix3d damped = normal;
    damped.diagonal() += damping * normal.diagonal() + Eigen::Vector3d::Constant(1e-6);
    Params next = best.params - damped.ldlt().solve(descent);
    next[1] = std::clamp(next[1], kMinApart, kMaxApart);
    next[2] = std::clamp(next[2], kMinBlur, kMaxBlur);
    model.rests(next, tried);
    const double then = tried.squaredNorm(), gain = cost - then;
    if (!(gain > 0.0)) {
      damping *= 8.0;
      continue;
    }
    best.params = next, cost = then, rests = tried, damping *= 0.3;
    if (gain < kSettled * cost + kSettled) break;
  }
  best.rest = cost / model.freedom;
  normal.diagonal().array() += 1e-6;
  best.sigma = std::sqrt(std::max(0.0, normal.inverse()(0, 0)) * std::max(1.0, best.rest));
  return best;
}

}  // namespace

TwoStepEdge fitTwoStepEdge(const float* mean, int channels, int half, const TwoStepEdgeLimits& limits) {
  const auto bad = [](float v) { return !std::isfinite(v); };
  if (std::any_of(mean, mean + channels * (2 * half + 1), bad)) return {};
  const Model near(mean, channels, half, -4, 2, true), far(mean, channels, half, -3, 4, true);
  const Fit one = fit(Model(mean, channels, half, -3, 2, false), {0.0, 1.0, kUsualBlur});
  if (one.rest < kGoodEnough || one.params[2] > kSoftest) return {};
  Fit best;
  best.rest = best.sigma = 1e9;
  for (const auto& [model, front, apart] : std::array<std::tuple<const Model*, double, double>, 4>{
           {{&near, 0.0, 0.7}, {&near, 0.0, 2.0}, {&near, 1.0, 1.0}, {&far, 2.0, 2.0}}}) {
    if (model == &far && front > limits.farthest_px + 1.0) continue;
    const Fit two = fit(*model, {front, apart, kUsualBlur});
    if (two.params[0] < limits.nearest_px || two.params[0] > limits.farthest_px) continue;
    if (model == &near && two.params[0] > kBesidePx) continue;
    if (two.sigma < kWellKnownPx ? best.sigma > kWellKnownPx || two.rest < best.rest
                                 : best.sigma > kWellKnownPx && two.rest < best.rest)
      best = two;
    if (best.rest < kFits && best.sigma < kWellKnownPx) break;
  }
  if (best.rest > kBetter * one.rest) return {};
  const double moved = std::abs(best.params[0] - one.params[0]);
  if (best.rest > kStillGood || best.sigma > kWellKnownPx) return {0.0, 0.0, 0.5 * std::min(2.0, moved)};
  return {best.params[0], best.params[1], std::min(best.sigma, moved)};
}

}  // namespace window_ingress::detection
