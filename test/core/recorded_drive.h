#pragma once

#include <cmath>
#include <optional>

#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"

namespace suspension_health_monitor {

/// A simulated drive as the fits take it. Lost messages end a stretch.
inline DriveRecord recorded(const SimulationOptions& options) {
  Drive record_drive;
  DriveSimulator simulator(options);
  while (const std::optional<DriveSample> sample = simulator.next())
    if (sample->sprung && sample->unsprung)
      record_drive.samples.push_back({sample->stamp, sample->sprung->acceleration, sample->unsprung->acceleration});
  const DriveRecord record(record_drive, 1.0 / options.rate, 1);
  return record;
}

/// Two accelerations given as functions of the sample's index.
template <class Sprung, class Unsprung>
DriveRecord recorded(int samples, double period, const Sprung& sprung, const Unsprung& unsprung, int steps = 1) {
  Drive record_drive;
  for (int k = 0; k < samples; ++k) record_drive.samples.push_back({fromSeconds(k * period), sprung(k), unsprung(k)});
  const DriveRecord record(record_drive, period, steps);
  return record;
}

}  // namespace suspension_health_monitor
