#include "bag_file.h"

#include <rosbag/constants.h>
#include <rosbag/exceptions.h>

#include <cstring>
#include <filesystem>
#include <optional>

namespace suspension_health_monitor {
namespace {

/// A bag is a sequence of records: a header of name=value fields, and data. Integers are little-endian.
/// What returns an optional is empty where the bytes do not have that form; nothing reads past them.

/// @return the integer that the bytes hold.
template <class Integer>
std::optional<Integer> toInteger(std::optional<std::string_view> bytes) {
  Integer value;
  if (!bytes || bytes->size() != sizeof(value)) return std::nullopt;
  std::memcpy(&value, bytes->data(), sizeof(value));
  return value;
}

/// Cuts a block, a 32 bit length and that many bytes, off the front of `rest`.
std::optional<std::string_view> takeBlock(std::string_view& rest) {
  const auto size = toInteger<std::uint32_t>(rest.substr(0, sizeof(std::uint32_t)));
  if (!size || *size > rest.size() - sizeof(*size)) return std::nullopt;
  const std::string_view block = rest.substr(sizeof(*size), *size);
  rest.remove_prefix(sizeof(*size) + *size);
  return block;
}

/// @param name  without '='.
/// @return the value of the field `name` of a record's header.
std::optional<std::string_view> findField(std::string_view header, std::string_view name) {
  while (const std::optional<std::string_view> field = takeBlock(header)) {
    const bool is_it =
        field->size() > name.size() && (*field)[name.size()] == '=' && field->substr(0, name.size()) == name;
    if (is_it) return field->substr(name.size() + 1);
  }
  return std::nullopt;
}

struct BagRecord {
  std::string_view header, body;

  std::optional<std::uint8_t> operation() const { return toInteger<std::uint8_t>(findField(header, "op")); }
  template <class Integer>
  std::optional<Integer> field(std::string_view name) const {
    return toInteger<Integer>(findField(header, name));
  }
  /// A time field, seconds and nanoseconds of 32 bit each, in [ns].
  std::optional<std::uint64_t> time(std::string_view name) const {
    const auto both = field<std::uint64_t>(name);
    if (!both) return std::nullopt;
    return (*both & 0xffffffffU) * 1000000000U + (*both >> 32U);
  }
};

/// Cuts a record off the front of `rest`.
std::optional<BagRecord> takeRecord(std::string_view& rest) {
  const std::optional<std::string_view> header = takeBlock(rest);
  const std::optional<std::string_view> body = header ? takeBlock(rest) : std::nullopt;
  if (!body) return std::nullopt;
  return BagRecord{*header, *body};
}

constexpr char kMagic[] = "#ROSBAG V2.0";
constexpr std::uint32_t kLargestChunk = 1U << 30U;

std::string text(std::optional<std::string_view> bytes) { return std::string(bytes.value_or(std::string_view())); }

bool isInOrder(const BagMessage& a, const BagMessage& b) { return a.time < b.time; }

/// @param path  of the bag, for messages.
BagChunk toChunk(const BagRecord& record, const std::string& path) {
  const auto position = record.field<std::uint64_t>(rosbag::CHUNK_POS_FIELD_NAME);
  const auto start = record.time(rosbag::START_TIME_FIELD_NAME);
  const auto end = record.time(rosbag::END_TIME_FIELD_NAME);
  if (!position || !start || !end)
    throw InputError(path + ": the table of contents is damaged (rosbag reindex repairs it)");
  BagChunk chunk{*position, *start, *end, 0, {}};
  constexpr std::size_t kEntry = 8;  // connection and number of its messages, 32 bit each
  for (std::string_view rest = record.body; rest.size() >= kEntry; rest.remove_prefix(kEntry)) {
    chunk.connections.push_back(*toInteger<std::uint32_t>(rest.substr(0, kEntry / 2)));
    chunk.num_messages += *toInteger<std::uint32_t>(rest.substr(kEntry / 2, kEntry / 2));
  }
  return chunk;
}

InputError damagedChunk(const std::string& path) {
  return InputError(path + ": a chunk is damaged (rosbag reindex saves the others)");
}

/// @param path  of the bag, for messages.  @param bytes  of the chunk.
void parseMessages(const std::string& path, const BagChunk& chunk, std::string_view bytes,
                   std::vector<BagMessage>& messages) {
  messages.clear();
  while (const std::optional<BagRecord> record = takeRecord(bytes)) {
    const auto operation = record->operation();
    if (operation == rosbag::OP_CONNECTION) continue;
    const auto connection = record->field<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME);
    const auto time = record->time(rosbag::TIME_FIELD_NAME);
    if (operation != rosbag::OP_MSG_DATA || !connection || !time || *time < chunk.start || *time > chunk.end)
      throw damagedChunk(path);
    messages.push_back({*connection, *time, record->body});
  }
  if (!bytes.empty() || messages.size() != chunk.num_messages) throw damagedChunk(path);
  if (!std::is_sorted(messages.begin(), messages.end(), isInOrder))
    std::stable_sort(messages.begin(), messages.end(), isInOrder);
}

}  // namespace

BagFile::BagFile(const std::string& path) : path_(path) {
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (error) throw InputError(path + ": cannot be read: " + error.message());
  try {
    file_.openRead(path);
  } catch (const rosbag::BagException&) {
    throw InputError(path + ": cannot be read");
  }
  if (size_ < sizeof(kMagic) || file_.getline() != std::string(kMagic) + '\n')
    throw InputError(path + ": is not a bag of format 2.0 (rosbag check tells, rosbag fix mends older ones)");
  readBlock("bag header", header_);
  const BagRecord record{header_.view(), {}};
  if (!text(findField(record.header, rosbag::ENCRYPTOR_FIELD_NAME)).empty())
    throw InputError(path + ": is encrypted (rosbag decrypt makes a bag that can be read)");
  const auto contents = record.field<std::uint64_t>(rosbag::INDEX_POS_FIELD_NAME);
  const auto num_connections = record.field<std::uint32_t>(rosbag::CONNECTION_COUNT_FIELD_NAME);
  const auto num_chunks = record.field<std::uint32_t>(rosbag::CHUNK_COUNT_FIELD_NAME);
  if (record.operation() != rosbag::OP_FILE_HEADER || !contents || !num_connections || !num_chunks)
    throw InputError(path + ": the bag header is damaged");
  if (*contents == 0) throw InputError(path + ": was not closed by its recorder (rosbag reindex repairs it)");
  if (*contents > size_) throw InputError(path + ": is cut off (rosbag reindex saves what is left)");
  readContents(*contents, *num_connections, *num_chunks);
}

void BagFile::readContents(std::uint64_t position, std::uint32_t num_connections, std::uint32_t num_chunks) {
  file_.seek(position);
  BagBytes bytes;
  readBytes(size_ - position, "table of contents", bytes);
  std::string_view rest = bytes.view();
  while (const std::optional<BagRecord> record = takeRecord(rest)) {
    if (record->operation() == rosbag::OP_CONNECTION) {
      connections_.push_back({record->field<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME).value_or(0),
                              text(findField(record->header, rosbag::TOPIC_FIELD_NAME)),
                              text(findField(record->body, "type")), text(findField(record->body, "md5sum"))});
    } else if (record->operation() == rosbag::OP_CHUNK_INFO) {
      chunks_.push_back(toChunk(*record, path_));
    }
  }
  if (connections_.size() != num_connections || chunks_.size() != num_chunks)
    throw InputError(path_ + ": is cut off inside its table of contents (rosbag reindex saves what is left)");
}

void BagFile::read(const BagChunk& chunk, ChunkContents& contents) {
  readChunkBytes(chunk, contents.bytes);
  parseMessages(path_, chunk, contents.bytes.view(), contents.messages);
}

void BagFile::readChunkBytes(const BagChunk& chunk, BagBytes& bytes) {
  if (chunk.position > size_) throw InputError(path_ + ": is cut off, or damaged (rosbag reindex saves what is left)");
  file_.seek(chunk.position);
  readBlock("chunk header", header_);
  const BagRecord record{header_.view(), {}};
  const std::string compression = text(findField(record.header, rosbag::COMPRESSION_FIELD_NAME));
  const auto size = record.field<std::uint32_t>(rosbag::SIZE_FIELD_NAME);
  if (record.operation() != rosbag::OP_CHUNK || !size || *size > kLargestChunk) throw damagedChunk(path_);
  if (compression == "none") return readBlock("chunk", bytes);
  readBlock("chunk", compressed_);
  resize(bytes, *size);
  try {
    file_.decompress(compression == "lz4" ? rosbag::compression::LZ4 : rosbag::compression::BZ2,
                     reinterpret_cast<std::uint8_t*>(bytes.begin()), *size,
                     reinterpret_cast<std::uint8_t*>(compressed_.begin()),
                     static_cast<unsigned int>(compressed_.view().size()));
  } catch (const rosbag::BagException&) {
    throw damagedChunk(path_);
  }
}

void BagFile::resize(BagBytes& bytes, std::uint64_t size) const {
  if (!bytes.resize(size)) throw InputError(path_ + ": does not fit into the memory of this machine");
}

void BagFile::readBytes(std::uint64_t size, const char* what, BagBytes& bytes) {
  const auto cutOff = [&] {
    return InputError(path_ + ": is cut off inside a " + what + " (rosbag reindex saves what is left)");
  };
  if (size > size_ - std::min(file_.getOffset(), size_)) throw cutOff();
  resize(bytes, size);
  try {
    file_.read(bytes.begin(), size);
  } catch (const rosbag::BagException&) {
    throw cutOff();
  }
}

void BagFile::readBlock(const char* what, BagBytes& bytes) {
  readBytes(sizeof(std::uint32_t), what, bytes);
  readBytes(*toInteger<std::uint32_t>(bytes.view()), what, bytes);
}

}  // namespace suspension_health_monitor
