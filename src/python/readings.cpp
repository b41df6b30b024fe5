#include "readings.h"

#include <string>

#include "suspension_health_monitor/internal/signal/period_measurement.h"
#include "suspension_health_monitor/internal/signal/tuning.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"

namespace suspension_health_monitor {
namespace {

std::optional<double> spacingOf(const Recordings& recordings) {
  PeriodMeasurement measurement(PeriodMeasurement::kFewestOfRecording);
  for (const Recording& recording : recordings)
    recording.forEach([&](Side side, Stamp stamp, double) { measurement.add(side, stamp); });
  return measurement.period();
}

}  // namespace

std::size_t sizeOf(const Recordings& recordings) {
  std::size_t sum = 0;
  for (const Recording& recording : recordings)
    for (const auto& [stamps, values] : recording.streams) sum += static_cast<std::size_t>(stamps.size());
  return sum;
}

std::vector<BodyMotion> Recording::bodyMotion(Stamp shift) const {
  std::vector<BodyMotion> motion;
  if (!across) return motion;
  const auto rows = across->unchecked<2>();
  const std::int64_t* stamps = streams.front().first.data();
  std::optional<Stamp> last;
  for (Py_ssize_t k = 0; k < rows.shape(0); ++k) {
    const Stamp stamp = Stamp(stamps[k]) + shift;
    if (last && stamp <= *last) continue;
    last = stamp;
    motion.push_back({stamp, {rows(k, 0), rows(k, 1)}, {rows(k, 2), rows(k, 3)}});
  }
  return motion;
}

Stamp shiftOf(const Recordings& recordings) {
  constexpr Stamp kFirst(1);
  Stamp earliest = kFirst;
  for (const Recording& recording : recordings)
    for (const auto& [stamps, values] : recording.streams)
      if (stamps.size() > 0) earliest = std::min(earliest, Stamp(*stamps.data()));
  return kFirst - earliest;
}

void requireFittingPeriod(const Recordings& recordings, const MonitorOptions& options) {
  if (!options.sample_period) return;
  const std::string short_period = describeShortPeriod(*options.sample_period, spacingOf(recordings));
  if (!short_period.empty()) throw std::invalid_argument(short_period);
}

double periodOf(const Recordings& recordings, const MonitorOptions& options) {
  requireFittingPeriod(recordings, options);
  if (options.sample_period) return *options.sample_period;
  const std::optional<double> period = spacingOf(recordings);
  if (!period) throw std::invalid_argument(describeNoPeriod("of one of the sensors", sizeOf(recordings)));
  MonitorOptions measured;
  measured.sample_period = period;
  validate(measured, kMonitorFields);
  return *period;
}

std::vector<Drive> toDrives(const Recordings& recordings, const MonitorOptions& options, double period, Stamp shift,
                            LongWork& work) {
  std::vector<Drive> drives;
  for (const Recording& recording : recordings) {
    Drive& drive = drives.emplace_back();
    VehicleGrid grid(period, VehicleStreams(VehicleLayout::ofOneStrut(false)), MonitorSettings(options).grid(period),
                     [&](const VehicleSample& sample) { drive.samples.push_back(sample.ofStrut(0)); });
    drive.body = recording.bodyMotion(shift);
    recording.forEach([&](Side side, Stamp stamp, double value) {
      if (side == Side::kRoad) return;
      work.step();
      if (grid.push(indexOf(side), stamp + shift, &value)) dropNewest(drive.samples, kSignalTuning.outcomes);
    });
  }
  return drives;
}

}  // namespace suspension_health_monitor
