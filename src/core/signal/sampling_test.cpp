#include "suspension_health_monitor/internal/signal/sampling_test.h"

#include <array>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr std::array kDifference{1.0, -4.0, 6.0, -4.0, 1.0};     // D
constexpr std::array kRate{3.0 / 4.0, -3.0 / 20.0, 1.0 / 60.0};  // of the readings 1, 2, 3 to either side
constexpr double kSignificant = 3.0;                             // standard deviations: by chance once in 700 trials

double rateAt(const double* x) {
  double change = 0.0;
  for (std::size_t j = 0; j < kRate.size(); ++j) {
    const auto apart = static_cast<std::ptrdiff_t>(j + 1);
    change += kRate[j] * (x[apart] - x[-apart]);
  }
  return change;
}

}  // namespace

// Distances count from their mean: what the regular times of all these readings are off by displaces none against
// another.
void SamplingTest::add(double value, double off) {
  values_.push(value);
  off_.push(off);
  if (++in_a_row_ < kWindow) return;
  double mean = 0.0, e = 0.0, r = 0.0;
  for (std::size_t i = 0; i < kDifference.size(); ++i) mean += off_.data()[kReach + i] / kDifference.size();
  for (std::size_t i = 0; i < kDifference.size(); ++i) {
    e += kDifference[i] * values_.data()[kReach + i];
    r += kDifference[i] * rateAt(values_.data() + kReach + i) * (off_.data()[kReach + i] - mean);
  }
  products_.add({r * r, r * e, e * e});
  const double rr = products_.mean(0), slope = products_.mean(1) / rr;
  // Neighbouring differences share readings.
  const double independent = products_.weight() / kDifference.size();
  const double variance = (products_.mean(2) / rr - slope * slope) / independent;
  is_regular_ = slope + kSignificant * std::sqrt(variance) < 0.5;
}

}  // namespace suspension_health_monitor
