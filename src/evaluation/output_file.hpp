/// Output files that report an incomplete write. Their folder is made if it is missing.
#pragma once

#include <boost/algorithm/string/case_conv.hpp>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {

[[noreturn]] inline void cannotBeWritten(const std::filesystem::path& file) {
  throw std::runtime_error(file.string() + ": cannot be written; is the disk full?");
}

inline void makeFolderOf(const std::filesystem::path& file) {
  std::error_code ignored;  // then writing the file fails, too
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
}

/// A text file, or a table below its header. \throws std::runtime_error that names it if it cannot be made or
/// finished
class OutputFile : public std::ofstream {
 public:
  OutputFile() = default;
  explicit OutputFile(const std::filesystem::path& file, const std::string& header = "") {
    open(file, header);
  }

  void open(const std::filesystem::path& file, const std::string& header = "") {
    makeFolderOf(file);
    std::ofstream::open(file_ = file);
    check();
    if (!header.empty()) *this << header << "\n";
  }
  void check() const {
    if (!*this) cannotBeWritten(file_);
  }
  /// Also called after each row of a slow table, so that an aborted run leaves whole rows.
  void finish() {
    flush();
    check();
  }

 private:
  std::filesystem::path file_;
};

/// \throws std::runtime_error that names the file
inline void writeText(const std::filesystem::path& file, const std::string& text) {
  OutputFile output(file);
  output << text;
  output.finish();
}

/// By the end of its name.
inline bool looksLikeImage(const std::filesystem::path& file) {
  static const std::set<std::string> kKnown{".jpg", ".jpeg", ".png", ".bmp", ".tif", ".tiff", ".ppm", ".pgm"};
  return kKnown.count(boost::to_lower_copy(file.extension().string())) > 0;
}

/// An image as viewers show it: turned by the orientation that its camera has noted; empty if the file cannot
/// be read as an image.
inline cv::Mat imageOrNone(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};  // OpenCV itself would print a warning about a missing file
  try {
    return cv::imread(file.string(), cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    return {};
  }
}

/// The same. \throws InputError that names the file
inline cv::Mat readImage(const std::filesystem::path& file) {
  const cv::Mat image = imageOrNone(file);
  if (image.empty())
    throw InputError(file.string() +
                     (std::filesystem::exists(file) ? ": cannot be read as an image" : ": no such file"));
  return image;
}

/// Writes an image in the format given by the name's extension. \throws std::runtime_error that names the
/// file; InputError if there is no such format
inline void writeImage(const std::filesystem::path& file, const cv::Mat& image,
                       const std::vector<int>& how = {}) {
  if (!cv::haveImageWriter(file.string()))
    throw InputError(file.string() + ": give a name that ends as an image's, e.g. in .png");
  makeFolderOf(file);
  if (image.empty() || !cv::imwrite(file.string(), image, how)) cannotBeWritten(file);
}

}  // namespace window_ingress::evaluation
