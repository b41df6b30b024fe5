#pragma once

#include <cmath>
#include <random>
#include <vector>

/// Stands in for two accelerometers: a strut on rough ground, read at 100 Hz with noise and gravity.
class SimulatedStrut {
 public:
  static constexpr double kPeriod = 0.01;  // [s]

  struct Readings {
    double body, wheel;  // [m/s^2]
  };

  double damping = 4.0, stiffness = 40.0;     // by the body's mass [1/s], [1/s^2]
  double stop_stiffness = 0.0, stop = 0.013;  // [1/s^2], travel at which the bump stop is met [m]

  /// @param roughness  of the ground: amplitude of each of its waves [m/s^2].
  explicit SimulatedStrut(double roughness) : roughness_(roughness) {
    std::uniform_real_distribution<double> phase(0.0, 6.28);
    for (double f = 0.15; f < 12.0; f *= 1.07) waves_.push_back({6.2832 * f, phase(engine_)});
  }

  Readings next() {
    constexpr int kSteps = 20;
    constexpr double kStep = kPeriod / kSteps;
    Readings read{};
    for (int i = 0; i < kSteps; ++i) {
      double wheel = 0.0;  // w''
      for (const Wave& wave : waves_) wheel += roughness_ * std::sin(wave.frequency * time_ + wave.phase);
      const double body = damping * rate_ + stiffness * travel_ + stop_stiffness * std::fmax(0.0, travel_ - stop);
      if (i == 0) read = {9.81 + body + noise_(engine_), 9.81 + wheel + noise_(engine_)};
      rate_ += kStep * (wheel - body);
      travel_ += kStep * rate_;
      time_ += kStep;
    }
    return read;
  }

  struct Recording {
    std::vector<double> body, wheel;  // [m/s^2]
  };

  Recording record(int samples) {
    Recording recording;
    for (int i = 0; i < samples; ++i) {
      const Readings readings = next();
      recording.body.push_back(readings.body);
      recording.wheel.push_back(readings.wheel);
    }
    return recording;
  }

 private:
  struct Wave {
    double frequency, phase;  // [rad/s], [rad]
  };

  double roughness_;
  std::mt19937 engine_{1};
  std::normal_distribution<double> noise_{0.0, 0.03};
  std::vector<Wave> waves_;
  double travel_ = 0.0, rate_ = 0.0, time_ = 0.0;  // [m] and [m/s], compression positive; [s]
};
