#include <algorithm>
#include <cmath>

#include "rivals.h"

namespace suspension_health_monitor {
namespace {

constexpr double kGravity = 9.81;          // [m/s^2]
constexpr double kMostLost = 1.0 - 0.866;  // by a tilt of 30 degrees

}  // namespace

bool mayBeTilt(const StrutModel& model, const std::string& fault, const Records& records) {
  const bool is_read = std::all_of(records.begin(), records.end(),
                                   [](const DriveRecord* record) { return record->gravity() > 0.5 * kGravity; });
  const double unit = fault == "accelerometer_bias" ? kGravity : fault == "scale_error" ? 1.0 : 0.0;
  return is_read && std::any_of(model.reading.begin(), model.reading.end(), [&](const ActiveMeasurementEffect& active) {
           return active.effect.name == fault && std::abs(active.coefficients.front()) < kMostLost * unit;
         });
}

}  // namespace suspension_health_monitor
