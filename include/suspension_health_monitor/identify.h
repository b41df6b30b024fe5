#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

struct IdentifyOptions {
  std::optional<double> sample_period;  ///< T [s]; nothing: the median spacing of the samples
  std::optional<int> horizon_samples;   ///< L of the integral filter; nothing: proposed from the data
  std::optional<double> memory;         ///< of ls and la [s], at least 10 samples; nothing: 2, or 10/3 of the horizon
  /// Called with the live monitor's report after every sample, on the calling thread.
  std::function<void(const MonitorReport&)> report = {};
};

struct IdentifyResult {
  double sample_period = 0.0;  ///< T [s]
  int horizon_samples = 0;     ///< L
  /// At the end of the drive, over the memory: least squares and least sum of absolute values, as the live monitor has
  /// them; but in all of these 1.96 standard deviations either way hold the truth 95 times of 100: what no model has
  /// (StrutEstimate::damping_model_stddev) is in them.
  StrutEstimate ls, la;
  StrutEstimate estimate;                         ///< of the blocks over the whole drive: what to trust
  StrutEstimate now;                              ///< of the blocks at the end of the drive, as the live monitor has it
  std::uint64_t samples = 0;                      ///< taken in
  std::uint64_t rows = 0;                         ///< regression rows that they gave
  std::uint64_t gaps = 0;                         ///< after each of which the filter filled anew
  std::uint64_t clock_jumps = 0;                  ///< times that the clock went back
  std::map<std::string, std::uint64_t> rejected;  ///< readings that were kept out, by reason; only those that occurred
  std::vector<std::string> warnings;              ///< of sensors, stamps and a strut that changes, in words

  /// @return false if the strut differs between a stretch of the drive and the rest, beyond doubt: it has changed, or
  /// its forces are not those of a plain spring and damper.
  bool isSteady() const { return !estimate.valid() || !estimate.change; }
};

/// Identifies a strut from recorded drives, through the same code as the live monitor.
///
///     const Drive drive = makeDrive(0.01, body, wheel);       // accelerations [m/s^2], 100 Hz
///     const IdentifyResult result = identify({drive});
///     if (result.estimate.valid()) use(result.estimate.damping_to_mass, result.estimate.stiffness_to_mass);
///
/// @param drives  of the same strut, taken one after the other.
/// @throws std::invalid_argument  naming the option, its value and what is allowed; if no drive has two samples; or if
/// no horizon can be proposed, because the data show no damped spring.
IdentifyResult identify(const std::vector<Drive>& drives, const IdentifyOptions& options = {});

}  // namespace suspension_health_monitor
