#include "suspension_health_monitor/internal/signal/silent_sensors.h"

namespace suspension_health_monitor {

void SilentSensors::add(std::size_t sensor, Stamp stamp) {
  noteEnd(sensor);
  silence_.add(sensor, stamp);
}

void SilentSensors::finish() {
  for (std::size_t i = 0; i < names_.size(); ++i) noteEnd(i);
  silence_.finish();
}

void SilentSensors::noteEnd(std::size_t sensor) {
  if (isSilent(sensor)) was_silent_[sensor] = true;
}

std::vector<std::string> SilentSensors::names(bool with_past) const {
  std::vector<std::string> silent;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (isSilent(i) || (with_past && was_silent_[i])) silent.push_back(names_[i]);
  return silent;
}

}  // namespace suspension_health_monitor
