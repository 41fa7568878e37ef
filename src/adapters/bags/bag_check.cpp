#include "adapters/bags/bag_check.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace window_ingress::adapters {
namespace {

constexpr char kMagic[] = "#ROSBAG V2.0\n";
constexpr std::uint64_t kMagicSize = sizeof kMagic - 1;
constexpr std::uint64_t kLargestChunk = 1u << 31;
enum Op { kMessage = 2, kBagHeader = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7 };

struct Damage {
  std::string text;
};

template <typename Number>
std::optional<Number> numberAt(const std::vector<char>& bytes, std::uint64_t place) {
  Number number;
  if (place + sizeof number > bytes.size()) return std::nullopt;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/// The fields "name=value" of a record's header, each preceded by its length.
class Fields {
 public:
  explicit Fields(const std::vector<char>& bytes) {
    for (std::uint64_t place = 0; place < bytes.size();) {
      const auto length = numberAt<std::uint32_t>(bytes, place);
      if (!length || place + 4 + *length > bytes.size()) throw Damage{"a field is longer than its record"};
      const std::string field(bytes.data() + place + 4, *length);
      const std::size_t equals = field.find('=');
      if (equals == std::string::npos) throw Damage{"a field has no name"};
      values_[field.substr(0, equals)] = field.substr(equals + 1);
      place += 4 + *length;
    }
  }
  template <typename Number>
  Number number(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end() || found->second.size() != sizeof(Number))
      throw Damage{"no " + name + " where one belongs"};
    Number value;
    std::memcpy(&value, found->second.data(), sizeof value);
    return value;
  }
  std::string text(const std::string& name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? "" : found->second;
  }
  int op() const { return number<std::uint8_t>("op"); }

 private:
  std::map<std::string, std::string> values_;
};

/// Walks over all records, then compares the places named in the index with the records found.
class BagCheck {
 public:
  explicit BagCheck(const std::string& file) : stream_(file, std::ios::binary) {
    stream_.seekg(0, std::ios::end);
    size_ = stream_ ? static_cast<std::uint64_t>(stream_.tellg()) : 0;
  }

  void check() {
    if (isLeftToRosbag()) return;
    for (std::uint64_t place = kMagicSize; place < size_;) place = checkRecord(place);
    const bool is_empty = index_place_ == size_;  // an empty bag
    if (!is_empty && records_.count(index_place_) == 0)
      throw Damage{"the index does not begin where the bag header says"};
    if (summaries_ != promised_chunks_ || connections_ != promised_connections_)
      throw Damage{"its index is cut off"};
    for (const std::uint64_t place : named_chunks_)
      if (chunks_.count(place) == 0) throw Damage{"the index names a chunk where there is none"};
  }

 private:
  // No file, not a bag, or cut off before the index: rosbag reports these cases well.
  bool isLeftToRosbag() {
    if (size_ <= kMagicSize || read(0, kMagicSize) != std::vector<char>(kMagic, kMagic + kMagicSize)) {
      const std::vector<char> begin = read(0, std::min<std::uint64_t>(size_, 8));
      if (std::string(begin.begin(), begin.end()) == "#ROSBAG ")
        throw Damage{"it is of an old version: see 'rosbag fix'"};
      return true;
    }
    const Record header = recordAt(kMagicSize);
    if (header.fields.op() != kBagHeader) throw Damage{"it does not begin with a bag header"};
    index_place_ = header.fields.number<std::uint64_t>("index_pos");
    promised_connections_ = header.fields.number<std::uint32_t>("conn_count");
    promised_chunks_ = header.fields.number<std::uint32_t>("chunk_count");
    return index_place_ == 0;
  }

  struct Record {
    Fields fields;
    std::uint64_t data, data_size;
  };

  Record recordAt(std::uint64_t place) {
    const std::uint32_t header_size = lengthAt(place);
    const Fields fields(read(place + 4, header_size));
    return {fields, place + 8 + header_size, lengthAt(place + 4 + header_size)};
  }

  // Length of the following bytes, which must lie within the file.
  std::uint32_t lengthAt(std::uint64_t place) {
    const std::uint32_t length = *numberAt<std::uint32_t>(read(place, 4), 0);
    if (place + 4 + length > size_) throw Damage{"a record is longer than the file"};
    return length;
  }

  std::vector<char> read(std::uint64_t place, std::uint64_t count) {
    if (place > size_ || count > size_ - place) throw Damage{"a record is cut off"};
    std::vector<char> bytes(count);
    stream_.seekg(static_cast<std::streamoff>(place));
    if (count > 0 && !stream_.read(bytes.data(), static_cast<std::streamsize>(count)))
      throw Damage{"it cannot be read"};
    return bytes;
  }

  std::uint64_t checkRecord(std::uint64_t place) {
    const Record record = recordAt(place);
    records_.insert(place);
    switch (record.fields.op()) {
      case kChunk:
        chunks_.insert(place);
        checkChunk(record);
        break;
      case kIndex:
        checkIndex(record);
        break;
      case kChunkInfo:
        ++summaries_;
        named_chunks_.insert(record.fields.number<std::uint64_t>("chunk_pos"));
        if (std::uint64_t{record.fields.number<std::uint32_t>("count")} * 8 != record.data_size)
          throw Damage{"a chunk's summary has the wrong length"};
        break;
      case kConnection:
        ++connections_;
        record.fields.number<std::uint32_t>("conn");
        Fields(read(record.data, record.data_size));
        break;
      case kBagHeader:
        break;
      default:
        throw Damage{"a record is of an unknown kind"};
    }
    return record.data + record.data_size;
  }

  void checkChunk(const Record& record) {
    const std::string compression = record.fields.text("compression");
    chunk_size_ = record.fields.number<std::uint32_t>("size");
    if (chunk_size_ > kLargestChunk) throw Damage{"a chunk is too large"};
    is_plain_ = compression == "none";
    if (!is_plain_ && compression != "bz2" && compression != "lz4")
      throw Damage{"a chunk's compression is unknown"};
    if (!is_plain_) return;
    if (chunk_size_ != record.data_size) throw Damage{"a chunk has the wrong size"};
    messages_.clear();
    for (std::uint64_t place = 0; place < chunk_size_;) place = checkWithinChunk(record, place);
  }

  std::uint64_t checkWithinChunk(const Record& chunk, std::uint64_t place) {
    const Record inner = recordAt(chunk.data + place);
    const std::uint64_t end = inner.data + inner.data_size - chunk.data;
    if (end > chunk_size_) throw Damage{"a message reaches beyond its chunk"};
    const int op = inner.fields.op();
    if (op == kMessage)
      inner.fields.number<std::uint32_t>("conn"), inner.fields.number<std::uint64_t>("time");
    if (op == kConnection)
      inner.fields.number<std::uint32_t>("conn"), Fields(read(inner.data, inner.data_size));
    if (op != kMessage && op != kConnection) throw Damage{"a chunk contains something other than messages"};
    if (op == kMessage) messages_.insert(place);
    return end;
  }

  // Each entry: a time, and a place within the preceding chunk.
  void checkIndex(const Record& record) {
    constexpr std::uint64_t kEntry = 12;
    if (chunks_.empty()) throw Damage{"an index comes before any chunk"};
    if (std::uint64_t{record.fields.number<std::uint32_t>("count")} * kEntry != record.data_size)
      throw Damage{"an index has the wrong length"};
    const std::vector<char> entries = read(record.data, record.data_size);
    for (std::uint64_t entry = 0; entry < entries.size(); entry += kEntry) {
      const std::uint64_t place = *numberAt<std::uint32_t>(entries, entry + 8);
      if (is_plain_ ? messages_.count(place) == 0 : place >= chunk_size_)
        throw Damage{"the index names a message where there is none"};
    }
  }

  std::ifstream stream_;
  std::uint64_t size_ = 0, index_place_ = 0, chunk_size_ = 0;
  std::uint32_t promised_connections_ = 0, promised_chunks_ = 0, connections_ = 0, summaries_ = 0;
  bool is_plain_ = true;  // the preceding chunk is not compressed
  std::set<std::uint64_t> records_, chunks_, named_chunks_, messages_;
};

}  // namespace

std::string whyDamaged(const std::string& file) {
  try {
    BagCheck(file).check();
    return "";
  } catch (const Damage& damage) {
    return damage.text;
  }
}

}  // namespace window_ingress::adapters
