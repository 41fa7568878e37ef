#include "simulation/camera/lens.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace window_ingress::simulation {
namespace {

using geometry::PinholeCamera;

constexpr double kInverseTolerance_px = 1e-3;
constexpr int kMargin_px = 2;

bool isFisheye(const PinholeCamera& camera) { return camera.model == geometry::LensModel::kEquidistant; }

[[noreturn]] void refuse(const PinholeCamera& camera, const std::string& why) {
  const std::string names = isFisheye(camera) ? "k1, k2, k3, k4" : "k1, k2, p1, p2, k3";
  throw std::invalid_argument("camera: distortion " + names + " " + why);
}

// Ideal pixel of each distorted pixel, and which distorted pixels the lens does not see (255).
struct IdealPixels {
  cv::Mat map, unseen;
};

IdealPixels idealPixels(const PinholeCamera& camera) {
  IdealPixels ideal{cv::Mat(camera.height, camera.width, CV_32FC2),
                    cv::Mat::zeros(camera.height, camera.width, CV_8U)};
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d pixel(u, v), point = camera.undistort(pixel), back = camera.distort(point);
      const bool undone = point.allFinite() && (back - pixel).norm() <= kInverseTolerance_px;
      const Eigen::Vector2d middle(camera.cx, camera.cy);
      const bool beyond = isFisheye(camera) && (back - middle).norm() < (pixel - middle).norm();
      if (!undone && !beyond) refuse(camera, "cannot be undone at the image's border");
      ideal.unseen.at<unsigned char>(v, u) = undone ? 0 : 255;
      ideal.map.at<cv::Vec2f>(v, u) = {static_cast<float>(point.x()), static_cast<float>(point.y())};
    }
  return ideal;
}

using Bounds = Eigen::AlignedBox2d;

// A camera with `ideal`'s focal lengths, just large enough for `bounds` (its pixels plus `origin`).
PinholeCamera around(const Bounds& bounds, PinholeCamera ideal, cv::Vec2f& origin) {
  const Eigen::Vector2d first = bounds.min().array().floor() - kMargin_px;
  ideal.cx -= first.x();
  ideal.cy -= first.y();
  ideal.width = static_cast<int>(std::ceil(bounds.max().x()) - first.x()) + kMargin_px + 1;
  ideal.height = static_cast<int>(std::ceil(bounds.max().y()) - first.y()) + kMargin_px + 1;
  origin = {static_cast<float>(first.x()), static_cast<float>(first.y())};
  return ideal;
}

constexpr std::size_t kFaces = 5;

// Rotations from the optical frame to the faces ahead, right, left, below and above.
std::array<Eigen::Matrix3d, kFaces> cube() {
  const auto turned = [](double angle_rad, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix().transpose().eval();
  };
  const Eigen::Vector3d right = Eigen::Vector3d::UnitX(), down = Eigen::Vector3d::UnitY();
  return {Eigen::Matrix3d::Identity(), turned(M_PI_2, down), turned(-M_PI_2, down), turned(-M_PI_2, right),
          turned(M_PI_2, right)};
}

std::size_t faceOf(const Eigen::Vector3d& ray) {
  const double x = ray.x(), y = ray.y();
  if (std::max(std::abs(x), std::abs(y)) <= ray.z()) return 0;
  return std::abs(x) >= std::abs(y) ? (x > 0.0 ? 1 : 2) : (y > 0.0 ? 3 : 4);
}

// Converts `map` to face coordinates; returns each face's part in use, and in `face_of` the face per pixel.
std::array<Bounds, kFaces> spreadOverCube(const PinholeCamera& ideal, const cv::Mat& unseen, cv::Mat& map,
                                          cv::Mat& face_of) {
  const auto faces = cube();
  std::array<Bounds, kFaces> bounds;
  face_of.create(map.size(), CV_8U);
  for (int v = 0; v < map.rows; ++v)
    for (int u = 0; u < map.cols; ++u) {
      if (unseen.at<unsigned char>(v, u) != 0) continue;
      auto& point = map.at<cv::Vec2f>(v, u);
      const Eigen::Vector3d ray((point[0] - ideal.cx) / ideal.fx, (point[1] - ideal.cy) / ideal.fy, 1.0);
      const std::size_t face = faceOf(ray);
      const Eigen::Vector3d seen = faces[face] * ray;
      point = {static_cast<float>(ideal.fx * seen.x() / seen.z() + ideal.cx),
               static_cast<float>(ideal.fy * seen.y() / seen.z() + ideal.cy)};
      face_of.at<unsigned char>(v, u) = static_cast<unsigned char>(face);
      bounds[face].extend(Eigen::Vector2d(point[0], point[1]));
    }
  return bounds;
}

// Converts `map` to pixels of the ideal image, which is just large enough for the returned planes.
std::vector<IdealPlane> planesOfCube(const PinholeCamera& ideal, const cv::Mat& unseen, cv::Mat& map) {
  cv::Mat face_of;
  const auto bounds = spreadOverCube(ideal, unseen, map, face_of);
  const auto faces = cube();
  std::vector<IdealPlane> planes;
  std::array<cv::Vec2f, kFaces> origins;
  int rows = 0;
  for (std::size_t face = 0; face < kFaces; ++face) {
    if (bounds[face].isEmpty()) continue;
    const PinholeCamera camera = around(bounds[face], ideal, origins[face]);
    planes.push_back({camera, faces[face], cv::Rect(0, rows, camera.width, camera.height)});
    origins[face][1] -= static_cast<float>(rows);
    rows += camera.height;
  }
  for (int v = 0; v < map.rows; ++v)
    for (int u = 0; u < map.cols; ++u)
      if (unseen.at<unsigned char>(v, u) == 0)
        map.at<cv::Vec2f>(v, u) -= origins[face_of.at<unsigned char>(v, u)];
  return planes;
}

}  // namespace

Lens::Lens(const PinholeCamera& camera) : size_(camera.width, camera.height) {
  const Eigen::Matrix3d ahead = Eigen::Matrix3d::Identity();
  if (!camera.hasDistortion()) {
    planes_ = {{camera, ahead, cv::Rect({}, size_)}};
    ideal_size_ = size_;
    return;
  }
  IdealPixels pixels = idealPixels(camera);
  Bounds bounds;
  for (const auto& point : cv::Mat_<cv::Vec2f>(pixels.map))
    bounds.extend(Eigen::Vector2d(point[0], point[1]));
  cv::Vec2f origin;
  const PinholeCamera whole = around(bounds, camera.withoutDistortion(), origin);
  if (whole.width <= 2 * camera.width && whole.height <= 2 * camera.height) {
    pixels.map -= cv::Scalar(origin[0], origin[1]);
    planes_ = {{whole, ahead, cv::Rect(0, 0, whole.width, whole.height)}};
  } else if (isFisheye(camera)) {
    planes_ = planesOfCube(camera.withoutDistortion(), pixels.unseen, pixels.map);
  } else {
    refuse(camera, "is too strong for this field of view");
  }
  if (cv::countNonZero(pixels.unseen) > 0) unseen_ = pixels.unseen;
  for (const IdealPlane& plane : planes_) {
    ideal_size_.width = std::max(ideal_size_.width, plane.part.br().x);
    ideal_size_.height = std::max(ideal_size_.height, plane.part.br().y);
  }
  cv::convertMaps(pixels.map, cv::noArray(), map_, map_fraction_, CV_16SC2);
}

void Lens::distort(const cv::Mat& ideal_image, cv::Mat& image) const {
  if (map_.empty()) {
    image = ideal_image;
    return;
  }
  cv::remap(ideal_image, image, map_, map_fraction_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  if (!unseen_.empty()) image.setTo(cv::Scalar::all(0), unseen_);
}

}  // namespace window_ingress::simulation
