#include "suspension_health_monitor/drive.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

constexpr double kShortestPeriod = 1e-5, kLongestPeriod = 10.0;  // [s], as of sample_period

void LowPass::validate(std::size_t num_samples) const {
  if (!taps.empty() && taps.size() % 2 == 0)
    throw std::invalid_argument("low_pass has " + std::to_string(taps.size()) + " taps, must be an odd number");
  const std::size_t needed = taps.empty() ? 0 : num_samples;
  if (unfiltered.size() != needed)
    throw std::invalid_argument("low_pass has " + std::to_string(unfiltered.size()) + " unfiltered values, must have " +
                                std::to_string(needed));
}

Drive makeDrive(double period, const std::vector<double>& sprung_acceleration,
                const std::vector<double>& unsprung_acceleration) {
  requireIn("period", period, "s", kShortestPeriod, kLongestPeriod);
  if (sprung_acceleration.size() != unsprung_acceleration.size())
    throw std::invalid_argument(std::to_string(sprung_acceleration.size()) + " sprung and " +
                                std::to_string(unsprung_acceleration.size()) +
                                " unsprung accelerations, must be as many");
  Drive drive;
  drive.samples.reserve(sprung_acceleration.size());
  for (std::size_t k = 0; k < sprung_acceleration.size(); ++k)
    drive.samples.push_back(
        {fromSeconds(static_cast<double>(k) * period), sprung_acceleration[k], unsprung_acceleration[k]});
  return drive;
}

double medianPeriod(const std::vector<Drive>& drives) {
  std::vector<Stamp> spacings;
  for (const Drive& drive : drives)
    for (std::size_t k = 1; k < drive.samples.size(); ++k)
      spacings.push_back(drive.samples[k].stamp - drive.samples[k - 1].stamp);
  if (spacings.empty()) throw std::invalid_argument("no drive has two samples");
  const Stamp period = median(std::move(spacings));
  if (period <= Stamp::zero()) throw std::invalid_argument("the stamps of the samples do not rise");
  return toSeconds(period);
}

}  // namespace suspension_health_monitor
