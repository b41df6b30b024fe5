#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"

namespace suspension_health_monitor {

/// Lines of random frequency and phase within a band: noise that ends where the band does, known between samples.
class BandNoise {
 public:
  /// @param low, high  [Hz].
  BandNoise(int seed, double low, double high, double rms, int lines = 200) : scale_(rms * std::sqrt(2.0 / lines)) {
    RandomStream random(seed, RandomPurpose::kRoad);
    for (int i = 0; i < lines; ++i)
      lines_.push_back({2.0 * M_PI * (low + (high - low) * random.uniform()), 2.0 * M_PI * random.uniform()});
  }

  double operator()(double t) const {
    double sum = 0.0;
    for (const Line& line : lines_) sum += std::sin(line.omega * t + line.phase);
    return scale_ * sum;
  }

 private:
  struct Line {
    double omega, phase;
  };
  double scale_;
  std::vector<Line> lines_;
};

/// What moves: travel, its rate, a memory of the law, and the body's velocity.
struct MassState {
  double d = 0.0, v = 0.0, s = 0.0, body = 0.0;

  MassState moved(double by, const MassState& slope) const {
    return {d + by * slope.d, v + by * slope.v, s + by * slope.s, body + by * slope.body};
  }
};

/// A mass on a law whose lower end is shaken, integrated here by the classical Runge-Kutta method in steps of 1/20
/// sample: no part of the library is between the law and the readings.
struct DrivenMass {
  double rate;                                              ///< [Hz]
  std::function<double(double t)> shake;                    ///< w'' [m/s^2]
  std::function<double(const MassState&, double t)> force;  ///< z'' [m/s^2]
  std::function<double(const MassState&)> memory_rate = [](const MassState&) { return 0.0; };
  double noise = 0.0;                                                   ///< of both sensors, white [m/s^2]
  std::function<double(double t)> sensed = [](double) { return 0.0; };  ///< what the body's sensor adds [m/s^2]

  Drive drive(std::size_t samples, int seed = 1) const {
    RandomStream random(seed, RandomPurpose::kSprungNoise);
    Drive result;
    MassState x;
    for (std::size_t k = 0; k < samples; ++k) {
      const double t = static_cast<double>(k) / rate;
      result.samples.push_back(
          {fromSeconds(t), force(x, t) + sensed(t) + noise * random.gaussian(), shake(t) + noise * random.gaussian()});
      for (int i = 0; i < kSteps; ++i) step((static_cast<double>(k) + static_cast<double>(i) / kSteps) / rate, x);
    }
    return result;
  }

 private:
  static constexpr int kSteps = 20;

  MassState slope(double wheel, double t, const MassState& x) const {
    const double z = force(x, t);
    return {x.v, wheel - z, memory_rate(x), z};
  }

  void step(double t, MassState& x) const {
    const double h = 1.0 / rate / kSteps, start = shake(t), middle = shake(t + h / 2), end = shake(t + h);
    const MassState k1 = slope(start, t, x), k2 = slope(middle, t + h / 2, x.moved(h / 2, k1));
    const MassState k3 = slope(middle, t + h / 2, x.moved(h / 2, k2)), k4 = slope(end, t + h, x.moved(h, k3));
    x = x.moved(h / 6, k1).moved(h / 3, k2).moved(h / 3, k3).moved(h / 6, k4);
  }
};

}  // namespace suspension_health_monitor
