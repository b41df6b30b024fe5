#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <set>

#include "bag_file.h"
#include "imu_bags.h"

namespace suspension_health_monitor {
namespace {

constexpr const char* kTopic = "/tf_static";

std::set<std::uint32_t> findConnections(const BagFile& file) {
  std::set<std::uint32_t> connections;
  for (const BagConnection& connection : file.connections()) {
    if (connection.topic != kTopic) continue;
    requireType<tf2_msgs::TFMessage>(file, connection);
    connections.insert(connection.id);
  }
  if (connections.empty())
    throw InputError(file.path() + ": no topic " + kTopic +
                     ", needed since target_frame or the frame of a strut is set");
  return connections;
}

void readTransforms(BagFile& file, const BagMessage& message, tf2::BufferCore& transforms) {
  tf2_msgs::TFMessage tree;
  decode(file, message, std::string(" on ") + kTopic, tree);
  for (const geometry_msgs::TransformStamped& transform : tree.transforms)
    transforms.setTransform(transform, file.path(), true);
}

}  // namespace

std::shared_ptr<const tf2::BufferCore> readStaticTransforms(const std::vector<std::string>& paths) {
  const auto transforms = std::make_shared<tf2::BufferCore>();
  ChunkContents contents;
  for (const std::string& path : paths) {
    BagFile file(path);
    const std::set<std::uint32_t> connections = findConnections(file);
    const auto is_wanted = [&](std::uint32_t connection) { return connections.count(connection) != 0; };
    for (const BagChunk& chunk : file.chunks()) {
      if (std::none_of(chunk.connections.begin(), chunk.connections.end(), is_wanted)) continue;
      file.read(chunk, contents);
      for (const BagMessage& message : contents.messages)
        if (is_wanted(message.connection)) readTransforms(file, message, *transforms);
    }
  }
  return transforms;
}

}  // namespace suspension_health_monitor
