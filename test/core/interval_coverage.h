#pragma once

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"
#include "suspension_health_monitor/internal/vehicle/rough_strut.h"

namespace suspension_health_monitor {

/// How often an estimate plus and minus 1.96 stddev holds the truth.
struct Coverage {
  int intervals = 0, hits = 0;
  double squares = 0.0;  ///< of error / stddev

  void add(double error, double stddev) {
    ++intervals;
    hits += std::abs(error) <= 1.96 * stddev ? 1 : 0;
    squares += error * error / (stddev * stddev);
  }
  Coverage& operator+=(const Coverage& other) {
    intervals += other.intervals;
    hits += other.hits;
    squares += other.squares;
    return *this;
  }
  double share() const { return static_cast<double>(hits) / intervals; }
  double rms() const { return std::sqrt(squares / intervals); }
};

/// Of the block estimate: b1, b0.
using Coverages = std::array<Coverage, 2>;

inline Coverages& operator+=(Coverages& sum, const Coverages& other) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += other[i];
  return sum;
}

/// A drive without noise, whose parameters stay, to be measured again and again.
struct CleanDrive {
  std::vector<CornerSample> samples;
  double period, damping_to_mass, stiffness_to_mass;
};

inline CleanDrive cleanDrive(SimulationOptions options) {
  options.noise = 0.0;
  options.damping_end_fraction = 1.0;
  DriveSimulator simulator(options);
  CleanDrive drive{{}, 1.0 / options.rate, 0.0, 0.0};
  while (const auto sample = simulator.next()) {
    drive.samples.push_back({sample->stamp, sample->sprung->acceleration, sample->unsprung->acceleration});
    drive.damping_to_mass = sample->truth.damping_to_mass;
    drive.stiffness_to_mass = sample->truth.stiffness_to_mass;
  }
  return drive;
}

/// Calls take(sample) with the samples as two sensors with normal white noise of the same size read them.
template <class Take>
void measure(const CleanDrive& drive, double noise, unsigned seed, const Take& take) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, noise);
  for (CornerSample sample : drive.samples) {
    sample.sprung_acceleration += normal(generator);
    sample.unsprung_acceleration += normal(generator);
    take(sample);
  }
}

inline int proposedHorizon(const CleanDrive& drive, double noise) {
  Drive measured;
  measure(drive, noise, 1, [&](const CornerSample& sample) { measured.samples.push_back(sample); });
  return roughStrut({measured}, drive.period).value().horizonSamples(drive.period);
}

/// Valid estimates whose windows share no reading.
/// @param options  without a sample_period.  @param seeds  number of times that the drive is measured.
inline Coverages coverageOf(const CleanDrive& drive, double noise, MonitorSettings options, int seeds) {
  options.sample_period = drive.period;
  Coverages coverages;
  for (int seed = 1; seed <= seeds; ++seed) {
    SuspensionMonitor monitor(options);
    double next = 0.0;
    measure(drive, noise, static_cast<unsigned>(1000 + seed), [&](const CornerSample& sample) {
      const MonitorReport* report = monitor.addSample(sample);
      const double time = toSeconds(sample.stamp);
      if (report == nullptr || !report->estimate.valid() || time < next) return;
      const StrutEstimate& estimate = report->estimate;
      if (next > 0.0) {
        coverages[0].add(estimate.damping_to_mass - drive.damping_to_mass, estimate.damping_to_mass_stddev);
        coverages[1].add(estimate.stiffness_to_mass - drive.stiffness_to_mass, estimate.stiffness_to_mass_stddev);
      }
      next = time + estimate.window;
    });
  }
  return coverages;
}

}  // namespace suspension_health_monitor
