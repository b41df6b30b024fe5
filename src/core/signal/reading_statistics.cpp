#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/signal/stream_gate.h"

namespace suspension_health_monitor {
namespace {

constexpr double kFewestForUsual = 100.0;

}  // namespace

void ReadingStatistics::add(double reading, bool is_extreme) {
  const double step = last_ ? std::abs(reading - *last_) : 0.0;
  equal_in_a_row_ = last_ && step == 0.0 ? std::min(equal_in_a_row_ + 1, RangeEnd::kStuck) : 1;
  if (step > 0.0) finest_step_ = finest_step_ > 0.0 ? std::min(finest_step_, step) : step;
  last_ = reading;
  mean_.add(reading);
  deviation_.add(std::abs(reading - mean_.mean()));
  if (!is_extreme) repeated_.add(step == 0.0 ? 1.0 : 0.0);
}

UsualReadings ReadingStatistics::usual(double span) const {
  const bool known = std::min(mean_.weight(), repeated_.weight()) >= kFewestForUsual;
  return {mean(), deviation(), finest_step_, span, repeated_.mean(), known};
}

}  // namespace suspension_health_monitor
