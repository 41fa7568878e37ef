/// Tables as csv files: a field in quotes may hold commas and doubled quotes.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "window_ingress/geometry/quadrilateral.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {

/// A text as one field: in quotes if it holds a comma, a quote or a line end.
std::string csvField(const std::string& text);

/// Eight numbers, each after a comma. \param pattern of one, as of printf
std::string csvCorners(const geometry::Quadrilateral& corners, const char* pattern);
/// Their columns: ",inner_x1,inner_y1,...".
std::string csvCornerColumns(const std::string& name);

/// The rows of a table below its header, one after the other.
class CsvReader {
 public:
  explicit CsvReader(const std::string& file);  ///< \throws InputError without a header
  /// \param header all of it \throws InputError if the file has another one
  CsvReader(const std::string& file, const std::string& header);

  const std::vector<std::string>& columns() const { return columns_; }
  bool next();          ///< the next row; false at the end
  bool nextWhole();     ///< likewise; \throws InputError unless it has a field for each column
  bool nextFinished();  ///< likewise, without a last row that was cut off as it was written: no line ends it

  const std::string& line() const { return line_; }  ///< the row as it stands there
  std::string text(std::size_t column) const;        ///< empty in a row that ends before
  double number(std::size_t column) const;           ///< \throws InputError if it is none
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool isWhole() const;

  std::string name_, line_;
  std::ifstream file_;
  std::vector<std::string> columns_, fields_;
  int number_ = 1;
};

}  // namespace window_ingress::evaluation
