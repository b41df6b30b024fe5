#pragma once

#include <random>
#include <vector>

#include "paper_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

/// What health said of a healthy strut.
struct DayCounts {
  long warn = 0, error = 0, early = 0;  ///< times that it began
  long stale = 0, samples = 0;
};

/// The paper's healthy drive at 50 Hz, repeated with fresh noise; in every minute a second of zeros, in every two
/// minutes two bumps into the stops, at 85 s and 110 s.
/// @param noise  distribution of a reading's error [m/s^2].
template <class Noise>
DayCounts healthyDay(const MonitorSettings& options, double hours, unsigned seed, Noise noise) {
  constexpr double kSampling = 0.02;
  SimulationOptions drive;
  drive.scenario = "paper_saturation";
  drive.damping_end_fraction = 1.0;
  drive.noise = 0.0;
  drive.duration = 120.0;
  const std::vector<CornerSample> clean = simulate(drive);
  std::mt19937 random(seed);
  SuspensionMonitor monitor(options);
  DayCounts counts;
  HealthReport before;
  for (Stamp stamp{}; toSeconds(stamp) < 3600.0 * hours;)
    for (std::size_t k = 0; k + 1 < clean.size(); ++k, stamp += fromSeconds(kSampling)) {
      CornerSample sample{stamp, clean[k].sprung_acceleration + noise(random),
                          clean[k].unsprung_acceleration + noise(random)};
      if (k % 3000 >= 1250 && k % 3000 < 1300) sample.sprung_acceleration = sample.unsprung_acceleration = 0.0;
      const MonitorReport* report = monitor.addSample(sample);
      if (report == nullptr) continue;
      const HealthReport& now = report->health;
      counts.warn += now.level == HealthLevel::kWarn && before.level != now.level ? 1 : 0;
      counts.error += now.level == HealthLevel::kError && before.level != now.level ? 1 : 0;
      counts.early += now.early_warning && !before.early_warning ? 1 : 0;
      counts.stale += now.level == HealthLevel::kStale ? 1 : 0;
      ++counts.samples;
      before = now;
    }
  return counts;
}

}  // namespace suspension_health_monitor
