#include "suspension_health_monitor/internal/signal/regular_times.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kFewest = 20.0;  // readings, whose line has the spacing within 4 % of what stamps are off by
constexpr double kLongestLoss = 5.0;  // periods; no longer one is bridged
constexpr int kOtherRate = 50;    // readings more that do not follow by a period than do: the period is another one

}  // namespace

RegularTimes::RegularTimes() : means_(StreamTiming::kMemory) {}

double RegularTimes::next(double stamp, double usual_spacing) {
  if (readings_ == 0.0 || out_of_step_ > kOtherRate) {
    readings_ = 1.0;
    spacing_ = usual_spacing;
    out_of_step_ = 0;
    in_row_ = 1;
    expected_ = 1.0;
    return time_ = stamp;
  }
  const double taken = readings_ < kFewest ? expected_ : step((stamp - time_) / spacing_);
  in_row_ = taken == 1.0 ? in_row_ + 1 : 1;
  out_of_step_ = std::max(0, out_of_step_ + (taken == expected_ ? -1 : 1));
  readings_ = std::min(readings_ + 1.0, kMemory);
  const double sum = readings_ * (readings_ + 1.0), off = stamp - time_ - taken * spacing_;
  time_ += taken * spacing_ + 2.0 * (2.0 * readings_ - 1.0) / sum * off;
  spacing_ += 6.0 / sum * off / std::max(1.0, taken);
  const double missing = taken <= kLongestLoss ? taken - 1.0 : 0.0;
  means_.add({(stamp - time_) * (stamp - time_), taken > expected_ ? 1.0 : 0.0, taken < expected_ ? 1.0 : 0.0, missing});
  expected_ = 1.0;
  return time_;
}

double RegularTimes::lossShare() const {
  return std::max(kFewestLosses, means_.mean(kLost) - means_.mean(kTakenBack));
}

double RegularTimes::step(double periods) const {
  const double beyond = periods - expected_, tolerated = -variance() / (spacing_ * spacing_) * std::log(lossShare());
  const double lost = std::max(0.0, std::round(std::abs(beyond) - tolerated));
  return beyond > 0.0 ? expected_ + lost : std::max(0.0, expected_ - lost);
}

}  // namespace suspension_health_monitor
