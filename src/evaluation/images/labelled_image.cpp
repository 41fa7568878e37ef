#include "evaluation/images/labelled_image.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "evaluation/csv.hpp"
#include "evaluation/images/truth_comparison.hpp"
#include "evaluation/output_file.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

constexpr double kOverlapPart = 0.05;  // of the merit: one more found image counts more

// A video's neighbours differ in their last digit.
std::string groupOf(const std::string& file) {
  std::string stem = std::filesystem::path(file).stem().string();
  if (!stem.empty() && std::isdigit(static_cast<unsigned char>(stem.back()))) stem.pop_back();
  return stem;
}

using Targets = std::vector<geometry::Quadrilateral>;

// Reads annotations by the names of their columns. \return the targets of each file
std::map<std::string, Targets> annotationsIn(const std::string& csv_file) {
  CsvReader rows(csv_file);
  std::map<std::string, std::size_t> column;
  for (std::size_t i = 0; i < rows.columns().size(); ++i) column[rows.columns()[i]] = i;
  for (const char* needed : {"file", "x1", "y1", "x2", "y2", "x3", "y3", "x4", "y4"})
    if (column.count(needed) == 0) rows.fail("no column '" + std::string(needed) + "'");
  const auto number = [&](const std::string& name) {
    const double value = rows.number(column[name]);
    if (!std::isfinite(value)) rows.fail("'" + rows.text(column[name]) + "' is not a number");
    return value;
  };
  std::map<std::string, Targets> targets;
  while (rows.next()) {
    const bool is_left_out =
        column.count("label") > 0 && rows.text(column["label"]).rfind("pose_only_", 0) == 0;
    if (rows.line().empty() || is_left_out) continue;
    Targets& of_file = targets[rows.text(column["file"])];
    if (rows.text(column["x1"]).empty()) continue;
    geometry::Quadrilateral quad;
    for (int i = 0; i < 4; ++i)
      quad[i] = {number("x" + std::to_string(i + 1)), number("y" + std::to_string(i + 1))};
    const auto canonical = geometry::canonical(quad);
    if (!canonical) rows.fail("the corners are not a convex quadrilateral");
    of_file.push_back(*canonical);
  }
  return targets;
}

std::string rate(const char* name, int part, int all) {
  if (all == 0) return std::string(name) + " unknown (0 of 0)";
  const auto [low, high] = wilson95(part, all);
  return formatted("%s %.1f %% (%.1f to %.1f %%, %d of %d)", name, 100.0 * (static_cast<double>(part) / all),
                   100.0 * low, 100.0 * high, part, all);
}

}  // namespace

double DetectionCounts::f1() const {
  const int all = 2 * found + missed + wrong;
  return all == 0 ? 1.0 : 2.0 * found / all;
}

double DetectionCounts::merit() const { return f1() + kOverlapPart * overlap / std::max(1, found + missed); }

std::string DetectionCounts::text() const {
  return rate("recall", found, found + missed) + ", " + rate("precision", found, found + wrong);
}

DetectionCounts countDetections(const std::vector<LabelledImage>& samples,
                                const detection::DetectorParams& params,
                                const detection::ReferenceAppearance* reference) {
  detection::WindowDetector detector(params);
  if (reference) detector.setReference(*reference);
  DetectionCounts counts;
  for (const LabelledImage& sample : samples) {
    const auto window = detector.detect(sample.image, 0.0, sample.camera ? &*sample.camera : nullptr);
    double best = 0.0;
    if (window)
      for (const auto& target : sample.targets)
        best = std::max(best, geometry::intersectionOverUnion(window->corners, target));
    const bool hit = best >= kSameWindowIou;
    counts.found += hit;
    counts.overlap += hit ? best : 0.0;
    counts.missed += !sample.targets.empty() && !hit;
    counts.wrong += window && !hit;
  }
  return counts;
}

std::vector<LabelledImage> readLabelled(const std::string& csv_file, const std::string& folder) {
  std::vector<LabelledImage> samples;
  for (const auto& [file, targets] : annotationsIn(csv_file)) {
    const std::string path = (std::filesystem::path(folder) / file).string();
    samples.push_back({groupOf(file), imageOrNone(path), targets, std::nullopt});
    if (samples.back().image.empty())
      throw InputError(path + ": cannot be read as an image; " + csv_file + " names it");
  }
  if (samples.empty()) throw InputError(csv_file + ": no image in it");
  return samples;
}

std::optional<LabelledImage> labelled(const cv::Mat& image, const Eigen::Isometry3d& T_camera_window,
                                      const geometry::PinholeCamera& camera,
                                      const geometry::OpeningSize& opening) {
  LabelledImage sample;
  sample.image = image;
  sample.camera = camera;
  const auto quad = geometry::projectOpening(camera, T_camera_window, opening);
  if (!quad || geometry::signedArea(*quad) <= 0.0) return sample;  // behind the camera, or seen from behind
  const auto inside = [&](const Eigen::Vector2d& corner) { return camera.contains(corner); };
  const auto corners = std::count_if(quad->begin(), quad->end(), inside);
  if (corners == 4) sample.targets.push_back(*quad);
  const cv::Rect2d frame(0.0, 0.0, image.cols, image.rows);
  cv::Rect2d box((*quad)[0].x(), (*quad)[0].y(), 0.0, 0.0);
  for (const auto& corner : *quad) box |= cv::Rect2d(corner.x(), corner.y(), 1e-6, 1e-6);
  if (corners < 4 && (frame & box).area() > 0.0) return std::nullopt;
  return sample;
}

std::pair<std::vector<LabelledImage>, std::vector<LabelledImage>> split(
    const std::vector<LabelledImage>& samples, double held_out, std::uint32_t seed) {
  std::set<std::string> names;
  for (const auto& sample : samples) names.insert(sample.group);
  if (names.size() < 2)
    throw std::invalid_argument(
        "all images belong to one group (one second of a bag, or names that differ in the last digit only): "
        "none can be held out; label images of at least two places");
  std::vector<std::string> groups(names.begin(), names.end());
  std::mt19937 random(seed);
  for (std::size_t i = groups.size() - 1; i > 0; --i) std::swap(groups[i], groups[random() % (i + 1)]);
  const auto wanted = static_cast<std::size_t>(std::lround(held_out * static_cast<double>(groups.size())));
  const std::size_t count = std::clamp<std::size_t>(wanted, 1, groups.size() - 1);
  const std::set<std::string> chosen(groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(count));
  std::pair<std::vector<LabelledImage>, std::vector<LabelledImage>> parts;
  for (const auto& sample : samples)
    (chosen.count(sample.group) > 0 ? parts.second : parts.first).push_back(sample);
  return parts;
}

}  // namespace window_ingress::evaluation
