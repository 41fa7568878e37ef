#include "adapters/images/compressed_size.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

namespace window_ingress::adapters {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint32_t bigEndian(const Bytes& bytes, std::size_t at, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
  return value;
}

// PNG: the IHDR chunk, always first, starts with width and height.
std::optional<CompressedSize> pngSize(const Bytes& bytes) {
  constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (bytes.size() < 24 || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin())) return std::nullopt;
  return CompressedSize{bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4)};
}

// Start of frame: C0 to CF, except the tables C4 (Huffman), C8 (reserved) and CC (arithmetic).
bool isStartOfFrame(std::uint8_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

// JPEG: segments "ff marker length ..." until a start of frame: length, precision, height, width.
std::optional<CompressedSize> jpegSize(const Bytes& bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) return std::nullopt;
  std::size_t at = 2;
  while (at + 9 <= bytes.size()) {
    if (bytes[at] != 0xff) return std::nullopt;
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xff) {  // a fill byte
      ++at;
      continue;
    }
    if (isStartOfFrame(marker))
      return CompressedSize{bigEndian(bytes, at + 7, 2), bigEndian(bytes, at + 5, 2)};
    at += 2 + bigEndian(bytes, at + 2, 2);
  }
  return std::nullopt;
}

// The end of a PNG is the chunk IEND with its checksum, that of a JPEG the marker "ff d9".
bool endsWith(const Bytes& bytes, std::size_t end, std::initializer_list<std::uint8_t> mark) {
  return end >= mark.size() &&
         std::equal(mark.begin(), mark.end(), bytes.begin() + static_cast<std::ptrdiff_t>(end - mark.size()));
}

}  // namespace

bool isCutOff(const Bytes& bytes) {
  std::size_t end = bytes.size();
  while (end > 0 && bytes[end - 1] == 0) --end;
  return !endsWith(bytes, end, {0xff, 0xd9}) &&
         !endsWith(bytes, end, {'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82});
}

std::optional<CompressedSize> compressedSize(const Bytes& bytes) {
  const auto png = pngSize(bytes);
  return png ? png : jpegSize(bytes);
}

}  // namespace window_ingress::adapters
