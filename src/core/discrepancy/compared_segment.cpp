#include "suspension_health_monitor/discrepancy/compared_segment.h"

#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "suspension_health_monitor/discrepancy/output_error_fit.h"
#include "suspension_health_monitor/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kForgotten = 1.0 / 3.0;  // of the natural frequency: what is slower is not integrated
constexpr double kPadding = 6.0;          // times of the slowest frequency that is: ends do not reach each other

/// A residual integrated once and twice, without what drifts.
struct Integrals {
  std::vector<double> once, twice;
};

Integrals integrate(const std::vector<double>& residual, double mean, double period, double slowest) {
  const std::size_t count = residual.size();
  std::size_t length = 2;
  while (static_cast<double>(length) < static_cast<double>(count) + kPadding / (slowest * period)) length *= 2;
  std::vector<double> padded(length, 0.0);
  for (std::size_t k = 0; k < count; ++k) padded[k] = residual[k] - mean;
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> spectrum, once(length / 2 + 1), twice(length / 2 + 1);
  fft.fwd(spectrum, padded);
  for (std::size_t i = 1; i <= length / 2; ++i) {
    const double omega = 2.0 * kPi * static_cast<double>(i) / (static_cast<double>(length) * period);
    const double kept = 1.0 / (1.0 + std::pow(slowest / omega, 4));
    once[i] = spectrum[i] * kept / std::complex<double>(0.0, omega);
    twice[i] = -spectrum[i] * kept / (omega * omega);
  }
  once[length / 2] = 0.0;  // imaginary, which a real signal cannot have there
  Integrals integrals;
  fft.inv(integrals.once, once);
  fft.inv(integrals.twice, twice);
  integrals.once.resize(count);
  integrals.twice.resize(count);
  return integrals;
}

double meanResidual(const std::vector<ComparedSegment>& segments) {
  double sum = 0.0, count = 0.0;
  for (const ComparedSegment& segment : segments) {
    for (std::size_t k = 0; k < segment.size(); ++k) sum += segment.residual(k);
    count += static_cast<double>(segment.size());
  }
  return count > 0.0 ? sum / count : 0.0;
}

void addMissingForce(const StrutModel& model, const std::vector<StrutState>& motion, double mean,
                     ComparedSegment& segment) {
  std::vector<double> residual(segment.size());
  for (std::size_t k = 0; k < segment.size(); ++k) residual[k] = segment.residual(k);
  const Integrals wrong = integrate(residual, mean, segment.period, kForgotten * std::sqrt(model.stiffness_to_mass));
  std::vector<double>& force = segment.missing_force;
  force.resize(segment.size());
  for (std::size_t k = 0; k < segment.size(); ++k)
    force[k] = model.force(segment.travel[k] - wrong.twice[k], segment.travel_rate[k] - wrong.once[k], segment.time(k),
                           motion[k].memory.data());
  for (const ActiveMeasurementEffect& reading : model.reading)
    reading.effect.apply(reading.coefficient, segment.period, force);
  for (std::size_t k = 0; k < segment.size(); ++k) force[k] = segment.measured[k] - force[k];
}

ComparedSegment makeSegment(const StrutModel& model, const DriveRecord& record, const DriveSegment& source,
                            const std::vector<StrutState>& motion) {
  ComparedSegment segment;
  segment.start = source.start;
  segment.period = record.period();
  segment.measured = source.sprung;
  segment.wheel = source.unsprung;
  for (std::size_t k = 0; k < source.size(); ++k) {
    const StrutState& state = motion[k];
    segment.travel.push_back(state.travel);
    segment.travel_rate.push_back(state.travel_rate);
    segment.added_force.push_back(model.force(state.travel, state.travel_rate, segment.time(k), state.memory.data()) -
                                  model.damping_to_mass * state.travel_rate - model.stiffness_to_mass * state.travel);
  }
  return segment;
}

}  // namespace

std::optional<std::vector<ComparedSegment>> compareSegments(const std::vector<const DriveRecord*>& records,
                                                            const StrutModel& model,
                                                            const std::vector<StrutState>& initial) {
  std::vector<ComparedSegment> segments;
  std::vector<std::vector<StrutState>> motions;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (const DriveSegment& source : records[r]->segments()) {
      std::vector<double> predicted;
      motions.emplace_back();
      if (!runFree(model, *records[r], source, initial[segments.size()], predicted, &motions.back()))
        return std::nullopt;
      segments.push_back(makeSegment(model, *records[r], source, motions.back()));
      segments.back().record = r;
      segments.back().predicted = std::move(predicted);
    }
  const double mean = meanResidual(segments);
  for (std::size_t i = 0; i < segments.size(); ++i) addMissingForce(model, motions[i], mean, segments[i]);
  return segments;
}

}  // namespace suspension_health_monitor
