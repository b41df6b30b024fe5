
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/fit/motion_error.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/signal/low_pass.h"

namespace suspension_health_monitor {
namespace {

/// @param taps  of the filter that the drive has passed.
void addMissingForce(const StrutModel& model, const std::vector<StrutState>& motion, double mean,
                     const std::vector<double>& taps, ComparedSegment& segment) {
  const MotionError wrong = motionError(segment.residuals(), mean, segment.period, model.stiffness_to_mass);
  std::vector<double>& force = segment.missing_force;
  force.resize(segment.size());
  for (std::size_t k = 0; k < segment.size(); ++k)
    force[k] = model.force(segment.travel[k] - wrong.travel[k], segment.travel_rate[k] - wrong.travel_rate[k],
                           segment.timeDriven(k), motion[k].memory.data());
  passLow(taps, force);
  for (const ActiveMeasurementEffect& reading : model.reading)
    reading.effect.apply(reading.coefficients.data(), segment.body, segment.period, force);
  for (std::size_t k = 0; k < segment.size(); ++k) force[k] = segment.measured[k] - force[k];
}

ComparedSegment makeSegment(const StrutModel& model, const DriveSegment& source,
                            const std::vector<StrutState>& motion) {
  ComparedSegment segment;
  segment.start = source.start;
  segment.driven_before = source.driven_before;
  segment.period = source.period;
  segment.measured = source.sprung;
  segment.wheel = source.unsprung;
  segment.body = source.body;
  for (std::size_t k = 0; k < source.size(); ++k) {
    const StrutState& state = motion[k];
    segment.travel.push_back(state.travel);
    segment.travel_rate.push_back(state.travel_rate);
    segment.added_force.push_back(
        model.force(state.travel, state.travel_rate, segment.timeDriven(k), state.memory.data()) -
        model.damping_to_mass * state.travel_rate - model.stiffness_to_mass * state.travel);
  }
  passLow(source.taps, segment.added_force);
  return segment;
}

}  // namespace

std::vector<double> ComparedSegment::residuals() const {
  std::vector<double> all(size());
  for (std::size_t k = 0; k < size(); ++k) all[k] = residual(k);
  return all;
}

Residuals residualsOf(const std::vector<ComparedSegment>& segments) {
  Residuals residuals;
  for (const ComparedSegment& segment : segments) residuals.push_back(segment.residuals());
  return residuals;
}

std::optional<ComparedDrives> compareSegments(const Records& records, const StrutModel& model,
                                              const std::vector<StrutState>& initial) {
  ComparedDrives drives;
  auto& [segments, motion] = drives;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (const DriveSegment& source : records[r]->segments()) {
      std::vector<double> predicted;
      motion.emplace_back();
      if (!runFree(model, source, initial[segments.size()], predicted, &motion.back())) return std::nullopt;
      segments.push_back(makeSegment(model, source, motion.back()));
      segments.back().drive = r;
      segments.back().predicted = std::move(predicted);
    }
  const double mean = meanOf(residualsOf(segments));
  const std::vector<const DriveSegment*> sources = segmentsOf(records);
  for (std::size_t i = 0; i < segments.size(); ++i)
    addMissingForce(model, motion[i], mean, sources[i]->taps, segments[i]);
  return drives;
}

}  // namespace suspension_health_monitor
