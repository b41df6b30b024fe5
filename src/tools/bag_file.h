#pragma once

#include <rosbag/chunked_file.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace suspension_health_monitor {

/// A topic in a bag, as one publisher declared it.
struct BagConnection {
  std::uint32_t id = 0;
  std::string topic, type, md5sum;
};

/// Where a chunk of messages stands and which recording times it spans [ns].
struct BagChunk {
  std::uint64_t position = 0;
  std::uint64_t start = 0, end = 0;
};

/// One message inside a chunk; `body` is valid as long as the chunk's bytes are.
struct BagMessage {
  std::uint32_t connection = 0;
  std::uint64_t time = 0;  // recording time [ns]
  std::string_view body;
};

/// A bag of format 2.0, read chunk by chunk, so that memory does not grow with the bag: rosbag::Bag loads an index entry
/// per message (about 64 bytes each). Reading and decompression are rosbag's ChunkedFile.
/// Source of the layout: wiki.ros.org/Bags/Format/2.0.
class BagFile {
 public:
  /// Opens the bag and reads its table of contents.
  /// @throws InputError  if it is no bag, was not closed by its recorder, is cut off, or is encrypted.
  explicit BagFile(const std::string& path);

  const std::string& path() const { return path_; }
  const std::vector<BagConnection>& connections() const { return connections_; }
  const std::vector<BagChunk>& chunks() const { return chunks_; }

  /// @return true if every chunk begins after the one before it has ended: then reading them in order is reading in time.
  bool chunksAreOrdered() const;

  /// Reads one chunk.
  /// @param bytes  storage for it.
  /// @return its messages in the order of recording time.
  /// @throws InputError  if the chunk is damaged.
  std::vector<BagMessage> read(const BagChunk& chunk, std::vector<char>& bytes);

 private:
  void readContents(std::uint64_t position, std::uint32_t num_connections, std::uint32_t num_chunks);
  std::vector<char> readBytes(std::uint32_t size, const char* what);
  std::vector<char> readBlock(const char* what);  // a length and that many bytes

  std::string path_;
  rosbag::ChunkedFile file_;
  std::uint64_t size_ = 0;
  std::vector<BagConnection> connections_;
  std::vector<BagChunk> chunks_;
  std::vector<char> compressed_;
};

}  // namespace suspension_health_monitor
