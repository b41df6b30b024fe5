#include "imu_bags.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <future>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "../ros/conversions.h"
#include "bag_file.h"
#include "long_work.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

/// A message that is wanted, decoded.
struct Message {
  std::uint64_t time = 0;  // of its recording [ns]
  std::size_t place = 0;   // of its topic, among those of sensors, or of temperatures
  std::variant<sensor_msgs::Imu, geometry_msgs::WrenchStamped, sensor_msgs::Temperature> body;
};

template <class Body>
void decodeAs(const BagFile& file, const BagMessage& message, Message& decoded) {
  if (!std::holds_alternative<Body>(decoded.body)) decoded.body.emplace<Body>();
  decode(file, message, "", std::get<Body>(decoded.body));
}

/// A topic that is wanted: its place, and what decodes its messages.
struct WantedTopic {
  std::size_t place;
  void (*decode)(const BagFile& file, const BagMessage& message, Message& decoded);
};

/// For every connection of a bag the topic that it carries, if that is wanted.
using WantedTopics = std::map<std::uint32_t, std::optional<WantedTopic>>;

/// @param kind  of the messages, in a word.  @param place  of the topic.
template <class Body>
void findTopic(const BagFile& file, const BagTopic& topic, const char* kind, std::size_t place, WantedTopics& wanted) {
  const std::vector<std::uint32_t> connections = connectionsOf<Body>(file, topic.name);
  for (const std::uint32_t connection : connections) wanted[connection] = {place, &decodeAs<Body>};
  if (!connections.empty()) return;
  const std::vector<std::string> others = topicsWith<Body>(file);
  throw InputError(file.path() + ": no topic " + topic.name + " (" + topic.named_by + "); " + kind +
                   " topics in this bag: " + (others.empty() ? "none" : join(others)));
}

WantedTopics findTopics(const BagFile& file, const ImuBags& bags, bool with_temperatures) {
  WantedTopics wanted;
  for (const BagConnection& connection : file.connections()) wanted[connection.id] = std::nullopt;
  for (std::size_t i = 0; i < bags.topics.size(); ++i)
    if (bags.topics[i].is_force)
      findTopic<geometry_msgs::WrenchStamped>(file, bags.topics[i], "WrenchStamped", i, wanted);
    else
      findTopic<sensor_msgs::Imu>(file, bags.topics[i], "Imu", i, wanted);
  for (std::size_t i = 0; i < bags.temperature_topics.size(); ++i)
    for (const std::uint32_t connection : connectionsOf<sensor_msgs::Temperature>(file, bags.temperature_topics[i]))
      if (with_temperatures) wanted[connection] = {i, &decodeAs<sensor_msgs::Temperature>};
  return wanted;
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

/// Reads and decodes a chunk.
/// @param contents  storage for it.  @param chunk  likewise.
OpenChunk readChunk(BagFile& file, const WantedTopics& wanted, const Range& range, const BagChunk& from,
                    ChunkContents& contents, OpenChunk chunk) {
  file.read(from, contents);
  chunk.position = from.position;
  chunk.next = chunk.end = 0;
  for (const BagMessage& message : contents.messages) {
    const auto topic = wanted.find(message.connection);
    if (topic == wanted.end()) throw InputError(file.path() + ": a message of a topic that the bag does not list");
    if (!topic->second || !range.contains(message.time)) continue;
    if (chunk.end == chunk.messages.size()) chunk.messages.emplace_back();
    Message& decoded = chunk.messages[chunk.end++];
    decoded.time = message.time;
    decoded.place = topic->second->place;
    topic->second->decode(file, message, decoded);
  }
  return chunk;
}

/// Delivers the messages of one bag by recording time. Its chunks are opened in the order in which they begin and
/// kept as long as they have messages that are later than the beginning of the next one.
struct Delivery {
  const TopicSinks& take;
  TopicGaps* gaps;
  std::vector<OpenChunk> open = {};  // not done, as many as overlap in time: mostly one or two
  OpenChunk spare = {};              // storage of a chunk that is done, to be used again

  /// @return false if no more messages are wanted.
  bool deliverBefore(std::uint64_t time) {
    while (!open.empty()) {
      const auto earliest = std::min_element(open.begin(), open.end(), isEarlier);
      if (earliest->message().time >= time) break;
      if (!deliver(earliest->message())) return false;
      ++earliest->next;
      if (!earliest->isDone()) continue;
      spare = std::move(*earliest);
      open.erase(earliest);
    }
    return true;
  }

  bool deliver(const Message& message) const {
    Interruption::check();
    const Stamp recorded(static_cast<Stamp::rep>(message.time));
    if (const auto* temperature = std::get_if<sensor_msgs::Temperature>(&message.body))
      return take.temperature(message.place, *temperature, recorded);
    const auto give = [&](const auto& reading, const auto& sink) {
      if (gaps != nullptr) gaps->note(message.place, toStamp(reading.header.stamp));
      return sink(message.place, reading, recorded);
    };
    if (const auto* imu = std::get_if<sensor_msgs::Imu>(&message.body)) return give(*imu, take.imu);
    return give(std::get<geometry_msgs::WrenchStamped>(message.body), take.wrench);
  }
};

bool readBag(BagFile& file, const ImuBags& bags, const TopicSinks& take) {
  std::vector<BagChunk> chunks = file.chunks();
  std::stable_sort(chunks.begin(), chunks.end(),
                   [](const BagChunk& a, const BagChunk& b) { return a.start < b.start; });
  const Range range = toRange(bags, chunks.front().start);
  chunks.erase(std::remove_if(chunks.begin(), chunks.end(), [&](const BagChunk& c) { return !range.overlaps(c); }),
               chunks.end());
  const WantedTopics wanted = findTopics(file, bags, take.temperature != nullptr);
  ChunkContents contents;  // of the newest chunk
  Delivery delivery{take, bags.gaps};
  Progress progress("reading " + file.path(), static_cast<double>(chunks.size()));
  // While the messages of a chunk are used, another thread reads and decodes the next, which takes a quarter of the
  // time of `identify`. Without that thread it is done when the chunk is wanted.
  const std::launch launch = bags.reads_ahead ? std::launch::async : std::launch::deferred;
  const auto begin = [&](std::size_t at) {
    return std::async(launch, [&, &coming = chunks[at], chunk = std::exchange(delivery.spare, {})]() mutable {
      return readChunk(file, wanted, range, coming, contents, std::move(chunk));
    });
  };
  std::future<OpenChunk> next;  // last: its thread, which uses all else, is waited for first
  if (!chunks.empty()) next = begin(0);
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    progress.update(static_cast<double>(i + 1));
    if (!delivery.deliverBefore(chunks[i].start)) return false;
    OpenChunk chunk = next.get();
    if (i + 1 < chunks.size()) next = begin(i + 1);
    if (!chunk.isDone()) delivery.open.push_back(std::move(chunk));
  }
  return delivery.deliverBefore(std::numeric_limits<std::uint64_t>::max());
}

using Silence = StreamSilence::Silence;

/// "0 s to 60 s and 80 s to 120 s": what no silence covers of the time from `first` to `last`, counted from `first`.
std::string whatIsLeft(std::vector<Silence> silences, Stamp first, Stamp last) {
  std::sort(silences.begin(), silences.end(), [](const Silence& a, const Silence& b) { return a.from < b.from; });
  std::vector<std::string> parts;
  const auto add = [&](Stamp from, Stamp to) {
    if (to > from) parts.push_back(formatted("%.1f s to %.1f s", toSeconds(from - first), toSeconds(to - first)));
  };
  Stamp covered = first;
  for (const Silence& silence : silences) {
    add(covered, silence.from);
    covered = std::max(covered, silence.to);
  }
  add(covered, last);
  return parts.empty() ? "nothing" : join(parts, " and ");
}

}  // namespace

void TopicGaps::beginBag(const std::string& path, const std::vector<std::string>& topics) {
  const auto keep = [this](const Silence& ended) { bags_.back().silences.push_back(ended); };
  bags_.push_back({fileNames({path}).front(), topics, StreamSilence(topics, timeout_, keep)});
}

void TopicGaps::note(std::size_t topic, Stamp stamp) {
  Bag& bag = bags_.back();
  if (topic >= bag.topics.size() || stamp <= Stamp::zero()) return;
  bag.silence.add(topic, stamp);
  if (bag.first == Stamp::zero()) bag.first = stamp;
  bag.last = stamp;
}

std::vector<std::string> TopicGaps::sentences() const {
  std::vector<std::string> all = faults_;
  for (const Bag& bag : bags_) {
    if (bag.silences.empty()) continue;
    const auto after = [&](Stamp stamp) { return toSeconds(stamp - bag.first); };
    for (const Silence& one : bag.silences)
      all.push_back(formatted("%s: %s is silent from %.1f s to %.1f s%s", bag.name.c_str(),
                              bag.topics[one.stream].c_str(), after(one.from), after(one.to),
                              one.to >= bag.last ? ", the end" : ""));
    all.push_back(formatted("%s: used %s of %.1f s", bag.name.c_str(),
                            whatIsLeft(bag.silences, bag.first, bag.last).c_str(), after(bag.last)));
  }
  return all;
}

void TopicGaps::print() const {
  for (const std::string& sentence : sentences()) std::printf("%s\n", sentence.c_str());
}

void TopicGaps::explain(const std::function<void()>& check) const {
  try {
    check();
  } catch (const TooLittleError& error) {
    std::vector<std::string> reasons = sentences();
    reasons.insert(reasons.begin() + static_cast<std::ptrdiff_t>(faults_.size()), error.what());
    throw TooLittleError(join(reasons, "; "));
  }
}

json TopicGaps::toJson() const {
  json list = json::array();
  for (const Bag& bag : bags_)
    for (const Silence& silence : bag.silences)
      list.push_back({{"bag", bag.name},
                      {"topic", bag.topics[silence.stream]},
                      {"from", toSeconds(silence.from)},
                      {"to", toSeconds(silence.to)}});
  return list;
}

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
