#pragma once

#include <boost/noncopyable.hpp>
#include <functional>
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

}  // namespace suspension_health_monitor
