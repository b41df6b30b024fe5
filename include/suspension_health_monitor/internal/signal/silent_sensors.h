#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/internal/signal/stream_silence.h"

namespace suspension_health_monitor {

/// Which of several sensors are silent while others go on (StreamSilence), by their names.
class SilentSensors {
 public:
  /// @param timeout  the longest pause between two readings that is none.
  SilentSensors(const std::vector<std::string>& names, Stamp timeout)
      : names_(names), silence_(names.size(), timeout), was_silent_(names.size()) {}

  /// As StreamSilence::add().
  void add(std::size_t sensor, Stamp stamp);

  /// The recording ends, and with it every silence.
  void finish();

  /// Silences that have ended count no more.
  void forget() { was_silent_.assign(names_.size(), false); }

  /// @return those that are silent now.
  std::vector<std::string> now() const { return names(false); }

  /// @return also those whose silence has ended since forget().
  std::vector<std::string> ofLate() const { return names(true); }

 private:
  bool isSilent(std::size_t sensor) const { return silence_.lasting(sensor) > Stamp::zero(); }
  void noteEnd(std::size_t sensor);
  std::vector<std::string> names(bool with_past) const;

  std::vector<std::string> names_;
  StreamSilence silence_;
  std::vector<bool> was_silent_;  // by sensor
};

}  // namespace suspension_health_monitor
