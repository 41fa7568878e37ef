/// The parameters of one group as an image: name, value and unit; what differs from the default stands out.
#pragma once

#include <window_ingress/WindowDetectorConfig.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/parameters/field_list.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::tools {

/// Of a parameter of the detector, "edges/floor", as its description says; empty if it has none.
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

inline std::string valueOf(const parameters::NamedField& field) {
  if (field.kind != parameters::NamedField::kNumber) return parameters::toText(field);
  return formatted("%.4g", field.get());
}

/// "edges/floor = 4.5 grey levels a pixel", with the default behind it where it is another one.
inline std::string valueText(const parameters::NamedField& field, const parameters::NamedField& as_default) {
  std::string text = field.name + " = " + valueOf(field);
  if (const std::string unit = unitOf(field.name); !unit.empty()) text += " " + unit;
  if (field.get() != as_default.get()) text += "  (default " + valueOf(as_default) + ")";
  return text;
}

/// \param width of the image [px]
inline cv::Mat valueTable(const std::vector<const parameters::NamedField*>& fields, int width) {
  constexpr int kRowPx = 20, kColumnPx = 560;
  const int columns = std::max(1, width / kColumnPx), count = static_cast<int>(fields.size());
  const int rows = (count + columns - 1) / columns;
  cv::Mat table(rows * kRowPx + 10, width, CV_8UC3, cv::Scalar::all(24));
  detection::DetectorParams defaults;
  const auto as_default = parameters::fieldsOf(defaults);
  for (int i = 0; i < count; ++i) {
    const parameters::NamedField& field = *fields[static_cast<std::size_t>(i)];
    const parameters::NamedField& other = *parameters::find(as_default, field.name);
    const cv::Scalar colour = field.get() == other.get() ? cv::Scalar::all(220) : cv::Scalar(60, 220, 255);
    cv::putText(table, valueText(field, other), {8 + i / rows * (width / columns), 18 + i % rows * kRowPx},
                cv::FONT_HERSHEY_SIMPLEX, 0.45, colour, 1, cv::LINE_AA);
  }
  return table;
}

}  // namespace window_ingress::tools
