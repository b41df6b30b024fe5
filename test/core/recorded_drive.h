#pragma once

#include <cmath>
#include <optional>

#include "suspension_health_monitor/discrepancy/drive_record.h"
#include "suspension_health_monitor/simulation/drive_simulator.h"

namespace suspension_health_monitor {

/// A simulated drive as the fits take it. Lost messages end a stretch.
inline DriveRecord recorded(const SimulationOptions& options) {
  DriveRecord record(1.0 / options.rate, 1);
  DriveSimulator simulator(options);
  while (const std::optional<DriveSample> sample = simulator.next())
    if (sample->sprung && sample->unsprung)
      record.push({sample->stamp, sample->sprung->acceleration, sample->unsprung->acceleration});
  record.finish();
  return record;
}

/// Two accelerations given as functions of the sample's index.
template <class Sprung, class Unsprung>
DriveRecord recorded(int samples, double period, const Sprung& sprung, const Unsprung& unsprung, int steps = 1) {
  DriveRecord record(period, steps);
  for (int k = 0; k < samples; ++k) record.push({fromSeconds(k * period), sprung(k), unsprung(k)});
  record.finish();
  return record;
}

}  // namespace suspension_health_monitor
