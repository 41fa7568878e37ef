#include "evaluation/images/corner_statistics.hpp"

#include "evaluation/statistics.hpp"

namespace window_ingress::evaluation {

using geometry::Quadrilateral;

void CornerStatistics::add(const Quadrilateral& found, const Quadrilateral& truth) {
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    const Eigen::Vector2d error = found[i] - truth[i];
    distances_.push_back(error.norm());
    sum_ += error;
    squares_ += error.cwiseAbs2();
    const Eigen::Vector2d along = (truth[next] - truth[i]).normalized();
    const Eigen::Vector2d out(along.y(), -along.x());
    outward_sum_ += 0.5 * out.dot(error + found[next] - truth[next]);
  }
}

Eigen::Vector2d CornerStatistics::rms() const { return (squares_ / corners()).cwiseSqrt(); }
Eigen::Vector2d CornerStatistics::mean() const { return sum_ / corners(); }
double CornerStatistics::median() const { return quantile(distances_, 0.5); }
double CornerStatistics::worst() const { return quantile(distances_, 1.0); }
double CornerStatistics::outward() const { return outward_sum_ / corners(); }

double meanCornerDistance(const Quadrilateral& a, const Quadrilateral& b) {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += (a[i] - b[i]).norm();
  return 0.25 * sum;
}

}  // namespace window_ingress::evaluation
