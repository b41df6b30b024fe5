#pragma once

#include <ros/serialization.h>
#include <rosbag/chunked_file.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "command.h"

namespace suspension_health_monitor {

/// A topic in a bag, as one publisher declared it.
struct BagConnection {
  std::uint32_t id = 0;
  std::string topic, type, md5sum;
};

/// Where a chunk of messages stands, which recording times it spans [ns], and how many messages it holds, of which
/// connections.
struct BagChunk {
  std::uint64_t position = 0, start = 0, end = 0, num_messages = 0;
  std::vector<std::uint32_t> connections;
};

/// One message inside a chunk.
struct BagMessage {
  std::uint32_t connection = 0;
  std::uint64_t time = 0;  // recording time [ns]
  std::string_view body;
};

/// Storage that is used again. It grows by calloc, which costs nothing before it is written: a damaged bag may ask for
/// far more than it fills.
class BagBytes {
 public:
  /// Makes room for `size` bytes. What was there is lost.
  /// @return false if there is not so much memory.
  bool resize(std::size_t size) {
    if (size > capacity_ || bytes_ == nullptr) {
      bytes_.reset(static_cast<char*>(std::calloc(size + 1, 1)));
      capacity_ = bytes_ == nullptr ? 0 : size;
    }
    size_ = std::min(size, capacity_);
    return bytes_ != nullptr;
  }
  char* begin() { return bytes_.get(); }
  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  struct Free {
    void operator()(char* bytes) const { std::free(bytes); }
  };
  std::unique_ptr<char[], Free> bytes_;
  std::size_t size_ = 0, capacity_ = 0;
};

/// The messages of a chunk in the order of recording time; their bodies are valid as long as the bytes are.
struct ChunkContents {
  BagBytes bytes;
  std::vector<BagMessage> messages;
};

/// A bag of format 2.0, read chunk by chunk, so that memory does not grow with the bag: rosbag::Bag loads an index
/// entry per message (about 64 bytes each). Reading and decompression are rosbag's ChunkedFile. Source of the layout:
/// wiki.ros.org/Bags/Format/2.0.
class BagFile {
 public:
  /// Opens the bag and reads its table of contents.
  /// @throws InputError  if it is no bag, was not closed by its recorder, is cut off, or is encrypted.
  explicit BagFile(const std::string& path);

  const std::string& path() const { return path_; }
  const std::vector<BagConnection>& connections() const { return connections_; }
  const std::vector<BagChunk>& chunks() const { return chunks_; }

  /// Reads one chunk.
  /// @param contents  storage for it.
  /// @throws InputError  if the chunk is damaged, or is not what the table of contents says of it.
  void read(const BagChunk& chunk, ChunkContents& contents);

 private:
  void readContents(std::uint64_t position, std::uint32_t num_connections, std::uint32_t num_chunks);
  void readChunkBytes(const BagChunk& chunk, BagBytes& bytes);
  void resize(BagBytes& bytes, std::uint64_t size) const;
  void readBytes(std::uint64_t size, const char* what, BagBytes& bytes);
  void readBlock(const char* what, BagBytes& bytes);  // a length and that many bytes

  std::string path_;
  rosbag::ChunkedFile file_;
  std::uint64_t size_ = 0;
  std::vector<BagConnection> connections_;
  std::vector<BagChunk> chunks_;
  BagBytes header_, compressed_;
};

/// @return true if the connection carries such messages.
template <class Message>
bool carries(const BagConnection& connection) {
  return connection.md5sum == ros::message_traits::MD5Sum<Message>::value();
}

/// @return the topics with such messages, in the order in which they were declared.
template <class Message>
std::vector<std::string> topicsWith(const BagFile& file) {
  std::vector<std::string> topics;
  for (const BagConnection& connection : file.connections())
    if (carries<Message>(connection) && std::find(topics.begin(), topics.end(), connection.topic) == topics.end())
      topics.push_back(connection.topic);
  return topics;
}

/// @return the connections that carry a topic.
/// @throws InputError  if one carries other messages.
template <class Message>
std::vector<std::uint32_t> connectionsOf(const BagFile& file, const std::string& topic) {
  std::vector<std::uint32_t> found;
  for (const BagConnection& connection : file.connections()) {
    if (connection.topic != topic) continue;
    if (!carries<Message>(connection))
      throw InputError(file.path() + ": topic " + connection.topic + " is " + connection.type + ", must be " +
                       ros::message_traits::DataType<Message>::value());
    found.push_back(connection.id);
  }
  return found;
}

/// @param where  " on TOPIC", for the error, or empty.
/// @throws InputError  if the message is damaged.
template <class Message>
void decode(const BagFile& file, const BagMessage& message, const std::string& where, Message& into) {
  ros::serialization::IStream stream(reinterpret_cast<std::uint8_t*>(const_cast<char*>(message.body.data())),
                                     static_cast<std::uint32_t>(message.body.size()));
  try {
    ros::serialization::deserialize(stream, into);
  } catch (const ros::Exception&) {
    throw InputError(file.path() + ": a message" + where + " is damaged");
  }
}

}  // namespace suspension_health_monitor
