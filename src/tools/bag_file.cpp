#include "bag_file.h"

#include <rosbag/constants.h>
#include <rosbag/exceptions.h>

#include <filesystem>

namespace suspension_health_monitor {
namespace {

constexpr char kMagic[] = "#ROSBAG V2.0";
constexpr std::uint32_t kLargestChunk = 1U << 30U;

std::string text(std::optional<std::string_view> bytes) { return std::string(bytes.value_or(std::string_view())); }

bool isInOrder(const BagMessage& a, const BagMessage& b) { return a.time < b.time; }

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
      chunks_.push_back(toChunk(*record));
    }
  }
  if (connections_.size() != num_connections || chunks_.size() != num_chunks)
    throw InputError(path_ + ": is cut off inside its table of contents (rosbag reindex saves what is left)");
}

BagChunk BagFile::toChunk(const BagRecord& record) const {
  const auto position = record.field<std::uint64_t>(rosbag::CHUNK_POS_FIELD_NAME);
  const auto start = record.time(rosbag::START_TIME_FIELD_NAME);
  const auto end = record.time(rosbag::END_TIME_FIELD_NAME);
  if (!position || !start || !end)
    throw InputError(path_ + ": the table of contents is damaged (rosbag reindex repairs it)");
  BagChunk chunk{*position, *start, *end, 0, {}};
  constexpr std::size_t kEntry = 8;  // connection and number of its messages, 32 bit each
  for (std::string_view rest = record.body; rest.size() >= kEntry; rest.remove_prefix(kEntry)) {
    chunk.connections.push_back(*toInteger<std::uint32_t>(rest.substr(0, kEntry / 2)));
    chunk.num_messages += *toInteger<std::uint32_t>(rest.substr(kEntry / 2, kEntry / 2));
  }
  return chunk;
}

void BagFile::read(const BagChunk& chunk, ChunkContents& contents) {
  readChunkBytes(chunk, contents.bytes);
  parseMessages(chunk, contents.bytes.view(), contents.messages);
}

void BagFile::readChunkBytes(const BagChunk& chunk, BagBytes& bytes) {
  if (chunk.position > size_) throw InputError(path_ + ": is cut off, or damaged (rosbag reindex saves what is left)");
  file_.seek(chunk.position);
  readBlock("chunk header", header_);
  const BagRecord record{header_.view(), {}};
  const std::string compression = text(findField(record.header, rosbag::COMPRESSION_FIELD_NAME));
  const auto size = record.field<std::uint32_t>(rosbag::SIZE_FIELD_NAME);
  if (record.operation() != rosbag::OP_CHUNK || !size || *size > kLargestChunk) throw damagedChunk();
  if (compression == "none") return readBlock("chunk", bytes);
  readBlock("chunk", compressed_);
  resize(bytes, *size);
  try {
    file_.decompress(compression == "lz4" ? rosbag::compression::LZ4 : rosbag::compression::BZ2,
                     reinterpret_cast<std::uint8_t*>(bytes.begin()), *size,
                     reinterpret_cast<std::uint8_t*>(compressed_.begin()),
                     static_cast<unsigned int>(compressed_.view().size()));
  } catch (const rosbag::BagException&) {
    throw damagedChunk();
  }
}

void BagFile::parseMessages(const BagChunk& chunk, std::string_view bytes, std::vector<BagMessage>& messages) const {
  messages.clear();
  while (const std::optional<BagRecord> record = takeRecord(bytes)) {
    const auto operation = record->operation();
    if (operation == rosbag::OP_CONNECTION) continue;
    const auto connection = record->field<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME);
    const auto time = record->time(rosbag::TIME_FIELD_NAME);
    if (operation != rosbag::OP_MSG_DATA || !connection || !time || *time < chunk.start || *time > chunk.end)
      throw damagedChunk();
    messages.push_back({*connection, *time, record->body});
  }
  if (!bytes.empty() || messages.size() != chunk.num_messages) throw damagedChunk();
  if (!std::is_sorted(messages.begin(), messages.end(), isInOrder))
    std::stable_sort(messages.begin(), messages.end(), isInOrder);
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

InputError BagFile::damagedChunk() const {
  return InputError(path_ + ": a chunk is damaged (rosbag reindex saves the others)");
}

}  // namespace suspension_health_monitor
