#include "adapters/images/reference_source.hpp"

#include <algorithm>
#include <boost/make_shared.hpp>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>

#include "adapters/images/image_files.hpp"
#include "window_ingress/detection/debug_image.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

// The text in YAML's single quotes.
std::string yamlQuoted(const std::string& text) {
  std::string result = "'";
  for (char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

}  // namespace

detection::ReferenceAppearance makeReference(const cv::Mat& image, const std::vector<double>& corners,
                                             const detection::DetectorParams& params) {
  if (corners.empty()) return detection::referenceFromImage(image, params);
  if (corners.size() != 8)
    throw InputError("reference/corners holds " + std::to_string(corners.size()) + " numbers instead of 8");
  geometry::Quadrilateral quad;
  for (std::size_t i = 0; i < 4; ++i) quad[i] = {corners[2 * i], corners[2 * i + 1]};
  const auto canonical = geometry::canonical(quad);
  if (!canonical) throw InputError("reference/corners are not a convex quadrilateral in cyclic order");
  if (const std::string fault = detection::ReferenceAppearance::faultOf(image, *canonical); !fault.empty())
    throw InputError("reference/corners: " + fault);
  return {image, *canonical};
}

detection::ReferenceAppearance makeReference(const window_ingress::ReferenceImage& message,
                                             const ImageLimits& limits,
                                             const detection::DetectorParams& params) {
  const DecodedImage decoded = decode(boost::make_shared<sensor_msgs::Image>(message.image), limits);
  if (!decoded.reason.empty()) throw InputError("reference image: " + decoded.reason);
  std::vector<double> corners;
  for (std::size_t i = 0; i < 4; ++i)
    corners.insert(corners.end(), {message.corner_x[i], message.corner_y[i]});
  const bool whole = std::all_of(corners.begin(), corners.end(), [](double number) { return number == 0.0; });
  return makeReference(decoded.image, whole ? std::vector<double>() : corners, params);
}

detection::ReferenceAppearance loadReference(const ReferenceParams& reference,
                                             const detection::DetectorParams& params) {
  if (!std::filesystem::exists(reference.picture))
    throw InputError("reference/picture: " + reference.picture + ": no such file");
  std::ifstream file(reference.picture, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  cv::Mat image = readImage(bytes, /*upright=*/true);
  if (image.empty())
    throw InputError("reference/picture: cannot read '" + reference.picture + "' as JPEG or PNG");
  if (image.channels() == 1) cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  return makeReference(image, reference.corners, params);
}

ReferenceFiles::ReferenceFiles(const std::string& file)
    : image(std::filesystem::absolute(file)),
      overlay(std::filesystem::path(image).replace_extension(".yaml")),
      understood(image.parent_path() / (image.stem().string() + "_understood.png")) {}

std::string unusedReferenceFile(const std::string& file) {
  const std::filesystem::path asked(file);
  std::filesystem::path name = asked;
  const auto is_used = [&name] {
    const ReferenceFiles files(name.string());
    return std::filesystem::exists(files.image) || std::filesystem::exists(files.overlay) ||
           std::filesystem::exists(files.understood);
  };
  for (int n = 2; is_used(); ++n)
    name.replace_filename(asked.stem().string() + "_" + std::to_string(n) + asked.extension().string());
  return name.string();
}

void saveReference(const std::string& file, const detection::ReferenceAppearance& reference) {
  const ReferenceFiles files(file);
  const geometry::Quadrilateral& opening = reference.opening();
  std::error_code ignored;
  std::filesystem::create_directories(files.image.parent_path(), ignored);
  if (!writeImage(files.image.string(), reference.image()) ||
      !writeImage(files.understood.string(), detection::drawReference(reference)))
    throw InputError("reference: cannot write '" + files.image.string() +
                     "' as JPEG or PNG, or its _understood image");
  std::ofstream output(files.overlay);
  output << "window_detector:\n  reference:\n    picture: " << yamlQuoted(files.image.string())
         << "\n    corners: [";
  for (int i = 0; i < 4; ++i) output << (i ? ", " : "") << opening[i].x() << ", " << opening[i].y();
  output << "]\n";
  output.close();
  if (!output) throw InputError("reference: cannot write '" + files.overlay.string() + "'");
}

}  // namespace window_ingress::adapters
