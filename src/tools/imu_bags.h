#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Temperature.h>
#include <tf2/buffer_core.h>

#include <array>
#include <boost/noncopyable.hpp>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "suspension_health_monitor/internal/signal/stream_silence.h"

namespace suspension_health_monitor {

/// What is wrong with what was read: which topics were silent while others went on, bag by bag, and what of each bag
/// was left to be used; and what else was noticed.
class TopicGaps : boost::noncopyable {  // its callbacks refer to it
 public:
  /// @param timeout  [s] a longer silence is one.
  explicit TopicGaps(double timeout) : timeout_(fromSeconds(timeout)) {}

  /// @param topics  whose readings are all needed.
  void beginBag(const std::string& path, const std::vector<std::string>& topics);
  /// @param topic  its place; a reading of a topic that beginBag() was not given is ignored.
  void note(std::size_t topic, Stamp stamp);
  void finishBag() { bags_.back().silence.finish(); }

  /// Something else that is wrong with what was read, in a sentence.
  void add(const std::string& fault) { faults_.push_back(fault); }

  /// A line for every fault and silence, then what was used; nothing if all is well.
  void print() const;

  /// Runs a check of what was read.
  /// @throws TooLittleError  as the check, with the faults before its words and the silences behind: they may be why.
  void explain(const std::function<void()>& check) const;

  /// The same for programs, by stamps.
  json toJson() const;

 private:
  struct Bag {
    std::string name;
    std::vector<std::string> topics;
    StreamSilence silence;
    std::vector<StreamSilence::Silence> silences = {};  // that have ended
    Stamp first{}, last{};                              // readings
  };

  /// @return the faults, then by bag one for every silence and what was used.
  std::vector<std::string> sentences() const;

  Stamp timeout_;
  std::vector<Bag> bags_;
  std::vector<std::string> faults_;
};

/// Options that name the topics, by Side.
inline constexpr std::array kTopicOptions{"sprung-topic", "unsprung-topic", "road-topic"};

/// A topic of IMUs, or of known forces.
struct BagTopic {
  std::string name;
  std::string named_by;   ///< the option or setting that names it
  bool is_force = false;  ///< of geometry_msgs/WrenchStamped, else of sensor_msgs/Imu
  bool is_needed = true;  ///< else its silence is none
};

/// What to read: one or more bags, the topics, and a part of each bag.
struct ImuBags {
  std::vector<std::string> paths;
  std::vector<BagTopic> topics;                 ///< of sensors, those that are needed first
  std::vector<std::string> temperature_topics;  ///< of sensor_msgs/Temperature; a bag may lack them, one may be empty
  double start = 0.0;                           ///< seconds after the beginning of each bag
  double end = std::numeric_limits<double>::infinity();
  std::shared_ptr<const tf2::BufferCore> transforms;  ///< static ones of all bags, if they are wanted

  TopicGaps* gaps = nullptr;  ///< takes note of all that is read, if it is given; outlives the reading
  bool reads_ahead = true;    ///< in a second thread

  std::vector<std::string> neededTopics() const;

  /// @return the same of one bag alone.
  ImuBags of(const std::string& path, TopicGaps& its_gaps) const;
};

/// What is called with every message, its place among ImuBags::topics, or among ImuBags::temperature_topics, and the
/// time of its recording; returns false to stop.
struct TopicSinks {
  std::function<bool(std::size_t, const sensor_msgs::Imu&, Stamp recorded)> imu;
  std::function<bool(std::size_t, const geometry_msgs::WrenchStamped&, Stamp recorded)> wrench;
  std::function<bool(std::size_t, const sensor_msgs::Temperature&, Stamp recorded)> temperature = {};
};

/// Reads the messages of all bags in the order of their recording, with a progress bar.
/// Memory does not grow with the bags; only chunks that overlap in time are held together.
/// @throws InputError  naming the bag: unreadable, a topic missing (with those that are there) or of another type.
/// @throws TooLittleError  if a bag holds no message at all.
void readTopics(const ImuBags& bags, const TopicSinks& take);

}  // namespace suspension_health_monitor
