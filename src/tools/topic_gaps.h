#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/signal/stream_silence.h"

namespace suspension_health_monitor {

/// Which topics were silent while others went on, bag by bag, and what of each bag was left to be used.
class TopicGaps {
 public:
  /// @param timeout  [s] a longer silence is one.
  explicit TopicGaps(double timeout) : timeout_(fromSeconds(timeout)) {}
  TopicGaps(const TopicGaps&) = delete;  // its callbacks refer to it
  TopicGaps& operator=(const TopicGaps&) = delete;

  /// @param topics  whose readings are all needed.
  void beginBag(const std::string& path, const std::vector<std::string>& topics);
  /// @param topic  its place; a reading of a topic that beginBag() was not given is ignored.
  void note(std::size_t topic, Stamp stamp);
  void finishBag();

  /// A line for every silence, then what was used; nothing if no topic was silent.
  void print() const;

  /// Runs a check of what was read.
  /// @throws TooLittleError  as the check, with the silences behind its words: they may be why.
  void explain(const std::function<void()>& check) const;

  /// The same for programs, by stamps.
  nlohmann::json toJson() const;

 private:
  struct Bag {
    std::string name;
    std::vector<std::string> topics;
    StreamSilence silence;
    std::vector<StreamSilence::Silence> silences = {};  // that have ended
    Stamp first{}, last{};                              // readings
  };

  /// @return by bag one for every silence, then what was used; none if no topic was silent.
  std::vector<std::string> sentences() const;

  Stamp timeout_;
  std::vector<Bag> bags_;
};

}  // namespace suspension_health_monitor
