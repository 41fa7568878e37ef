#include "evaluation/poses/noisy_borders.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "estimation/planar/image_measurement.hpp"

namespace window_ingress::evaluation {
namespace {

using geometry::Quadrilateral;
using Matrix7d = Eigen::Matrix<double, 7, 7>;
using Vector7d = Eigen::Matrix<double, 7, 1>;

constexpr double kSmallestVariance = 1e-300;

Eigen::Vector3d lineOf(const detection::Edge& edge) {
  return edge.a.homogeneous().cross(edge.b.homogeneous());
}

Eigen::Matrix2d covarianceOf(const detection::Edge& before, const detection::Edge& after) {
  Eigen::Matrix2d normals;
  Eigen::Vector2d variances;
  for (int k = 0; k < 2; ++k) {
    const detection::Edge& edge = k == 0 ? before : after;
    const Eigen::Vector2d along = (edge.b - edge.a).normalized();
    normals.row(k) << -along.y(), along.x();
    const double at_end = 0.5 * (edge.b - edge.a).norm() * edge.sigma_rad;
    variances(k) = edge.sigma_px * edge.sigma_px + at_end * at_end;
  }
  const Eigen::Matrix2d inverse = normals.inverse();
  return inverse * variances.asDiagonal() * inverse.transpose();
}

// Information of all samples between two corners whose shifts by the parameters are `a` and `b`.
Matrix7d informationOfBorder(const Vector7d& a, const Vector7d& b, double length_px, double sigma_px) {
  const Matrix7d mixed = a * b.transpose();
  return length_px / (sigma_px * sigma_px) *
         ((a * a.transpose() + b * b.transpose()) / 3.0 + (mixed + mixed.transpose()) / 6.0);
}

Matrix7d informationOf(const estimation::PredictedOpening& predicted, double sigma_px) {
  Eigen::Matrix<double, 8, 7> by_parameters;
  by_parameters << predicted.by_pose, predicted.by_log_size.col(0);
  Matrix7d information = Matrix7d::Zero();
  for (int i = 0; i < 4; ++i) {
    const int a = 2 * i, b = 2 * ((i + 1) % 4);
    const Eigen::Vector2d side = predicted.corners_px.segment<2>(b) - predicted.corners_px.segment<2>(a);
    const Eigen::Vector2d across = Eigen::Vector2d(-side.y(), side.x()).normalized();
    information +=
        informationOfBorder(by_parameters.middleRows<2>(a).transpose() * across,
                            by_parameters.middleRows<2>(b).transpose() * across, side.norm(), sigma_px);
  }
  return information;
}

double spread(const Eigen::MatrixXd& information, const Eigen::VectorXd& by_parameters) {
  const Eigen::LLT<Eigen::MatrixXd> llt(information);
  if (llt.info() != Eigen::Success) return -1.0;
  return std::sqrt(std::max(kSmallestVariance, by_parameters.dot(llt.solve(by_parameters))));
}

}  // namespace

detection::Edge noisyBorder(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double sample_sigma_px,
                            double offset, double turn) {
  const double length = (b - a).norm();
  const Eigen::Vector2d along = (b - a) / length, across(-along.y(), along.x());
  detection::Edge edge;
  edge.visible = true;
  edge.sigma_px = sample_sigma_px / std::sqrt(length);
  edge.sigma_rad = edge.sigma_px * std::sqrt(12.0) / length;
  const double offset_px = edge.sigma_px * offset, at_end_px = 0.5 * length * edge.sigma_rad * turn;
  edge.a = a + (offset_px - at_end_px) * across;
  edge.b = b + (offset_px + at_end_px) * across;
  return edge;
}

void crossBorders(const detection::Edge& before, const detection::Edge& after, Eigen::Vector2d& corner,
                  Eigen::Matrix2d& covariance) {
  corner = lineOf(before).cross(lineOf(after)).hnormalized();
  covariance = covarianceOf(before, after);
}

std::optional<detection::WindowObservation> noisyBorders(const geometry::PinholeCamera& camera,
                                                         const Eigen::Isometry3d& T_camera_window,
                                                         const geometry::OpeningSize& opening,
                                                         double sample_sigma_px, std::mt19937& random) {
  const auto truth = geometry::projectOpening(camera, T_camera_window, opening);
  if (!truth) return std::nullopt;
  std::normal_distribution<double> normal;
  detection::WindowObservation window;
  for (int i = 0; i < 4; ++i) {
    const double offset = normal(random), turn = normal(random);
    window.edges[i] = noisyBorder((*truth)[i], (*truth)[(i + 1) % 4], sample_sigma_px, offset, turn);
  }
  for (int i = 0; i < 4; ++i)
    crossBorders(window.edges[(i + 3) % 4], window.edges[i], window.corners[i], window.corner_covariance[i]);
  return window;
}

std::optional<PoseBound> poseBound(const geometry::PinholeCamera& camera,
                                   const Eigen::Isometry3d& T_camera_window,
                                   const geometry::OpeningSize& opening, double sample_sigma_px) {
  const auto predicted = estimation::predictOpening(camera, T_camera_window, opening);
  if (!predicted) return std::nullopt;
  const Matrix7d information = informationOf(*predicted, sample_sigma_px);
  const Eigen::Matrix3d R = T_camera_window.linear();
  Vector7d by_yaw = Vector7d::Zero(), by_lateral = Vector7d::Zero();
  by_yaw.segment<3>(3) = R.col(2);
  by_lateral.head<3>() = -R.col(1);
  by_lateral.segment<3>(3) =
      -(R.col(1).transpose() * estimation::skew(T_camera_window.translation())).transpose();
  const Eigen::MatrixXd of_pose = information.topLeftCorner<6, 6>();
  const PoseBound bound{spread(of_pose, by_yaw.head<6>()), spread(of_pose, by_lateral.head<6>()),
                        spread(information, by_yaw)};
  if (!(bound.yaw_rad > 0.0 && bound.lateral_m > 0.0 && bound.sigma_u_rad > 0.0)) return std::nullopt;
  return bound;
}

}  // namespace window_ingress::evaluation
