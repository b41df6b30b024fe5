#include "imu_bags.h"

#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <map>
#include <optional>

#include "bag_file.h"
#include "errors.h"
#include "progress.h"

namespace suspension_health_monitor {
namespace {

using Take = std::function<bool(Side, const sensor_msgs::Imu&)>;
using ImuTraits = ros::message_traits::MD5Sum<sensor_msgs::Imu>;

std::string listImuTopics(const std::vector<BagConnection>& connections) {
  std::string list;
  for (const BagConnection& connection : connections)
    if (connection.md5sum == ImuTraits::value() && list.find(connection.topic) == std::string::npos)
      list += (list.empty() ? "" : ", ") + connection.topic;
  return list.empty() ? "none" : list;
}

/// Which connections carry which IMU.
std::map<std::uint32_t, Side> findSides(const BagFile& file, const std::array<std::string, 2>& topics) {
  static constexpr std::array<const char*, 2> kOptions{"--sprung-topic", "--unsprung-topic"};
  std::map<std::uint32_t, Side> sides;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    bool found = false;
    for (const BagConnection& connection : file.connections()) {
      if (connection.topic != topics[i]) continue;
      if (connection.md5sum != ImuTraits::value())
        throw InputError(file.path() + ": topic " + topics[i] + " is " + connection.type +
                         ", must be sensor_msgs/Imu");
      sides[connection.id] = static_cast<Side>(i);
      found = true;
    }
    if (!found)
      throw InputError(file.path() + ": no topic " + topics[i] + " (" + kOptions[i] +
                       "); Imu topics in this bag: " + listImuTopics(file.connections()));
  }
  return sides;
}

bool deliver(Side side, std::string_view body, const std::string& path, sensor_msgs::Imu& imu, const Take& take) {
  ros::serialization::IStream stream(reinterpret_cast<std::uint8_t*>(const_cast<char*>(body.data())),
                                     static_cast<std::uint32_t>(body.size()));
  try {
    ros::serialization::deserialize(stream, imu);
  } catch (const ros::Exception&) {
    throw InputError(path + ": a message is damaged");
  }
  return take(side, imu);
}

struct Range {
  std::uint64_t first, last;  // recording time [ns]
};

Range toRange(const ImuBags& bags, const std::vector<BagChunk>& chunks) {
  const auto earliest = std::min_element(chunks.begin(), chunks.end(),
                                         [](const BagChunk& a, const BagChunk& b) { return a.start < b.start; });
  const auto after = [&](double seconds) {
    constexpr double kFarFuture = 1e9;  // [s]
    return earliest->start + static_cast<std::uint64_t>(1e9 * std::clamp(seconds, 0.0, kFarFuture));
  };
  return {after(bags.start), after(bags.end)};
}

bool readByChunks(BagFile& file, const std::map<std::uint32_t, Side>& sides, const Range& range, const Take& take) {
  Progress progress("reading " + file.path(), static_cast<double>(file.chunks().size()));
  std::vector<char> bytes;
  sensor_msgs::Imu imu;
  double done = 0.0;
  for (const BagChunk& chunk : file.chunks()) {
    progress.update(++done);
    if (chunk.end < range.first || chunk.start > range.last) continue;
    for (const BagMessage& message : file.read(chunk, bytes)) {
      const auto side = sides.find(message.connection);
      if (side == sides.end() || message.time < range.first || message.time > range.last) continue;
      if (!deliver(side->second, message.body, file.path(), imu, take)) return false;
    }
  }
  return true;
}

bool readSorted(const ImuBags& bags, const std::string& path, const Range& range, const Take& take) {
  rosbag::Bag bag(path);
  ros::Time first, last;
  first.fromNSec(range.first);
  last.fromNSec(range.last);
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>(bags.topics.begin(), bags.topics.end())), first,
                    last);
  Progress progress("reading " + path, view.size());
  double done = 0.0;
  for (const rosbag::MessageInstance& message : view) {
    progress.update(++done);
    const sensor_msgs::ImuConstPtr imu = message.instantiate<sensor_msgs::Imu>();
    const Side side = message.getTopic() == bags.topics.front() ? Side::kSprung : Side::kUnsprung;
    if (imu != nullptr && !take(side, *imu)) return false;
  }
  return true;
}

}  // namespace

void readImuMessages(const ImuBags& bags, const Take& take) {
  for (const std::string& path : bags.paths) {
    BagFile file(path);
    if (file.chunks().empty()) throw TooLittleError(path + ": the bag holds no messages");
    const std::map<std::uint32_t, Side> sides = findSides(file, bags.topics);
    const Range range = toRange(bags, file.chunks());
    const bool wants_more =
        file.chunksAreOrdered() ? readByChunks(file, sides, range, take) : readSorted(bags, path, range, take);
    if (!wants_more) return;
  }
}

}  // namespace suspension_health_monitor
