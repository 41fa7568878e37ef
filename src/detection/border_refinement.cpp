#include "window_ingress/detection/border_refinement.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "window_ingress/detection/robust_line.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNominalSide =
    640.0;  ///< longer side of a picture up to which pixel parameters hold as they are
constexpr double kFaintestChange =
    3.0;                             ///< of the mean colour over two pixels that may be an edge [grey levels]
constexpr double kNarrowPx = 0.8;    ///< prior of an edge beside stronger ones
constexpr double kWidePx = 1e3;      ///< no prior
constexpr double kFaintPart = 0.05;  ///< or this part of the largest one near it

/// Pixels by bilinear interpolation; three channels always, grey repeated.
class Sampler {
 public:
  explicit Sampler(const cv::Mat& image) : image_(image), channels_(image.channels()) {}

  bool contains(const Vector2d& p) const {
    return p.x() >= 0.0 && p.y() >= 0.0 && p.x() < image_.cols - 1 && p.y() < image_.rows - 1;
  }
  Vector3d at(const Vector2d& p) const {
    const int x = static_cast<int>(p.x()), y = static_cast<int>(p.y());
    const double u = p.x() - x, v = p.y() - y;
    const uchar* top = image_.ptr<uchar>(y) + x * channels_;
    const uchar* bottom = image_.ptr<uchar>(y + 1) + x * channels_;
    Vector3d value;
    for (int c = 0; c < channels_; ++c)
      value[c] = (1 - v) * ((1 - u) * top[c] + u * top[c + channels_]) +
                 v * ((1 - u) * bottom[c] + u * bottom[c + channels_]);
    if (channels_ == 1) value.setConstant(value[0]);
    return value;
  }

 private:
  const cv::Mat& image_;
  int channels_;
};

/// One side while it is being fitted.
class Side {
 public:
  Side(const Sampler& sampler, const geometry::PinholeCamera* camera, const BorderRefinementParams& params,
       const Vector2d& a, const Vector2d& b)
      : sampler_(sampler), camera_(camera), params_(params), length_((b - a).norm()) {
    const Vector2d along = (b - a) / length_;
    line_.point = 0.5 * (a + b);
    line_.normal = Vector2d(along.y(), -along.x());
    start_ = line_;
  }

  bool run(const BorderStart& start) {
    chooseEdge(start.radius_px, start.choice);
    const bool nearest = start.choice == EdgeChoice::kNearest;
    const double reach_px = nearest ? start.radius_px : params_.final_radius_px;
    measure(reach_px, nearest ? 0.6 * reach_px : kNarrowPx);
    if (!fit(std::max(params_.outlier_px, 0.35 * reach_px))) return false;
    measure(params_.final_radius_px, nearest ? kWidePx : kNarrowPx);
    if (!fit(params_.outlier_px) || strays(shifted_) > reach_px) return false;
    stray_px_ = strays(start_);
    fitted_ = stray_px_ <= start.max_stray_px;
    return fitted_;
  }
  bool fitted() const { return fitted_; }
  // The start as an answer; the less certain the further off the edge that was found and not believed.
  Line start(double sigma_px) const {
    Line line = start_;
    sigma_px = std::hypot(sigma_px, 0.5 * stray_px_);
    line.sigma_px = sigma_px;
    line.sigma_rad = sigma_px * std::sqrt(12.0) / length_;
    return line;
  }
  const Line& line() const { return line_; }
  double inliers() const { return inliers_; }

 private:
  // How far an end of the fitted line is from another line.
  double strays(const Line& from) const {
    double worst = 0.0;
    for (double t : {-0.5, 0.5}) {
      const Vector2d end = from.point + t * length_ * Vector2d(-from.normal.y(), from.normal.x());
      worst = std::max(worst, std::abs(line_.distance(end)));
    }
    return worst;
  }
  int profiles() const {
    return std::clamp(static_cast<int>(length_ * (1.0 - 2.0 * params_.skip)), 4, params_.samples);
  }
  Vector2d along() const { return {-line_.normal.y(), line_.normal.x()}; }
  Vector2d foot(int i) const {
    const double t = -0.5 + params_.skip + (1.0 - 2.0 * params_.skip) * (i + 0.5) / profiles();
    return line_.point + t * length_ * along();
  }

  // Colours across the line at `foot`, one pixel apart; false if it leaves the image.
  bool profile(const Vector2d& foot, int reach, std::vector<Vector3d>& values) const {
    values.clear();
    for (int o = -reach - 1; o <= reach + 1; ++o) {
      const Vector2d ideal = foot + o * line_.normal;
      const Vector2d pixel = camera_ ? camera_->distort(ideal) : ideal;
      if (!sampler_.contains(pixel)) return false;
      values.push_back(sampler_.at(pixel));
    }
    return true;
  }

  // Where the side as a whole changes, and the direction in colour space in which it does.
  void chooseEdge(double radius_px, EdgeChoice choice) {
    const int reach = static_cast<int>(std::ceil(radius_px));
    std::vector<Vector3d> mean(2 * reach + 3, Vector3d::Zero()), values, changes;
    int count = 0;
    for (int i = 0; i < profiles(); ++i) {
      if (!profile(foot(i), reach, values)) continue;
      for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += values[k];
      ++count;
    }
    for (int o = -reach; o <= reach; ++o)
      changes.push_back((mean[o + reach + 2] - mean[o + reach]) / std::max(1, count));
    const int at = choice == EdgeChoice::kNearest ? strongest(changes, radius_px)
                                                  : first(changes, choice == EdgeChoice::kFirstInward);
    colour_ = changes[at].norm() > 0.0 ? changes[at].normalized() : colour_;
    if (choice != EdgeChoice::kNearest) line_.point += (at - reach) * line_.normal;
    shifted_ = line_;
  }

  static int strongest(const std::vector<Vector3d>& changes, double radius_px) {
    const int reach = static_cast<int>(changes.size()) / 2;
    int at = reach;
    double best = 0.0;
    for (int k = 0; k < static_cast<int>(changes.size()); ++k) {
      const double weight = changes[k].norm() * std::exp(-0.5 * std::pow((k - reach) / (0.6 * radius_px), 2));
      if (weight > best) best = weight, at = k;
    }
    return at;
  }

  // The first change that stands out, from the last element on if `inward`, else from the first on.
  static int first(const std::vector<Vector3d>& changes, bool inward) {
    const int count = static_cast<int>(changes.size());
    double largest = 0.0;
    for (const Vector3d& change : changes) largest = std::max(largest, change.norm());
    const double limit = std::max(kFaintestChange, kFaintPart * largest);
    for (int n = 0; n < count; ++n) {
      const int k = inward ? count - 1 - n : n, next = inward ? k - 1 : k + 1;
      const bool falls = next < 0 || next >= count || changes[next].norm() <= changes[k].norm();
      if (changes[k].norm() > limit && falls) return k;
    }
    return count / 2;
  }

  void measure(double radius_px, double prior_px) {
    const int reach = static_cast<int>(std::ceil(radius_px));
    points_.clear();
    std::vector<Vector3d> values;
    for (int i = 0; i < profiles(); ++i)
      if (profile(foot(i), reach, values)) measureOne(foot(i), values, reach, prior_px);
  }

  void measureOne(const Vector2d& foot, const std::vector<Vector3d>& values, int reach, double prior_px) {
    const auto slope = [&](int o) { return 0.5 * colour_.dot(values[o + reach + 2] - values[o + reach]); };
    double best = 0.0;
    int at = 0;
    for (int o = -reach; o <= reach; ++o) {
      const double weight = slope(o) * std::exp(-0.5 * o * o / (prior_px * prior_px));
      if (weight > best) best = weight, at = o;
    }
    if (best < 0.5 || std::abs(at) == reach) return;
    points_.push_back(foot + (at + peak(slope(at - 1), slope(at), slope(at + 1))) * line_.normal);
  }

  // Offset of the maximum of a bell curve through three equidistant values, the middle one the largest.
  static double peak(double left, double middle, double right) {
    const double floor = 0.02 * middle;
    const double l = std::log(std::max(left, floor)), m = std::log(middle),
                 r = std::log(std::max(right, floor));
    const double curvature = l - 2.0 * m + r;
    return curvature < -1e-9 ? std::clamp(0.5 * (l - r) / curvature, -1.0, 1.0) : 0.0;
  }

  // Line through the points, and its spread.
  bool fit(double scale_px) {
    inliers_ = 0.0;
    if (points_.size() < 4) return false;
    fitRobustLine(points_, scale_px, line_);
    const LineSpread spread = spreadAbout(line_, points_, scale_px);
    inliers_ = static_cast<double>(spread.inliers) / profiles();
    if (spread.inliers < 4 || inliers_ < params_.min_inliers) return false;
    const double spacing_px = length_ / profiles();
    const double independent = std::max(2.0, spread.inliers * std::min(1.0, spacing_px / 1.5) - 2.0);
    line_.sigma_px =
        std::hypot(params_.sigma_floor_px, std::sqrt(spread.sum_of_squares / spread.inliers / independent));
    line_.sigma_rad = line_.sigma_px * std::sqrt(12.0) / length_;
    return true;
  }

  const Sampler& sampler_;
  const geometry::PinholeCamera* camera_;
  const BorderRefinementParams& params_;
  double length_;
  Line line_, start_, shifted_;
  bool fitted_ = false;
  double stray_px_ = 0.0;
  Vector3d colour_ = Vector3d(1, 1, 1) / std::sqrt(3.0);
  std::vector<Vector2d> points_;
  double inliers_ = 0.0;
};

bool intersect(const Line& a, const Line& b, Vector2d& corner) {
  Matrix2d normals;
  normals << a.normal.transpose(), b.normal.transpose();
  if (std::abs(normals.determinant()) < 0.1) return false;
  corner = normals.inverse() * Vector2d(a.normal.dot(a.point), b.normal.dot(b.point));
  return true;
}

double sigmaAt(const Line& line, const Vector2d& corner) {
  return std::hypot(line.sigma_px, line.sigma_rad * (corner - line.point).norm());
}

Matrix2d cornerCovariance(const Line& a, const Line& b, const Vector2d& corner) {
  Matrix2d normals, spread = Matrix2d::Zero();
  normals << a.normal.transpose(), b.normal.transpose();
  spread.diagonal() << std::pow(sigmaAt(a, corner), 2), std::pow(sigmaAt(b, corner), 2);
  const Matrix2d inverse = normals.inverse();
  return inverse * spread * inverse.transpose();
}

// Canonical order again: a corner may have become the first by a fraction of a pixel.
void startAtTopLeft(RefinedBorders& borders) {
  const auto first = std::min_element(borders.corners.begin(), borders.corners.end(),
                                      [](const Vector2d& a, const Vector2d& b) { return a.sum() < b.sum(); });
  const auto shift = first - borders.corners.begin();
  std::rotate(borders.corners.begin(), borders.corners.begin() + shift, borders.corners.end());
  std::rotate(borders.corner_covariance.begin(), borders.corner_covariance.begin() + shift,
              borders.corner_covariance.end());
  std::rotate(borders.edges.begin(), borders.edges.begin() + shift, borders.edges.end());
}

bool finish(const std::array<Line, 4>& lines, const geometry::PinholeCamera* camera,
            RefinedBorders& borders) {
  for (int i = 0; i < 4; ++i) {
    const Line &before = lines[(i + 3) % 4], &after = lines[i];
    Vector2d corner = Vector2d::Zero();
    if (!intersect(before, after, corner)) return false;
    borders.corner_covariance[i] = cornerCovariance(before, after, corner);
    borders.corners[i] = camera ? camera->distort(corner) : corner;
    borders.edges[i] = {true, after.sigma_px, after.sigma_rad};
  }
  if (!geometry::isFinite(borders.corners) || !geometry::isConvex(borders.corners)) return false;
  startAtTopLeft(borders);
  return true;
}

}  // namespace

std::optional<RefinedBorders> BorderRefinement::run(const cv::Mat& image, const BorderStart& start,
                                                    const geometry::PinholeCamera* camera,
                                                    double* worst_inliers) const {
  const geometry::Quadrilateral& quad = start.quad;
  const Sampler sampler(image);
  BorderRefinementParams params = params_;
  const double scale = std::max(1.0, std::max(image.cols, image.rows) / kNominalSide);
  params.final_radius_px *= scale;
  params.outlier_px *= scale;
  const geometry::PinholeCamera* lens = camera && camera->hasDistortion() ? camera : nullptr;
  std::array<Line, 4> lines;
  RefinedBorders borders;
  borders.worst_inliers = 1.0;
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    const Vector2d a = lens ? lens->undistort(quad[i]) : quad[i];
    const Vector2d b = lens ? lens->undistort(quad[(i + 1) % 4]) : quad[(i + 1) % 4];
    good = (b - a).norm() > 4.0;
    if (!good) break;
    Side side(sampler, lens, params, a, b);
    good = side.run(start) || start.fallback_sigma_px > 0.0;
    lines[i] = side.fitted() ? side.line() : side.start(start.fallback_sigma_px);
    borders.worst_inliers = std::min(borders.worst_inliers, side.inliers());
  }
  if (worst_inliers) *worst_inliers = borders.worst_inliers;
  if (!good || !finish(lines, lens, borders)) return std::nullopt;
  return borders;
}

}  // namespace window_ingress::detection
