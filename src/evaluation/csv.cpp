#include "evaluation/csv.hpp"

#include <algorithm>
#include <cstdlib>

namespace window_ingress::evaluation {
namespace {

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool doubled = quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (doubled) ++i;
    if (c == '"' && !doubled)
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  }
  return fields;
}

}  // namespace

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csvCorners(const geometry::Quadrilateral& corners, const char* pattern) {
  std::string text;
  for (const Eigen::Vector2d& corner : corners)
    for (const double number : {corner.x(), corner.y()}) text += "," + formatted(pattern, number);
  return text;
}

std::string csvCornerColumns(const std::string& name) {
  std::string text;
  for (int i = 1; i <= 4; ++i)
    for (const char* axis : {"_x", "_y"}) text += "," + name + axis + std::to_string(i);
  return text;
}

std::string markdownHead(const std::string& columns) {
  std::string rule = "|";
  for (auto bars = std::count(columns.begin(), columns.end(), '|'); bars > 1; --bars) rule += "---|";
  return columns + "\n" + rule + "\n";
}

CsvReader::CsvReader(const std::string& file) : name_(file), file_(file) {
  if (!std::getline(file_, line_)) throw InputError(file + ": cannot be read, or empty");
  columns_ = fieldsOf(line_);
}

CsvReader::CsvReader(const std::string& file, const std::string& header) : CsvReader(file) {
  if (line_ == header) return;
  if (file_.eof() && header.rfind(line_, 0) == 0) fail("was cut off while it was written, and has no rows");
  fail("is not '" + header + "': written by another version?");
}

bool CsvReader::next() {
  if (!std::getline(file_, line_)) return false;
  ++number_;
  fields_ = fieldsOf(line_);
  return true;
}

double CsvReader::number(std::size_t column) const {
  const std::string field = text(column);
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  if (field.empty() || *end != '\0') fail("'" + field + "' is not a number");
  return value;
}

}  // namespace window_ingress::evaluation
