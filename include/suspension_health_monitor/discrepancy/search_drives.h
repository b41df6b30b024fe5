#pragma once

#include <deque>
#include <vector>

#include "suspension_health_monitor/discrepancy/drive_record.h"
#include "suspension_health_monitor/model/strut_model.h"
#include "suspension_health_monitor/monitor_options.h"

namespace suspension_health_monitor {

/// All samples of a drive, in the order of time.
using DriveSamples = std::vector<CornerSample>;

/// Where a search for missing effects starts: b1 and b0 by least squares over the regression rows of all drives.
/// Drives without excitation give no strut, see isDampedSpring().
/// @param options  with sample_period given.
StrutModel roughModel(const std::vector<DriveSamples>& drives, const MonitorOptions& options);

/// @return true if b1 > 0 and b0 > 0.
inline bool isDampedSpring(const StrutModel& model) {
  return model.damping_to_mass > 0.0 && model.stiffness_to_mass > 0.0;
}

/// The drives as records, integrated in steps that follow the strut's fastest motion.
/// @param period  sampling time T [s].  @param rough  a damped spring.
std::deque<DriveRecord> makeRecords(const std::vector<DriveSamples>& drives, double period, const StrutModel& rough);

/// @return the addresses of the records, as fits and searches take them.
std::vector<const DriveRecord*> pointersTo(const std::deque<DriveRecord>& records);

}  // namespace suspension_health_monitor
