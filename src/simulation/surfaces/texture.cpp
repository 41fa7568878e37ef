#include "simulation/surfaces/texture.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace window_ingress::simulation {
namespace {

constexpr int kSize = 512;  // of all images

// Smooth noise with `cells` bumps per side, wrapping around; zero mean, standard deviation near 1. CV_32F.
cv::Mat bumps(cv::RNG& random, int cells) {
  cv::Mat coarse(cells, cells, CV_32F), wrapped, fine;
  random.fill(coarse, cv::RNG::NORMAL, 0.0, 1.4);
  const int border = std::min(2, cells);
  cv::copyMakeBorder(coarse, wrapped, border, border, border, border, cv::BORDER_WRAP);
  const int scale = kSize / cells;
  cv::resize(wrapped, fine, cv::Size(), scale, scale, cv::INTER_CUBIC);
  return fine(cv::Rect(border * scale, border * scale, kSize, kSize)).clone();
}

// Sum of several `bumps`: {cells, amplitude} each.
cv::Mat noise(cv::RNG& random, std::initializer_list<std::pair<int, double>> octaves) {
  cv::Mat sum = cv::Mat::zeros(kSize, kSize, CV_32F);
  for (const auto& [cells, amplitude] : octaves) sum += amplitude * bumps(random, cells);
  return sum;
}

cv::Mat bytes(const cv::Mat& image) {
  cv::Mat result;
  image.convertTo(result, CV_8U);
  return result;
}

// A grey factor for all channels times a tint.
cv::Mat tinted(const cv::Mat& grey, const cv::Scalar& tint = cv::Scalar::all(255)) {
  cv::Mat channels[3], merged;
  for (int c = 0; c < 3; ++c) channels[c] = grey * (tint[c] / 255.0);
  cv::merge(channels, 3, merged);
  return bytes(merged);
}

cv::Mat roughened(cv::RNG& random, const cv::Mat& image, double amplitude) {
  const cv::Mat grey = amplitude * noise(random, {{256, 0.6}, {64, 0.5}, {16, 0.5}});
  cv::Mat rough, sum;
  cv::merge(std::vector<cv::Mat>(3, grey), rough);
  cv::add(image, rough, sum, cv::noArray(), CV_8U);
  return sum;
}

// Random parts with the sum `total`, none below `least`.
std::vector<int> randomParts(cv::RNG& random, int total, int least, int most) {
  std::vector<int> parts;
  for (; total > most; total -= parts.back())
    parts.push_back(std::min(random.uniform(least, most), total - least));
  parts.push_back(total);
  return parts;
}

// A filled rectangle that wraps around at the right border.
void wrappedRectangle(cv::Mat& image, const cv::Rect& rectangle, const cv::Scalar& colour) {
  for (const int shift : {0, -kSize})
    cv::rectangle(image, rectangle + cv::Point(shift, 0), colour, cv::FILLED);
}

// Rows of the same height; `profile` maps 0..1, from lower to upper border, to the brightness.
template <typename Profile>
cv::Mat slats(cv::RNG& random, int rows, double spread, const Profile& profile) {
  cv::Mat image(kSize, kSize, CV_32F);
  const int high = kSize / rows;
  for (int row = 0; row < rows; ++row) {
    const double shade = 1.0 + spread * random.gaussian(1.0);
    for (int y = 0; y < high; ++y) image.row(row * high + y).setTo(shade * profile((y + 0.5) / high));
  }
  return image;
}

// Trees and hedge: a dark band with a ragged upper border around `row`, with bumps `rough` rows high.
cv::Mat treeLine(cv::RNG& random, double row, double rough) {
  cv::Mat mask(kSize, kSize, CV_8U, cv::Scalar(0)), profile = bumps(random, 8) + 0.4 * bumps(random, 32);
  for (int x = 0; x < kSize; ++x) {
    const int top =
        cv::saturate_cast<uchar>((row + rough * profile.at<float>(0, x)) * 255.0 / kSize) * kSize / 255;
    mask.col(x).rowRange(std::min(top, kSize - 1), kSize).setTo(255);
  }
  return mask;
}

// Rough rows of stones with joints; each stone has its own shade, and every other row is shifted by half.
cv::Mat courses(cv::RNG& random, int columns, int rows, double joint_px, double spread,
                const cv::Scalar& stone, const cv::Scalar& joint) {
  cv::Mat image(kSize, kSize, CV_8UC3, joint);
  const double wide = static_cast<double>(kSize) / columns, high = static_cast<double>(kSize) / rows;
  for (int row = 0; row < rows; ++row) {
    for (int column = -1; column < columns; ++column) {
      if (row % 2 == 0 && column < 0) continue;
      const bool last_half = row % 2 == 1 && column == columns - 1;
      cv::RNG own(static_cast<std::uint64_t>(row * 97 + (last_half ? -1 : column) + 1000) * 7919u +
                  random.state);
      const double shade = 1.0 + spread * own.gaussian(1.0);
      const double x = (column + (row % 2) * 0.5) * wide + 0.5 * joint_px, y = row * high + 0.5 * joint_px;
      const cv::Rect2d face(x, y, wide - joint_px, high - joint_px);
      cv::rectangle(image, face & cv::Rect2d(0, 0, kSize, kSize), stone * shade, cv::FILLED);
    }
  }
  return roughened(random, image, 6.0);
}

// Rows of random height with stones of random width and shade.
cv::Mat fieldStone(cv::RNG& random) {
  constexpr int kJoint_px = 6;
  cv::Mat image(kSize, kSize, CV_8UC3, cv::Scalar(172, 166, 156));
  int y = 0;
  for (const int high : randomParts(random, kSize, 34, 72)) {
    int x = random.uniform(0, kSize);
    for (const int wide : randomParts(random, kSize, 48, 130)) {
      const double shade = 1.0 + 0.13 * random.gaussian(1.0), warm = 6.0 * random.gaussian(1.0);
      const cv::Scalar stone(170 * shade + warm, 162 * shade, 148 * shade - warm);
      const cv::Rect face(x % kSize, y + kJoint_px / 2, wide - kJoint_px, high - kJoint_px);
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
  return tinted(boards + 3.0 * noise(random, {{8, 0.5}, {64, 0.6}, {256, 0.6}}));
}

cv::Mat louvres(cv::RNG& random) {
  const auto leaf = [](double up) { return up < 0.12 ? 95.0 : 175.0 + 65.0 * up; };
  const cv::Mat leaves = slats(random, 8, 0.02, leaf);
  return tinted(leaves + 2.0 * noise(random, {{64, 1.0}}));
}

cv::Mat wood(cv::RNG& random) {
  cv::Mat grain(kSize, kSize, CV_32F);
  const cv::Mat warp = bumps(random, 4), fibre = bumps(random, 128);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const double seam = y % (kSize / 8) < 3 ? -60.0 : 0.0;
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
  return tinted(image + noise(random, {{128, 1.5}}));
}

cv::Mat poster(cv::RNG& random) {
  cv::Mat image(kSize, kSize, CV_8UC3, cv::Scalar(235, 225, 200));
  cv::rectangle(image, {0, 0, kSize, 330}, cv::Scalar(90, 150, 205), cv::FILLED);
  cv::circle(image, {380, 100}, 55, cv::Scalar(250, 215, 90), cv::FILLED, cv::LINE_AA);
  for (int hill = 0; hill < 5; ++hill) {
    const cv::Point centre(random.uniform(0, kSize), 330);
    const cv::Size axes(random.uniform(80, 220), random.uniform(50, 170));
    const cv::Scalar green(50 + random.uniform(0, 50), 100 + random.uniform(0, 60), 60);
    cv::ellipse(image, centre, axes, 0, 180, 360, green, cv::FILLED, cv::LINE_AA);
  }
  for (int line = 0; line < 4; ++line)
    cv::rectangle(image, {40, 360 + 36 * line, random.uniform(200, 430), 14}, {60, 50, 50}, cv::FILLED);
  return image;
}

// Print of a room seen through an open window from some metres away: the back wall with its image, and the
// opening's inner faces as a narrow border, lit from the left.
cv::Mat printedWindow(cv::RNG& random, const cv::Mat& picture_on_wall) {
  constexpr int kFace_px = 14, kEnd_px = kSize - kFace_px;
  const cv::Point inner[] = {
      {kFace_px, kFace_px}, {kEnd_px, kFace_px}, {kEnd_px, kEnd_px}, {kFace_px, kEnd_px}};
  const cv::Point outer[] = {{0, 0}, {kSize, 0}, {kSize, kSize}, {0, kSize}};
  const cv::Scalar faces[] = {
      {126, 123, 117}, {182, 178, 169}, {240, 235, 223}, {137, 134, 127}};  // from the top
  cv::Mat image(kSize, kSize, CV_8UC3, cv::Scalar(96, 93, 84)), small;
  for (int side = 0; side < 4; ++side) {
    const int next = (side + 1) % 4;
    const std::vector<cv::Point> face{outer[side], outer[next], inner[next], inner[side]};
    cv::fillConvexPoly(image, face, faces[side], cv::LINE_AA);
  }
  const cv::Rect picture(90, 143, 217, 188);
  cv::rectangle(image, picture - cv::Point(10, 12) + cv::Size(20, 24), {48, 37, 27}, cv::FILLED);
  cv::resize(picture_on_wall, small, picture.size(), 0, 0, cv::INTER_AREA);
  small.convertTo(image(picture), CV_8U, 0.53);
  return roughened(random, image, 2.0);
}

// Sky, trees, lawn: the view through a window on the other side of the house.
cv::Mat gardenView(cv::RNG& random) {
  const cv::Scalar top(200, 222, 252), bottom(238, 244, 252);
  cv::Mat sky(kSize, kSize, CV_32FC3);
  for (int y = 0; y < kSize; ++y) sky.row(y).setTo(top + (bottom - top) * (static_cast<double>(y) / kSize));
  cv::Mat image = bytes(sky);
  image.setTo(cv::Scalar(92, 112, 74), treeLine(random, 270.0, 34.0));
  image.setTo(cv::Scalar(132, 156, 92), treeLine(random, 352.0, 3.0));
  return roughened(random, image, 3.0);
}

// 9 x 7 squares, 8 x 6 inner corners, and a margin as wide as a square.
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

}  // namespace

cv::Mat makeTexture(Texture texture, std::uint32_t seed) {
  cv::RNG random(seed * 1000003u + static_cast<std::uint32_t>(texture) + 1u);
  static const std::map<Texture, cv::Mat (*)(cv::RNG&)> patterns{
      {Texture::kSiding, siding}, {Texture::kStone, fieldStone}, {Texture::kLouvres, louvres},
      {Texture::kWood, wood},     {Texture::kGlass, glass},      {Texture::kCurtain, curtain},
      {Texture::kPoster, poster}, {Texture::kView, gardenView}};
  const auto pattern = patterns.find(texture);
  if (pattern != patterns.end()) return pattern->second(random);
  switch (texture) {
    case Texture::kPlaster:
      return tinted(222.0 + 6.0 * noise(random, {{4, 0.7}, {16, 0.5}, {64, 0.5}, {256, 0.8}}));
    case Texture::kBrick:
      return courses(random, 4, 12, 6.0, 0.10, {190, 96, 70}, {188, 180, 168});
    case Texture::kGrass:
      return tinted(175.0 + 26.0 * noise(random, {{4, 0.5}, {32, 0.6}, {128, 0.7}, {256, 0.8}}),
                    {165, 205, 110});
    case Texture::kPaving:
      return courses(random, 4, 4, 5.0, 0.05, {198, 194, 186}, {120, 118, 110});
    case Texture::kTiles:
      return courses(random, 8, 12, 5.0, 0.09, {178, 86, 62}, {88, 44, 36});
    case Texture::kHedge:
      return tinted(150.0 + 40.0 * noise(random, {{8, 0.5}, {32, 0.7}, {128, 0.7}}), {120, 175, 85});
    case Texture::kPaint:
      return tinted(240.0 + 1.5 * noise(random, {{4, 1.0}, {128, 0.6}}));
    case Texture::kPrintedWindow:
      return printedWindow(random, makeTexture(Texture::kPoster, seed));
    case Texture::kChessboard:
      return chessboard();
    case Texture::kClouds:
      return tinted(232.0 + 14.0 * noise(random, {{4, 0.6}, {8, 0.5}, {16, 0.3}, {32, 0.2}}));
    default:
      return cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(255));
  }
}

double tileSize_m(Texture texture) {
  static const std::map<Texture, double> sizes_m{
      {Texture::kPlaster, 2.0}, {Texture::kPaint, 2.0},  {Texture::kStone, 2.0},  {Texture::kSiding, 1.2},
      {Texture::kLouvres, 0.4}, {Texture::kGrass, 2.5},  {Texture::kPaving, 1.6}, {Texture::kTiles, 2.4},
      {Texture::kHedge, 2.0},   {Texture::kClouds, 60.0}};
  const auto size = sizes_m.find(texture);
  return size == sizes_m.end() ? 1.0 : size->second;
}

}  // namespace window_ingress::simulation
