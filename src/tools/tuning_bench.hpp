/// What tune_detector turns its trackbars at.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapters/runtime/diagnostics.hpp"
#include "evaluation/images/stage_sheet.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/parameters/field_list.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

using parameters::Field;

/// The detector with the settings of the moment.
class Bench {
 public:
  Bench(const detection::DetectorParams& start, std::optional<detection::ReferenceAppearance> reference)
      : reference_(std::move(reference)),
        params_(start),
        fields_(parameters::fieldsOf(params_)),
        detector_(start),
        watch_(adapters::steadyNowSec) {
    detector_.setWatch(&watch_);
    if (reference_) detector_.setReference(*reference_);
  }

  const detection::DetectorParams& params() const { return params_; }
  const std::vector<Field>& fields() const { return fields_; }
  void changed() { detector_.setParams(params_); }

  /// \return one line: what was found, and what it cost
  std::string look(const cv::Mat& image) {
    const double begun_sec = adapters::steadyNowSec();
    watch_.begin();
    const auto window = detector_.detect(image, 0.0);
    milliseconds_ = 1e3 * (adapters::steadyNowSec() - begun_sec);
    found_ = window.has_value();
    std::string line = window ? formatted("window, score %.2f", window->score) : "no window";
    if (window && window->has_appearance)
      line += ", distance " + std::to_string(window->bhattacharyya).substr(0, 4);
    if (!window) line += ": " + detector_.trace().detail;
    return line + "; " + times();
  }

  cv::Mat sheet(const cv::Mat& image, int width) const {
    return evaluation::stageSheet(image, params_, reference_ ? &*reference_ : nullptr, width);
  }
  bool found() const { return found_; }
  double milliseconds() const { return milliseconds_; }

 private:
  std::string times() const {
    std::string line = formatted("%.1f ms", milliseconds_);
    for (int i = 0; i < detection::kStages; ++i) {
      const auto stage = static_cast<detection::Stage>(i);
      if (watch_.milliseconds(stage) < 0.05) continue;
      line += formatted(", %s %.1f", detection::toString(stage), watch_.milliseconds(stage));
    }
    return line;
  }

  std::optional<detection::ReferenceAppearance> reference_;
  detection::DetectorParams params_;
  std::vector<Field> fields_;  // refer to params_
  detection::WindowDetector detector_;
  detection::StageTimer watch_;
  bool found_ = false;
  double milliseconds_ = 0.0;
};

}  // namespace window_ingress::tools
