#include "suspension_health_monitor/internal/signal/sampling_test.h"

#include <array>
#include <cmath>

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr std::array kDifference{1.0, -4.0, 6.0, -4.0, 1.0};  // D
constexpr double kFewest = 200.0;                             // rows, whose scatter is known within a tenth

/// @return x' T by the readings `apart` before and after.
double rateBy(std::ptrdiff_t apart, const double* x) { return (x[apart] - x[-apart]) / (2.0 * apart); }

}  // namespace

// Distances count from their mean: what the regular times of all these readings are off by displaces none against
// another. The instrument has other readings' noise in it.
void SamplingTest::add(double value, double off) {
  values_.push(value);
  off_.push(off);
  if (++in_a_row_ < kWindow) return;
  double mean = 0.0, e = 0.0, r = 0.0, instrument = 0.0;
  for (std::size_t i = 0; i < kDifference.size(); ++i) mean += off_.window()[kReach + i] / kDifference.size();
  for (std::size_t i = 0; i < kDifference.size(); ++i) {
    const double* x = values_.window() + kReach + i;
    const double distance = off_.window()[kReach + i] - mean;
    e += kDifference[i] * *x;
    r += kDifference[i] * rateBy(1, x) * distance;
    instrument += kDifference[i] * rateBy(2, x) * distance;
  }
  products_.add({instrument * r, instrument * e, instrument * instrument, e * e});
  const double moment = products_.mean(0), slope = products_.mean(1) / moment;
  const double independent = products_.weight() / kDifference.size();  // neighbouring differences share readings
  const double stddev = std::sqrt(products_.mean(2) * products_.mean(3) / independent) / std::abs(moment);
  const bool is_certain = products_.weight() >= kFewest && std::abs(slope - 0.5) > kProven * stddev;
  less_than_half_ = !is_certain ? 0 : slope < 0.5 ? 1 : -1;
}

}  // namespace suspension_health_monitor
