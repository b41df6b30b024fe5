#include "suspension_health_monitor/internal/simulation/sensor_schedule.h"

namespace suspension_health_monitor {

SensorSchedule::SensorSchedule(double rate, double phase, const SimulationOptions& options, RandomPurpose timing)
    : rate_(rate),
      phase_(phase),
      jitter_(options.sampling_jitter),
      duration_(options.duration),
      random_(options.seed, timing) {
  advance();
}

void SensorSchedule::advance() {
  const auto k = static_cast<double>(++index_);
  // A duration that is a whole number of periods must not lose its last sample to rounding.
  next_.reset();
  if (k <= (duration_ - phase_) * rate_ + 1e-6) next_ = phase_ + k / rate_;
  if (next_ && jitter_ > 0.0) *next_ += jitter_ * random_.uniform();
}

}  // namespace suspension_health_monitor
