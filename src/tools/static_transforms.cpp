#include <tf2_msgs/TFMessage.h>

#include <algorithm>

#include "bag_file.h"
#include "imu_bags.h"

namespace suspension_health_monitor {
std::shared_ptr<const tf2::BufferCore> readStaticTransforms(const std::vector<std::string>& paths) {
  constexpr const char* kTopic = "/tf_static";
  const auto transforms = std::make_shared<tf2::BufferCore>();
  ChunkContents contents;
  tf2_msgs::TFMessage tree;
  for (const std::string& path : paths) {
    BagFile file(path);
    const std::vector<std::uint32_t> connections = connectionsOf<tf2_msgs::TFMessage>(file, kTopic);
    if (connections.empty())
      throw InputError(path + ": no topic " + kTopic + ", needed since target_frame or the frame of a strut is set");
    const auto is_wanted = [&](std::uint32_t connection) {
      return std::find(connections.begin(), connections.end(), connection) != connections.end();
    };
    for (const BagChunk& chunk : file.chunks()) {
      if (std::none_of(chunk.connections.begin(), chunk.connections.end(), is_wanted)) continue;
      file.read(chunk, contents);
      for (const BagMessage& message : contents.messages) {
        if (!is_wanted(message.connection)) continue;
        decode(file, message, std::string(" on ") + kTopic, tree);
        for (const geometry_msgs::TransformStamped& transform : tree.transforms)
          transforms->setTransform(transform, path, true);
      }
    }
  }
  return transforms;
}

}  // namespace suspension_health_monitor
