/// The parameters of one group as an image: name, value and unit; changed values are highlighted.
#pragma once

#include <window_ingress/WindowDetectorConfig.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

/// Unit of a detector parameter ("edges/floor") from its description; empty if it has none.
inline std::string unitOf(const std::string& field) {
  std::string name = field;
  std::replace(name.begin(), name.end(), '/', '_');
  for (const auto& about : window_ingress::WindowDetectorConfig::__getParamDescriptions__()) {
    if (about->name != name) continue;
    const std::size_t begin = about->description.rfind('['), end = about->description.rfind(']');
    if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
    const std::string unit = about->description.substr(begin + 1, end - begin - 1);
    return unit == "-" ? "" : unit;
  }
  return "";
}

inline std::string valueOf(const parameters::Field& field) {
  if (field.isWhole() || field.isSwitch()) return parameters::toText(field);
  return formatted("%.4g", field.get());
}

/// "edges/floor = 4.5 grey levels a pixel", followed by the default if it differs.
inline std::string valueText(const parameters::Field& field, const parameters::Field& as_default) {
  std::string text = field.name + " = " + valueOf(field);
  if (const std::string unit = unitOf(field.name); !unit.empty()) text += " " + unit;
  if (field.get() != as_default.get()) text += "  (default " + valueOf(as_default) + ")";
  return text;
}

inline cv::Mat valueTable(const std::vector<const parameters::Field*>& fields) {
  constexpr int kRowPx = 20, kWidthPx = 700;
  cv::Mat table(static_cast<int>(fields.size()) * kRowPx + 10, kWidthPx, CV_8UC3, cv::Scalar::all(24));
  detection::DetectorParams defaults;
  const auto as_default = parameters::fieldsOf(defaults);
  int y = 18;
  for (const parameters::Field* field : fields) {
    const parameters::Field& other = *parameters::find(as_default, field->name);
    const cv::Scalar colour = field->get() == other.get() ? cv::Scalar::all(220) : cv::Scalar(60, 220, 255);
    cv::putText(table, valueText(*field, other), {8, y}, cv::FONT_HERSHEY_SIMPLEX, 0.45, colour, 1,
                cv::LINE_AA);
    y += kRowPx;
  }
  return table;
}

}  // namespace window_ingress::tools
