#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace window_ingress::adapters {

struct CompressedSize {
  std::uint32_t width = 0;   ///< [px]
  std::uint32_t height = 0;  ///< [px]
};

/// Size of a JPEG or PNG as its header tells, without decoding; nothing for anything else.
std::optional<CompressedSize> compressedSize(const std::vector<std::uint8_t>& bytes);

/// Whether a JPEG or PNG ends before its end mark: a decoder would fill what is missing with grey. Zeros
/// behind the end are padding.
bool isCutOff(const std::vector<std::uint8_t>& bytes);

}  // namespace window_ingress::adapters
