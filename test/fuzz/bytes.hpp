/// Splits the fuzzer's bytes into values; zeros follow at their end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace window_ingress::fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  template <typename Value>
  Value take() {
    Value value{};
    const std::size_t count = std::min(left_, sizeof value);
    if (count > 0) std::memcpy(&value, data_, count);
    skip(count);
    return value;
  }
  /// 0 to `end` - 1
  std::size_t below(std::size_t end) { return take<std::uint16_t>() % end; }
  /// Usually a number of the range, sometimes arbitrary bits.
  double number(double minimum, double maximum) {
    if (take<std::uint8_t>() % 16 == 0) return take<double>();
    return minimum + (maximum - minimum) * take<std::uint16_t>() / 65535.0;
  }
  std::string text(std::size_t most) {
    const std::size_t count = std::min({most, left_, static_cast<std::size_t>(take<std::uint8_t>())});
    const std::string value(reinterpret_cast<const char*>(data_), std::min(count, left_));
    skip(value.size());
    return value;
  }
  std::vector<std::uint8_t> rest() {
    std::vector<std::uint8_t> value(data_, data_ + left_);
    skip(left_);
    return value;
  }
  std::size_t left() const { return left_; }

 private:
  void skip(std::size_t count) { data_ += count, left_ -= count; }
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace window_ingress::fuzz
