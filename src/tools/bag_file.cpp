#include "bag_file.h"

#include <rosbag/constants.h>
#include <rosbag/exceptions.h>

#include <algorithm>
#include <filesystem>

#include "bag_record.h"
#include "errors.h"

namespace suspension_health_monitor {
namespace {

constexpr char kMagic[] = "#ROSBAG V2.0";
constexpr std::uint32_t kLargestChunk = 1U << 30U;

std::string_view view(const std::vector<char>& bytes) { return {bytes.data(), bytes.size()}; }

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
    throw InputError(path + ": is not a bag of format 2.0 (rosbag check tells, rosbag migrate mends older ones)");
  const std::vector<char> header = readBlock("bag header");
  const BagRecord record{view(header), {}};
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
  const std::vector<char> bytes = readBytes(static_cast<std::uint32_t>(size_ - position), "table of contents");
  std::string_view rest = view(bytes);
  while (const std::optional<BagRecord> record = takeRecord(rest)) {
    if (record->operation() == rosbag::OP_CONNECTION) {
      connections_.push_back({record->field<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME).value_or(0),
                              text(findField(record->header, rosbag::TOPIC_FIELD_NAME)),
                              text(findField(record->body, "type")), text(findField(record->body, "md5sum"))});
    } else if (record->operation() == rosbag::OP_CHUNK_INFO) {
      chunks_.push_back({record->field<std::uint64_t>(rosbag::CHUNK_POS_FIELD_NAME).value_or(0),
                         record->time(rosbag::START_TIME_FIELD_NAME).value_or(0),
                         record->time(rosbag::END_TIME_FIELD_NAME).value_or(0)});
    }
  }
  if (connections_.size() != num_connections || chunks_.size() != num_chunks)
    throw InputError(path_ + ": is cut off inside its table of contents (rosbag reindex saves what is left)");
}

bool BagFile::chunksAreOrdered() const {
  return std::adjacent_find(chunks_.begin(), chunks_.end(), [](const BagChunk& a, const BagChunk& b) {
           return b.start < a.end || b.position < a.position;
         }) == chunks_.end();
}

std::vector<BagMessage> BagFile::read(const BagChunk& chunk, std::vector<char>& bytes) {
  file_.seek(chunk.position);
  const std::vector<char> header_bytes = readBlock("chunk header");
  const std::string_view header = view(header_bytes);
  const std::string compression = text(findField(header, rosbag::COMPRESSION_FIELD_NAME));
  const auto size = toInteger<std::uint32_t>(findField(header, rosbag::SIZE_FIELD_NAME));
  const auto damaged = [this] { return InputError(path_ + ": a chunk is damaged (rosbag reindex saves the others)"); };
  if (BagRecord{header, {}}.operation() != rosbag::OP_CHUNK || !size || *size > kLargestChunk) throw damaged();
  compressed_ = readBlock("chunk");
  if (compression == "none") {
    bytes.swap(compressed_);
  } else {
    const auto codec = compression == "lz4" ? rosbag::compression::LZ4 : rosbag::compression::BZ2;
    bytes.resize(*size);
    try {
      file_.decompress(codec, reinterpret_cast<std::uint8_t*>(bytes.data()), *size,
                       reinterpret_cast<std::uint8_t*>(compressed_.data()),
                       static_cast<unsigned int>(compressed_.size()));
    } catch (const rosbag::BagException&) {
      throw damaged();
    }
  }
  std::vector<BagMessage> messages;
  std::string_view rest = view(bytes);
  while (const std::optional<BagRecord> record = takeRecord(rest)) {
    if (record->operation() != rosbag::OP_MSG_DATA) continue;
    const auto connection = record->field<std::uint32_t>(rosbag::CONNECTION_FIELD_NAME);
    const auto time = record->time(rosbag::TIME_FIELD_NAME);
    if (!connection || !time) throw damaged();
    messages.push_back({*connection, *time, record->body});
  }
  if (!rest.empty()) throw damaged();
  if (!std::is_sorted(messages.begin(), messages.end(), isInOrder))
    std::stable_sort(messages.begin(), messages.end(), isInOrder);
  return messages;
}

std::vector<char> BagFile::readBytes(std::uint32_t size, const char* what) {
  std::vector<char> bytes(size);
  try {
    if (file_.getOffset() + size > size_) throw rosbag::BagIOException("beyond the end");
    file_.read(bytes.data(), size);
  } catch (const rosbag::BagException&) {
    throw InputError(path_ + ": is cut off inside a " + what + " (rosbag reindex saves what is left)");
  }
  return bytes;
}

std::vector<char> BagFile::readBlock(const char* what) {
  const std::vector<char> size = readBytes(sizeof(std::uint32_t), what);
  return readBytes(*toInteger<std::uint32_t>(view(size)), what);
}

}  // namespace suspension_health_monitor
