#include "simulation/surfaces/texture_patterns.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace window_ingress::simulation {
namespace {

// Random parts with the sum `total`, none below `least`.
std::vector<int> randomParts(cv::RNG& random, int total, int least, int most) {
  std::vector<int> parts;
  int left = total;
  while (left > most) {
    const int part = std::min(random.uniform(least, most), left - least);
    parts.push_back(part);
    left -= part;
  }
  parts.push_back(left);
  return parts;
}

// A filled rectangle that wraps around at the right border.
void wrappedRectangle(cv::Mat& image, const cv::Rect& rectangle, const cv::Scalar& colour) {
  for (const int shift : {0, -kTextureSize})
    cv::rectangle(image, cv::Rect(rectangle.x + shift, rectangle.y, rectangle.width, rectangle.height),
                  colour, cv::FILLED);
}

// Rows of the same height; `profile` maps 0..1, from lower to upper border, to the brightness.
template <typename Profile>
cv::Mat slats(cv::RNG& random, int rows, double spread, const Profile& profile) {
  cv::Mat image(kTextureSize, kTextureSize, CV_32F);
  const int high = kTextureSize / rows;
  for (int row = 0; row < rows; ++row) {
    const double shade = 1.0 + spread * random.gaussian(1.0);
    for (int y = 0; y < high; ++y) image.row(row * high + y).setTo(shade * profile((y + 0.5) / high));
  }
  return image;
}

constexpr int kSize = kTextureSize;

// Trees and hedge as a dark band with a ragged upper border around `row`; `rough`: height of its bumps in
// rows.
cv::Mat treeLine(cv::RNG& random, double row, double rough) {
  cv::Mat mask(kSize, kSize, CV_8U, cv::Scalar(0)), profile = bumps(random, 8) + 0.4 * bumps(random, 32);
  for (int x = 0; x < kSize; ++x) {
    const int top =
        cv::saturate_cast<uchar>((row + rough * profile.at<float>(0, x)) * 255.0 / kSize) * kSize / 255;
    mask.col(x).rowRange(std::min(top, kSize - 1), kSize).setTo(255);
  }
  return mask;
}

cv::Mat verticalGradient(const cv::Scalar& top, const cv::Scalar& bottom) {
  cv::Mat image(kSize, kSize, CV_32FC3);
  for (int y = 0; y < kSize; ++y) image.row(y).setTo(top + (bottom - top) * (static_cast<double>(y) / kSize));
  return image;
}

cv::Mat bytes(const cv::Mat& image) {
  cv::Mat result;
  image.convertTo(result, CV_8U);
  return result;
}

}  // namespace

cv::Mat courses(cv::RNG& random, int columns, int rows, double joint_px, double spread,
                const cv::Scalar& stone, const cv::Scalar& joint) {
  cv::Mat image(kTextureSize, kTextureSize, CV_8UC3, joint);
  const double wide = static_cast<double>(kTextureSize) / columns,
               high = static_cast<double>(kTextureSize) / rows;
  for (int row = 0; row < rows; ++row) {
    for (int column = -1; column < columns; ++column) {
      if (row % 2 == 0 && column < 0) continue;
      const bool last_half = row % 2 == 1 && column == columns - 1;
      cv::RNG own(static_cast<std::uint64_t>(row * 97 + (last_half ? -1 : column) + 1000) * 7919u +
                  random.state);
      const double shade = 1.0 + spread * own.gaussian(1.0);
      const double x = (column + (row % 2) * 0.5) * wide + 0.5 * joint_px, y = row * high + 0.5 * joint_px;
      cv::rectangle(
          image,
          cv::Rect2d(x, y, wide - joint_px, high - joint_px) & cv::Rect2d(0, 0, kTextureSize, kTextureSize),
          stone * shade, cv::FILLED);
    }
  }
  return image;
}

// Rows of random height with stones of random width and shade.
cv::Mat fieldStone(cv::RNG& random) {
  constexpr int kJoint_px = 6;
  cv::Mat image(kTextureSize, kTextureSize, CV_8UC3, cv::Scalar(172, 166, 156)), soft;
  int y = 0;
  for (const int high : randomParts(random, kTextureSize, 34, 72)) {
    int x = random.uniform(0, kTextureSize);
    for (const int wide : randomParts(random, kTextureSize, 48, 130)) {
      const double shade = 1.0 + 0.13 * random.gaussian(1.0), warm = 6.0 * random.gaussian(1.0);
      const cv::Scalar stone(170 * shade + warm, 162 * shade, 148 * shade - warm);
      const cv::Rect face(x % kTextureSize, y + kJoint_px / 2, wide - kJoint_px, high - kJoint_px);
      wrappedRectangle(image, face, stone * 0.86);
      wrappedRectangle(image, {face.x + 2, face.y + 3, face.width - 4, face.height - 4}, stone);
      x += wide;
    }
    y += high;
  }
  return roughened(random, image, 9.0);
}

// Lapped boards: each casts a narrow shadow on the one below.
cv::Mat siding(cv::RNG& random) {
  const cv::Mat boards = slats(random, 8, 0.012, [](double up) {
    if (up > 0.95) return 150.0;
    return up < 0.05 ? 246.0 : 232.0 - 10.0 * up;
  });
  return tinted(boards + 3.0 * noise(random, {{8, 0.5}, {64, 0.6}, {256, 0.6}}), {255, 255, 255});
}

cv::Mat louvres(cv::RNG& random) {
  const cv::Mat leaves =
      slats(random, 8, 0.02, [](double up) { return up < 0.12 ? 95.0 : 175.0 + 65.0 * up; });
  return tinted(leaves + 2.0 * noise(random, {{64, 1.0}}), {255, 255, 255});
}

cv::Mat wood(cv::RNG& random) {
  cv::Mat grain(kTextureSize, kTextureSize, CV_32F);
  const cv::Mat warp = bumps(random, 4), fibre = bumps(random, 128);
  for (int y = 0; y < kTextureSize; ++y)
    for (int x = 0; x < kTextureSize; ++x) {
      const double seam = y % (kTextureSize / 8) < 3 ? -60.0 : 0.0;
      const double ring = 12.0 * std::sin(2.0 * M_PI * y / 32.0 + 2.0 * warp.at<float>(y, x));
      grain.at<float>(y, x) = static_cast<float>(205.0 + ring + seam + 6.0 * fibre.at<float>(y, x));
    }
  return tinted(grain, {255, 235, 215});
}

// A pane: a dim room, curtains at both sides, and over both the reflection of sky and garden.
cv::Mat glass(cv::RNG& random) {
  cv::Mat image(kSize, kSize, CV_32FC3);
  const cv::Mat garden = treeLine(random, 300.0, 26.0);
  for (int y = 0; y < kSize; ++y) {
    const double sky = std::pow(1.0 - static_cast<double>(y) / kSize, 1.5);
    for (int x = 0; x < kSize; ++x) {
      const double aside = std::abs(x - 0.5 * kSize) / (0.5 * kSize);
      const double fold = aside > 0.62 ? 90.0 + 25.0 * std::sin(x * 0.19) : 0.0;
      const double streak = std::abs(x + y - 600) < 55 ? 28.0 : 0.0;
      const double reflected = garden.at<uchar>(y, x) ? 0.0 : 24.0;
      image.at<cv::Vec3f>(y, x) =
          cv::Vec3f(static_cast<float>(38 + 70 * sky + fold + streak + 0.7 * reflected),
                    static_cast<float>(46 + 90 * sky + fold + streak + 0.9 * reflected),
                    static_cast<float>(50 + 115 * sky + 0.9 * fold + streak + 1.1 * reflected));
    }
  }
  return bytes(image);
}

cv::Mat curtain(cv::RNG& random) {
  cv::Mat image(kSize, kSize, CV_32F);
  const cv::Mat sway = bumps(random, 4);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const double phase = 2.0 * M_PI * x / 46.0 + 0.8 * sway.at<float>(y, x);
      const double gap = std::abs(x - kSize / 2) < 3 ? -70.0 : 0.0;
      image.at<float>(y, x) =
          static_cast<float>(205.0 + 34.0 * std::sin(phase) + 10.0 * std::sin(2.3 * phase) + gap);
    }
  return tinted(image + noise(random, {{128, 1.5}}), {255, 255, 255});
}

cv::Mat poster(cv::RNG& random) {
  cv::Mat image(kTextureSize, kTextureSize, CV_8UC3, cv::Scalar(235, 225, 200));
  cv::rectangle(image, {0, 0, kTextureSize, 330}, cv::Scalar(90, 150, 205), cv::FILLED);
  cv::circle(image, {380, 100}, 55, cv::Scalar(250, 215, 90), cv::FILLED, cv::LINE_AA);
  for (int hill = 0; hill < 5; ++hill) {
    const cv::Point centre(random.uniform(0, kTextureSize), 330),
        axes(random.uniform(80, 220), random.uniform(50, 170));
    const cv::Scalar green(50 + random.uniform(0, 50), 100 + random.uniform(0, 60), 60);
    cv::ellipse(image, centre, axes, 0, 180, 360, green, cv::FILLED, cv::LINE_AA);
  }
  for (int line = 0; line < 4; ++line) {
    const cv::Rect words(40, 360 + 36 * line, random.uniform(200, 430), 14);
    cv::rectangle(image, words, cv::Scalar(60, 50, 50), cv::FILLED);
  }
  return image;
}

// Print of a room seen through an open window from some metres away: the back wall with its image, and the
// opening's inner faces as a narrow border, lit from the left.
cv::Mat printedWindow(cv::RNG& random, const cv::Mat& picture_on_wall) {
  constexpr int kFace_px = 14;
  const cv::Point inner[] = {{kFace_px, kFace_px},
                             {kSize - kFace_px, kFace_px},
                             {kSize - kFace_px, kSize - kFace_px},
                             {kFace_px, kSize - kFace_px}};
  const cv::Point outer[] = {{0, 0}, {kSize, 0}, {kSize, kSize}, {0, kSize}};
  const cv::Scalar faces[] = {
      {126, 123, 117}, {182, 178, 169}, {240, 235, 223}, {137, 134, 127}};  // from the top
  cv::Mat image(kSize, kSize, CV_8UC3, cv::Scalar(96, 93, 84));
  for (int side = 0; side < 4; ++side) {
    const int next = (side + 1) % 4;
    const std::vector<cv::Point> face{outer[side], outer[next], inner[next], inner[side]};
    cv::fillConvexPoly(image, face, faces[side], cv::LINE_AA);
  }
  const cv::Rect picture(90, 143, 217, 188);
  cv::rectangle(image, {picture.x - 10, picture.y - 12, picture.width + 20, picture.height + 24},
                {48, 37, 27}, cv::FILLED);
  cv::Mat small;
  cv::resize(picture_on_wall, small, picture.size(), 0, 0, cv::INTER_AREA);
  small.convertTo(image(picture), CV_8U, 0.53);
  return roughened(random, image, 2.0);
}

// Sky, trees, lawn: the view through a window on the other side of the house.
cv::Mat gardenView(cv::RNG& random) {
  cv::Mat image = bytes(verticalGradient({200, 222, 252}, {238, 244, 252}));
  image.setTo(cv::Scalar(92, 112, 74), treeLine(random, 270.0, 34.0));
  image.setTo(cv::Scalar(132, 156, 92), treeLine(random, 352.0, 3.0));
  return roughened(random, image, 3.0);
}

cv::Mat chessboard() {
  constexpr int kColumns = 11, kRows = 9;
  cv::Mat squares(kRows, kColumns, CV_8UC3, cv::Scalar::all(235)), fine, image;
  for (int row = 1; row + 1 < kRows; ++row)
    for (int column = 1; column + 1 < kColumns; ++column)
      if ((row + column) % 2 == 0) squares.at<cv::Vec3b>(row, column) = {25, 25, 25};
  cv::resize(squares, fine, {kColumns * 64, kRows * 64}, 0, 0, cv::INTER_NEAREST);
  cv::resize(fine, image, {kSize, kSize}, 0, 0, cv::INTER_AREA);
  return image;
}

}  // namespace window_ingress::simulation
