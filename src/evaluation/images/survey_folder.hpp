#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluation/csv.hpp"
#include "evaluation/images/survey_image.hpp"

namespace window_ingress::evaluation {

/// The images of a survey as files, so that detection can be measured again without drawing them:
/// `<scenario>_<seed>.png`, `.camera.yaml` (as camera_info_manager writes it) and, with a reference,
/// `.reference.png` for each; truth.csv has one row each, in the order of `add`.
class SurveyFolder {
 public:
  explicit SurveyFolder(const std::string& folder) : folder_(folder) {}

  void add(const SurveyImage& sample);  ///< \throws std::runtime_error if a file cannot be written
  void writeTable() const;              ///< truth.csv; \throws std::runtime_error

  /// The images that the folder holds, one after the other. \throws InputError
  void forEach(const std::function<void(const SurveyImage&)>& use) const;

 private:
  SurveyImage load(const CsvReader& row) const;
  std::string fileOf(const SurveyImage& sample, const std::string& ending) const;

  std::string folder_;
  std::vector<std::string> rows_;
};

}  // namespace window_ingress::evaluation
