#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <future>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "field_drive.h"
#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"

namespace suspension_health_monitor {

/// @param memory  [s]; left out: the default
/// @return settings with the true values as the nominal ones.
inline MonitorSettings settingsFor(const FieldDrive& drive, std::optional<double> memory = {}) {
  MonitorOptions options;
  options.sample_period = 1.0 / drive.rate;
  options.memory = memory;
  options.nominal_damping_to_mass = drive.vehicle.b1;
  options.nominal_stiffness_to_mass = drive.vehicle.b0;
  return options;
}

/// Calls look(time, report) for every sample of a drive, times in [s].
template <class Look>
void follow(const FieldDrive& drive, std::optional<double> memory, double seconds, const Look& look) {
  FieldSimulator simulator(drive);
  SuspensionMonitor monitor(settingsFor(drive, memory));
  while (simulator.time() < seconds)
    if (const MonitorReport* report = monitor.addSample(simulator.next())) look(simulator.time(), *report);
}

/// @return a pipeline with the true values as the nominal ones, and no other setting.
inline VehiclePipeline pipelineFor(const FieldDrive& drive) {
  MonitorSettings settings = settingsFor(drive);
  settings.sample_period.reset();
  return VehiclePipeline(settings);
}

/// What happens to the readings of two IMUs on their way.
struct FieldDelivery {
  double late = 0.0;    ///< the wheel's readings are stamped by a clock that is so much ahead [s]
  double jitter = 0.0;  ///< of every stamp, standard deviation [s]
  double lost = 0.0;    ///< share of readings
  double spikes = 0.0;  ///< share of readings that are wrong by 20 to 100 m/s^2
  bool zeros = false;   ///< the wheel's IMU reads 0 for the last second of every minute
};

/// Drives, and gives what both IMUs read to a pipeline: two streams, each on its own stamps, with gravity in them.
class FieldReadings {
 public:
  FieldReadings(const FieldDrive& drive, const FieldDelivery& delivery)
      : simulator_(drive), delivery_(delivery), random_(1000003U * (drive.seed + 1)) {}

  /// @param steps  of the integration that are driven.
  void push(int steps, VehiclePipeline& pipeline) {
    for (int i = 0; i < steps; ++i) {
      simulator_.advance();
      ++steps_;
      if (steps_ % simulator_.bodySteps() == 0) deliver(Side::kSprung, simulator_.readBody(), pipeline);
      if (steps_ % simulator_.wheelSteps() == 0) deliver(Side::kUnsprung, simulator_.readWheel(), pipeline);
    }
  }

  double time() const { return simulator_.time(); }

 private:
  void deliver(Side side, double reading, VehiclePipeline& pipeline) {
    constexpr double kGravity = 9.81;
    const bool is_wheel = side == Side::kUnsprung;
    const double stamp = time() + (is_wheel ? delivery_.late : 0.0) + delivery_.jitter * normal_(random_);
    reading += kGravity;
    if (chance() < delivery_.spikes) reading += (chance() < 0.5 ? -1.0 : 1.0) * (20.0 + 80.0 * chance());
    if (delivery_.zeros && is_wheel && std::fmod(time(), 60.0) > 59.0) reading = 0.0;
    if (chance() >= delivery_.lost) pipeline.push(side, fromSeconds(stamp), reading);
  }

  double chance() { return uniform_(random_); }

  FieldSimulator simulator_;
  FieldDelivery delivery_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  long steps_ = 0;
};

/// Calls look(time, report) ten times per second of a drive, with the newest report; with an empty one if there was
/// none in the last second.
template <class Look>
void follow(FieldReadings readings, double seconds, VehiclePipeline& pipeline, const Look& look) {
  constexpr double kFresh = 1.0;  // [s]
  while (readings.time() < seconds) {
    readings.push(kFieldRate / 10, pipeline);
    MonitorReport report;
    if (pipeline.strut() != nullptr) report = pipeline.strut()->report();
    look(readings.time(), readings.time() - toSeconds(report.stamp) < kFresh ? report : MonitorReport{});
  }
}

/// Calls take(drive, measure(drive)) for every drive, in their order; measures two at a time.
template <class Drive, class Measure, class Take>
void measureEach(const std::vector<Drive>& drives, const Measure& measure, const Take& take) {
  const auto start = [&](std::size_t i) { return std::async(std::launch::async, measure, std::cref(drives[i])); };
  auto next = start(0);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    auto present = std::move(next);
    next = i + 1 < drives.size() ? start(i + 1) : decltype(next){};
    take(drives[i], present.get());
  }
}

}  // namespace suspension_health_monitor
