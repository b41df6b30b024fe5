#include "imu_bags.h"

#include <algorithm>
#include <cstdint>
#include <future>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "../ros/conversions.h"
#include "bag_file.h"
#include "command.h"
#include "long_work.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

/// For every connection of a bag the topic that it carries, by its place, if that is wanted.
using Places = std::map<std::uint32_t, std::optional<std::size_t>>;

/// @param kind  of the messages, in a word.  @param place  of the topic.
template <class Message>
void findTopic(const BagFile& file, const BagTopic& topic, const char* kind, std::size_t place, Places& places) {
  const std::vector<std::uint32_t> connections = connectionsOf<Message>(file, topic.name);
  for (const std::uint32_t connection : connections) places[connection] = place;
  if (!connections.empty()) return;
  const std::vector<std::string> others = topicsWith<Message>(file);
  throw InputError(file.path() + ": no topic " + topic.name + " (" + topic.named_by + "); " + kind +
                   " topics in this bag: " + (others.empty() ? "none" : join(others)));
}

Places findPlaces(const BagFile& file, const ImuBags& bags, bool with_temperatures) {
  Places places;
  for (const BagConnection& connection : file.connections()) places[connection.id] = std::nullopt;
  for (std::size_t i = 0; i < bags.topics.size(); ++i)
    bags.topics[i].is_force ? findTopic<geometry_msgs::WrenchStamped>(file, bags.topics[i], "WrenchStamped", i, places)
                            : findTopic<sensor_msgs::Imu>(file, bags.topics[i], "Imu", i, places);
  for (std::size_t i = 0; i < bags.temperature_topics.size(); ++i)
    for (const std::uint32_t connection : connectionsOf<sensor_msgs::Temperature>(file, bags.temperature_topics[i]))
      if (with_temperatures) places[connection] = bags.topics.size() + i;
  return places;
}

/// Which recording times [ns] are read.
struct Range {
  std::uint64_t first, last;

  bool contains(std::uint64_t time) const { return time >= first && time <= last; }
  bool overlaps(const BagChunk& chunk) const { return chunk.end >= first && chunk.start <= last; }
};

Range toRange(const ImuBags& bags, std::uint64_t beginning) {
  constexpr double kFarFuture = 1e9;  // [s]
  const auto after = [&](double seconds) { return beginning + static_cast<std::uint64_t>(1e9 * seconds); };
  return {after(std::min(bags.start, kFarFuture)),
          bags.end < kFarFuture ? after(bags.end) : std::numeric_limits<std::uint64_t>::max()};
}

/// A message that is wanted, decoded.
struct Message {
  std::uint64_t time = 0;  // of its recording [ns]
  std::size_t place = 0;   // of its topic, among those of sensors, or of temperatures
  std::variant<sensor_msgs::Imu, geometry_msgs::WrenchStamped, sensor_msgs::Temperature> body;
};

/// A chunk with messages that have not been delivered. Its storage is used again.
struct OpenChunk {
  std::uint64_t position = 0;
  std::vector<Message> messages;
  std::size_t next = 0, end = 0;  // of `messages`

  const Message& message() const { return messages[next]; }
  bool isDone() const { return next == end; }
};

/// Of messages at the same time the one that was written first is the earlier one.
bool isEarlier(const OpenChunk& a, const OpenChunk& b) {
  return std::tie(a.message().time, a.position) < std::tie(b.message().time, b.position);
}

/// Reads and decodes chunks of one bag.
class ChunkReader {
 public:
  ChunkReader(BagFile& file, const ImuBags& bags, const Range& range, bool with_temperatures)
      : file_(file), topics_(bags.topics), places_(findPlaces(file, bags, with_temperatures)), range_(range) {}

  void read(const BagChunk& from, OpenChunk& chunk) {
    file_.read(from, contents_);
    chunk.position = from.position;
    chunk.next = chunk.end = 0;
    for (const BagMessage& message : contents_.messages) {
      const auto place = places_.find(message.connection);
      if (place == places_.end()) throw InputError(file_.path() + ": a message of a topic that the bag does not list");
      if (!place->second || !range_.contains(message.time)) continue;
      if (chunk.end == chunk.messages.size()) chunk.messages.emplace_back();
      Message& decoded = chunk.messages[chunk.end++];
      const std::size_t topic = *place->second;
      if (topic >= topics_.size())
        decodeInto<sensor_msgs::Temperature>(message, topic - topics_.size(), decoded);
      else if (topics_[topic].is_force)
        decodeInto<geometry_msgs::WrenchStamped>(message, topic, decoded);
      else
        decodeInto<sensor_msgs::Imu>(message, topic, decoded);
    }
  }

 private:
  template <class Body>
  void decodeInto(const BagMessage& message, std::size_t place, Message& decoded) const {
    decoded.time = message.time;
    decoded.place = place;
    if (!std::holds_alternative<Body>(decoded.body)) decoded.body.emplace<Body>();
    decode(file_, message, "", std::get<Body>(decoded.body));
  }

  BagFile& file_;
  const std::vector<BagTopic>& topics_;
  Places places_;
  Range range_;
  ChunkContents contents_;  // of the newest chunk
};

/// Delivers the messages of one bag by recording time. Its chunks are opened in the order in which they begin and
/// kept as long as they have messages that are later than the beginning of the next one.
class Delivery {
 public:
  Delivery(const TopicSinks& take, TopicGaps* gaps) : take_(take), gaps_(gaps) {}

  /// @return storage of a chunk that is done, to be used again.
  OpenChunk spare() { return std::exchange(spare_, {}); }

  void open(OpenChunk chunk) {
    if (!chunk.isDone()) open_.push_back(std::move(chunk));
  }

  /// @return false if no more messages are wanted.
  bool deliverBefore(std::uint64_t time) {
    while (!open_.empty()) {
      const auto earliest = std::min_element(open_.begin(), open_.end(), isEarlier);
      if (earliest->message().time >= time) break;
      if (!deliver(earliest->message())) return false;
      ++earliest->next;
      if (!earliest->isDone()) continue;
      spare_ = std::move(*earliest);
      open_.erase(earliest);
    }
    return true;
  }

 private:
  bool deliver(const Message& message) {
    Interruption::check();
    const Stamp recorded(static_cast<Stamp::rep>(message.time));
    if (const auto* temperature = std::get_if<sensor_msgs::Temperature>(&message.body))
      return take_.temperature(message.place, *temperature, recorded);
    const auto give = [&](const auto& reading, const auto& take) {
      if (gaps_ != nullptr) gaps_->note(message.place, toStamp(reading.header.stamp));
      return take(message.place, reading, recorded);
    };
    if (const auto* imu = std::get_if<sensor_msgs::Imu>(&message.body)) return give(*imu, take_.imu);
    return give(std::get<geometry_msgs::WrenchStamped>(message.body), take_.wrench);
  }

  const TopicSinks& take_;
  TopicGaps* gaps_;
  std::vector<OpenChunk> open_;  // as many as overlap in time, mostly one or two
  OpenChunk spare_;              // storage of a chunk that is done
};

bool readBag(BagFile& file, const ImuBags& bags, const TopicSinks& take) {
  std::vector<BagChunk> chunks = file.chunks();
  std::stable_sort(chunks.begin(), chunks.end(),
                   [](const BagChunk& a, const BagChunk& b) { return a.start < b.start; });
  const Range range = toRange(bags, chunks.front().start);
  chunks.erase(std::remove_if(chunks.begin(), chunks.end(), [&](const BagChunk& c) { return !range.overlaps(c); }),
               chunks.end());
  ChunkReader reader(file, bags, range, take.temperature != nullptr);
  Delivery delivery(take, bags.gaps);
  Progress progress("reading " + file.path(), static_cast<double>(chunks.size()));
  // While the messages of a chunk are used, another thread reads and decodes the next, which takes a quarter of the
  // time of `identify`. Without that thread it is done when the chunk is wanted.
  const std::launch launch = bags.reads_ahead ? std::launch::async : std::launch::deferred;
  const auto begin = [&](std::size_t at) {
    return std::async(launch, [&reader, &coming = chunks[at], chunk = delivery.spare()]() mutable {
      reader.read(coming, chunk);
      return std::move(chunk);
    });
  };
  std::future<OpenChunk> next;  // last: its thread, which uses all else, is waited for first
  if (!chunks.empty()) next = begin(0);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    progress.update(static_cast<double>(i + 1));
    if (!delivery.deliverBefore(chunks[i].start)) return false;
    OpenChunk chunk = next.get();
    if (i + 1 < chunks.size()) next = begin(i + 1);
    delivery.open(std::move(chunk));
  }
  return delivery.deliverBefore(std::numeric_limits<std::uint64_t>::max());
}

}  // namespace

std::vector<std::string> ImuBags::neededTopics() const {
  std::vector<std::string> needed;
  for (const BagTopic& topic : topics)
    if (topic.is_needed) needed.push_back(topic.name);
  return needed;
}

ImuBags ImuBags::of(const std::string& path, TopicGaps& its_gaps) const {
  ImuBags bag = *this;
  bag.paths = {path};
  bag.gaps = &its_gaps;
  return bag;
}

void readTopics(const ImuBags& bags, const TopicSinks& take) {
  for (const std::string& path : bags.paths) {
    BagFile file(path);
    if (file.chunks().empty()) throw TooLittleError(path + ": the bag holds no messages");
    if (bags.gaps != nullptr) bags.gaps->beginBag(path, bags.neededTopics());
    const bool goes_on = readBag(file, bags, take);
    if (bags.gaps != nullptr) bags.gaps->finishBag();
    if (!goes_on) return;
  }
}

}  // namespace suspension_health_monitor
