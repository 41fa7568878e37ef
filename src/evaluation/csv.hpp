/// Tables as csv files, in which a quoted field may hold commas and doubled quotes, and in markdown.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "window_ingress/geometry/quadrilateral.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {

/// A text as one field: in quotes if it holds a comma, a quote or a line end.
std::string csvField(const std::string& text);

/// Eight numbers, each after a comma. \param pattern printf format of one number
std::string csvCorners(const geometry::Quadrilateral& corners, const char* pattern);
/// Names of these columns: ",inner_x1,inner_y1,...".
std::string csvCornerColumns(const std::string& name);

/// The head of a markdown table, "| a | b |", and the rule below it.
std::string markdownHead(const std::string& columns);

/// The rows of a table below its header, one after the other.
class CsvReader {
 public:
  explicit CsvReader(const std::string& file);  ///< \throws InputError without a header
  /// \param header the whole header \throws InputError if the file has another one
  CsvReader(const std::string& file, const std::string& header);

  const std::vector<std::string>& columns() const { return columns_; }
  bool next();  ///< the next row; false at the end
  /// The next row. \throws InputError unless it has a field for each column
  bool nextWhole() { return next() && isWhole(); }
  /// As `nextWhole`, but skips an incomplete last row without a line end.
  bool nextFinished() { return next() && !file_.eof() && isWhole(); }

  const std::string& line() const { return line_; }  ///< the row as text
  /// Empty if the row is shorter.
  std::string text(std::size_t column) const { return column < fields_.size() ? fields_[column] : ""; }
  double number(std::size_t column) const;  ///< \throws InputError if it is not a number
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ":" + std::to_string(number_) + ": " + what);
  }

 private:
  bool isWhole() const {
    if (fields_.size() != columns_.size()) fail("has not " + std::to_string(columns_.size()) + " fields");
    return true;
  }

  std::string name_, line_;
  std::ifstream file_;
  std::vector<std::string> columns_, fields_;
  int number_ = 1;
};

}  // namespace window_ingress::evaluation
