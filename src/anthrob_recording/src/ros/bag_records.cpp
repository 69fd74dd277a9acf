#include "anthrob_recording/bag_records.h"

#include <rosbag/chunked_file.h>
#include <rosbag/stream.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "anthrob_core/errors.h"

namespace anthrob {

namespace {

using Fields = std::map<std::string, std::string>;

constexpr char kMagic[] = "#ROSBAG V2.0\n";
constexpr std::uint64_t kMagicLength = sizeof(kMagic) - 1;
constexpr std::uint64_t kLargestHeader = 1 << 20, kLargestChunk = 1 << 28;  // [bytes]
enum Kind { kMessage = 2, kBag = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7 };

std::uint64_t little_endian(const char* bytes, std::size_t count) {
  std::uint64_t value = 0;
  while (count-- > 0) value = value << 8 | static_cast<unsigned char>(bytes[count]);
  return value;
}

/// @param header length and "name=value", again and again   @return none if it is no header
std::optional<Fields> fields_of(const std::string& header) {
  Fields fields;
  for (std::size_t at = 0; at < header.size();) {
    if (header.size() - at < 4) return std::nullopt;
    const std::size_t length = little_endian(&header[at], 4);
    at += 4;
    if (length > header.size() - at) return std::nullopt;
    const std::string field = header.substr(at, length);
    const std::size_t equals = field.find('=');
    if (equals == std::string::npos) return std::nullopt;
    fields[field.substr(0, equals)] = field.substr(equals + 1);
    at += length;
  }
  return fields;
}

/// @param size of the number [bytes], at most 8   @return none if there is no such field
std::optional<std::uint64_t> number_in(const Fields& fields, const std::string& name,
                                       std::size_t size = 4) {
  const auto found = fields.find(name);
  if (found == fields.end() || found->second.size() != size) return std::nullopt;
  return little_endian(found->second.data(), size);
}

struct Record {
  std::uint64_t begin, end;  ///< [bytes] from where the walk began
  int kind;
  Fields fields;
  std::uint64_t data;  ///< [bytes] where its data begin

  std::uint64_t length() const { return end - data; }
};

/// The next record of bytes that can be read by `at(position, count)`.
/// @return none if it does not fit into `size`, or has no header
template <class Bytes>
std::optional<Record> record_at(const Bytes& at, std::uint64_t begin, std::uint64_t size) {
  if (size - begin < 8) return std::nullopt;
  const std::uint64_t header = little_endian(at(begin, 4).data(), 4);
  if (header > kLargestHeader || header > size - begin - 8) return std::nullopt;
  const std::optional<Fields> fields = fields_of(at(begin + 4, header));
  const auto kind = fields ? number_in(*fields, "op", 1) : std::nullopt;
  if (!kind) return std::nullopt;
  const std::uint64_t data = begin + 8 + header;
  const std::uint64_t length = little_endian(at(begin + 4 + header, 4).data(), 4);
  if (length > size - data) return std::nullopt;
  return Record{begin, data + length, static_cast<int>(*kind), *fields, data};
}

/// Decompressed by rosbag, which throws where it cannot.
std::string decompressed(std::string data, const std::string& compression, std::uint64_t size) {
  if (compression == "none") return data;
  rosbag::ChunkedFile nothing;
  const auto stream = rosbag::StreamFactory(&nothing).getStream(
      compression == "bz2" ? rosbag::compression::BZ2 : rosbag::compression::LZ4);
  std::string out(size, '\0');
  stream->decompress(reinterpret_cast<std::uint8_t*>(out.data()), static_cast<unsigned>(size),
                     reinterpret_cast<std::uint8_t*>(data.data()),
                     static_cast<unsigned>(data.size()));
  return out;
}

class Records {
 public:
  explicit Records(const std::string& file) : file_(file), in_(file, std::ios::binary) {
    std::error_code ignored;
    size_ = std::filesystem::file_size(file, ignored);
  }

  void check() {
    if (size_ < kMagicLength || bytes(0, kMagicLength) != kMagic) return;  // rosbag says more
    const auto at = [this](std::uint64_t begin, std::uint64_t count) {
      return bytes(begin, count);
    };
    for (std::uint64_t begin = kMagicLength; begin < size_;) {
      at_ = begin;
      const std::optional<Record> record = record_at(at, begin, size_);
      if (!record) fail("a record that is longer than the file, or none");
      check_one(*record);
      boundaries_.insert(begin);
      begin = record->end;
    }
    check_places();
  }

 private:
  using Messages = std::map<std::uint64_t, std::uint64_t>;  ///< connection by place in the chunk

  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(file_ + ": cannot be read as a bag: at byte " + std::to_string(at_) + ": " +
                   what + "; was the recording cut off, or the file damaged? Try rosbag reindex");
  }
  void expect(bool holds, const std::string& otherwise) const {
    if (!holds) fail(otherwise);
  }

  std::string bytes(std::uint64_t begin, std::uint64_t count) {
    std::string read(count, '\0');
    in_.seekg(static_cast<std::streamoff>(begin));
    if (!in_.read(read.data(), static_cast<std::streamsize>(count))) fail("the file ends early");
    return read;
  }

  void check_one(const Record& record) {
    switch (record.kind) {
      case kBag:
        index_begin_ = number_in(record.fields, "index_pos", 8);
        return;
      case kChunk:
        chunks_.insert(record.begin);
        return check_chunk(record);
      case kIndex:
        return check_index(record);
      case kChunkInfo:
        return check_chunk_info(record);
      case kConnection:
        return check_connection(record.fields, bytes(record.data, record.length()));
      default:
        fail("a record of no known kind");
    }
  }

  void check_connection(const Fields& fields, const std::string& data) {
    const auto connection = number_in(fields, "conn");
    const auto header = fields_of(data);
    expect(connection && fields.count("topic") && header && header->count("type") &&
               header->count("md5sum") && header->count("message_definition"),
           "a connection that is not complete");
    connections_.insert(*connection);
  }

  void check_chunk(const Record& record) {
    const auto size = number_in(record.fields, "size");
    const auto how = record.fields.find("compression");
    expect(size && how != record.fields.end(), "a chunk that is not complete");
    expect(how->second == "none" || how->second == "bz2" || how->second == "lz4",
           "a chunk of unknown compression");
    expect(how->second == "none" ? *size == record.length() : *size <= kLargestChunk,
           "a chunk that says it has " + std::to_string(*size) + " bytes");
    const std::string chunk = decompressed(bytes(record.data, record.length()), how->second, *size);
    const auto at = [&](std::uint64_t begin, std::uint64_t count) {
      return chunk.substr(begin, count);
    };
    messages_.clear();
    for (std::uint64_t begin = 0; begin < chunk.size();) {
      const std::optional<Record> inner = record_at(at, begin, chunk.size());
      expect(inner && (inner->kind == kMessage || inner->kind == kConnection),
             "a chunk with other records than messages");
      if (inner->kind == kConnection) {
        check_connection(inner->fields, at(inner->data, inner->length()));
      } else {
        const auto connection = number_in(inner->fields, "conn");
        expect(connection && connections_.count(*connection) && number_in(inner->fields, "time", 8),
               "a message of no connection");
        messages_[begin] = *connection;
      }
      begin = inner->end;
    }
  }

  /// Places of messages in the chunk before.
  void check_index(const Record& record) {
    const auto count = number_in(record.fields, "count");
    const auto connection = number_in(record.fields, "conn");
    expect(count && connection && *count * 12 == record.length(), "an index of another length");
    const std::string places = bytes(record.data, record.length());
    for (std::size_t i = 0; i < *count; ++i) {
      const auto message = messages_.find(little_endian(&places[12 * i + 8], 4));
      expect(message != messages_.end() && message->second == *connection,
             "an index of messages that are not there");
    }
  }

  void check_chunk_info(const Record& record) {
    const auto count = number_in(record.fields, "count");
    const auto chunk = number_in(record.fields, "chunk_pos", 8);
    expect(count && chunk && *count * 8 == record.length() && chunks_.count(*chunk),
           "a place of a chunk where none is");
  }

  void check_places() {
    at_ = kMagicLength;
    expect(index_begin_.has_value(), "no record of the bag");
    // 0: the recorder was stopped too early, as rosbag then says.
    expect(*index_begin_ == 0 || *index_begin_ == size_ || boundaries_.count(*index_begin_),
           "an index that begins within a record");
  }

  std::string file_;
  std::ifstream in_;
  std::uint64_t size_ = 0, at_ = 0;  ///< [bytes]
  std::optional<std::uint64_t> index_begin_;
  std::set<std::uint64_t> boundaries_, chunks_, connections_;
  Messages messages_;  ///< of the last chunk
};

}  // namespace

void check_bag_records(const std::string& file) {
  if (!std::filesystem::exists(file)) throw BadInput(file + ": no such bag");
  Records(file).check();
}

}  // namespace anthrob
