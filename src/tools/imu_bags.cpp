#include "imu_bags.h"

#include <algorithm>
#include <cstdint>
#include <future>
#include <map>
#include <tuple>
#include <utility>

#include "../ros/conversions.h"
#include "bag_file.h"
#include "command.h"
#include "long_work.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

template <class Message>
std::string listTopics(const std::vector<BagConnection>& connections) {
  std::vector<std::string> list;
  for (const BagConnection& connection : connections)
    if (carries<Message>(connection) && std::find(list.begin(), list.end(), connection.topic) == list.end())
      list.push_back(connection.topic);
  return list.empty() ? "none" : join(list);
}

/// For every connection of a bag the topic that it carries, by its place, if that is wanted.
using Places = std::map<std::uint32_t, std::optional<std::size_t>>;

/// @param kind  of the messages, in a word.  @param place  of the topic.
template <class Message>
void findTopic(const BagFile& file, const BagTopic& topic, const char* kind, std::size_t place, Places& places) {
  const std::vector<std::uint32_t> connections = connectionsOf<Message>(file, topic.name);
  for (const std::uint32_t connection : connections) places[connection] = place;
  if (connections.empty())
    throw InputError(file.path() + ": no topic " + topic.name + " (" + topic.named_by + "); " + kind +
                     " topics in this bag: " + listTopics<Message>(file.connections()));
}

Places findPlaces(const BagFile& file, const ImuBags& bags) {
  Places places;
  for (const BagConnection& connection : file.connections()) places[connection.id] = std::nullopt;
  for (std::size_t i = 0; i < bags.topics.size(); ++i)
    bags.topics[i].is_force ? findTopic<geometry_msgs::WrenchStamped>(file, bags.topics[i], "WrenchStamped", i, places)
                            : findTopic<sensor_msgs::Imu>(file, bags.topics[i], "Imu", i, places);
  for (std::size_t i = 0; i < bags.temperature_topics.size(); ++i)
    for (const std::uint32_t connection : connectionsOf<sensor_msgs::Temperature>(file, bags.temperature_topics[i]))
      places[connection] = bags.topics.size() + i;
  return places;
}

/// Which recording times [ns] are read.
struct Range {
  std::uint64_t first = 0, last = std::numeric_limits<std::uint64_t>::max();

  bool contains(std::uint64_t time) const { return time >= first && time <= last; }
  bool overlaps(const BagChunk& chunk) const { return chunk.end >= first && chunk.start <= last; }
};

Range toRange(const ImuBags& bags, std::uint64_t beginning) {
  constexpr double kFarFuture = 1e9;  // [s]
  const auto nanoseconds = [](double seconds) { return static_cast<std::uint64_t>(1e9 * seconds); };
  Range range;
  range.first = beginning + nanoseconds(std::min(bags.start, kFarFuture));
  if (bags.end < kFarFuture) range.last = beginning + nanoseconds(bags.end);
  return range;
}

/// A chunk with messages that have not been delivered.
struct OpenChunk {
  ChunkContents contents;
  std::uint64_t position = 0;
  std::size_t next = 0;

  const BagMessage& message() const { return contents.messages[next]; }
};

/// For a heap with the earliest message on top; of messages at the same time the one that was written first.
bool isLater(const OpenChunk& a, const OpenChunk& b) {
  return std::tie(a.message().time, a.position) > std::tie(b.message().time, b.position);
}

/// Delivers the messages of one bag by recording time. Its chunks are opened in the order in which they begin and
/// kept as long as they have messages that are later than the beginning of the next one.
class Delivery {
 public:
  Delivery(const BagFile& file, const ImuBags& bags, const Range& range, const TopicSinks& take)
      : file_(file),
        places_(findPlaces(file, bags)),
        topics_(bags.topics),
        range_(range),
        take_(take),
        gaps_(bags.gaps) {}

  /// @return storage of a chunk that is done, to be used again.
  ChunkContents spare() { return std::exchange(spare_, {}); }

  void open(std::uint64_t position, ChunkContents contents) {
    if (contents.messages.empty()) return;
    open_.push_back({std::move(contents), position, 0});
    std::push_heap(open_.begin(), open_.end(), isLater);
  }

  /// @return false if no more messages are wanted.
  bool deliverBefore(std::uint64_t time) {
    while (!open_.empty() && open_.front().message().time < time) {
      std::pop_heap(open_.begin(), open_.end(), isLater);
      OpenChunk& chunk = open_.back();
      const bool is_only = open_.size() == 1;
      do {
        if (!deliver(chunk.message())) return false;
        if (++chunk.next == chunk.contents.messages.size()) break;
      } while (chunk.message().time < time && (is_only || !isLater(chunk, open_.front())));
      putBack(chunk);
    }
    return true;
  }

 private:
  /// @param last  of those that are open: it goes back onto the heap, unless all its messages are delivered.
  void putBack(OpenChunk& last) {
    if (last.next < last.contents.messages.size()) return std::push_heap(open_.begin(), open_.end(), isLater);
    spare_ = std::move(last.contents);
    open_.pop_back();
  }

  bool deliver(const BagMessage& message) {
    Interruption::check();
    const auto place = places_.find(message.connection);
    if (place == places_.end()) throw InputError(file_.path() + ": a message of a topic that the bag does not list");
    if (!place->second || !range_.contains(message.time)) return true;
    const std::size_t sensor = *place->second;
    if (sensor >= topics_.size()) {
      if (!take_.temperature) return true;
      decode(file_, message, "", temperature_);
      return take_.temperature(sensor - topics_.size(), temperature_, Stamp(static_cast<Stamp::rep>(message.time)));
    }
    return topics_[sensor].is_force ? deliver(message, sensor, wrench_, take_.wrench)
                                    : deliver(message, sensor, imu_, take_.imu);
  }

  /// @param decoded  storage for it.
  template <class Message>
  bool deliver(const BagMessage& message, std::size_t place, Message& decoded,
               const std::function<bool(std::size_t, const Message&, Stamp)>& take) {
    decode(file_, message, "", decoded);
    if (gaps_ != nullptr) gaps_->note(place, toStamp(decoded.header.stamp));
    return take(place, decoded, Stamp(static_cast<Stamp::rep>(message.time)));
  }

  const BagFile& file_;
  Places places_;
  const std::vector<BagTopic>& topics_;
  Range range_;
  const TopicSinks& take_;
  TopicGaps* gaps_;
  std::vector<OpenChunk> open_;  // a heap
  ChunkContents spare_;          // storage of a chunk that is done
  sensor_msgs::Imu imu_;
  geometry_msgs::WrenchStamped wrench_;
  sensor_msgs::Temperature temperature_;
};

bool readBag(BagFile& file, const ImuBags& bags, const TopicSinks& take) {
  std::vector<BagChunk> chunks = file.chunks();
  std::stable_sort(chunks.begin(), chunks.end(),
                   [](const BagChunk& a, const BagChunk& b) { return a.start < b.start; });
  const Range range = toRange(bags, chunks.front().start);
  chunks.erase(std::remove_if(chunks.begin(), chunks.end(), [&](const BagChunk& c) { return !range.overlaps(c); }),
               chunks.end());
  Delivery delivery(file, bags, range, take);
  Progress progress("reading " + file.path(), static_cast<double>(chunks.size()));
  // While the messages of a chunk are used, another thread reads and decompresses the next, which takes a third of the
  // time of `identify`. Without that thread it is done when the chunk is wanted.
  const std::launch launch = bags.reads_ahead ? std::launch::async : std::launch::deferred;
  const auto begin = [&](std::size_t chunk) {
    return std::async(launch, [&file, &coming = chunks[chunk], contents = delivery.spare()]() mutable {
      file.read(coming, contents);
      return std::move(contents);
    });
  };
  std::future<ChunkContents> next;  // last: its thread, which uses all else, is waited for first
  if (!chunks.empty()) next = begin(0);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    progress.update(static_cast<double>(i + 1));
    if (!delivery.deliverBefore(chunks[i].start)) return false;
    ChunkContents contents = next.get();
    if (i + 1 < chunks.size()) next = begin(i + 1);
    delivery.open(chunks[i].position, std::move(contents));
  }
  return delivery.deliverBefore(std::numeric_limits<std::uint64_t>::max());
}

}  // namespace

std::vector<std::string> ImuBags::allTopics() const { return namesOf(topics); }

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
