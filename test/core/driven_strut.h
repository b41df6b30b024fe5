#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

#include "monitor_settings.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

constexpr double kPeriod = 0.02;         // [s]
constexpr double kB1 = 3.0, kB0 = 13.8;  // [1/s], [1/s^2]

/// A strut over a wheel whose height is given, and sensors with noise.
class DrivenStrut {
 public:
  explicit DrivenStrut(const MonitorSettings& options, std::uint64_t seed = 11) : monitor_(options), engine_(seed) {}

  double b1 = kB1, b0 = kB0, noise = 0.024;

  /// @param height  w(t) [m].
  void drive(int samples, const std::function<double(double)>& height) {
    constexpr int kSteps = 10;
    constexpr double h = kPeriod / kSteps;
    for (int k = 0; k < samples; ++k) {
      double wheel = 0.0, body = 0.0;
      for (int step = 0; step < kSteps; ++step) {
        const double before = height(t_ - h), now = height(t_), after = height(t_ + h);
        wheel = (after - 2.0 * now + before) / (h * h);
        body = b1 * ((after - before) / (2.0 * h) - v_) + b0 * (now - z_);
        if (step + 1 == kSteps) break;
        advance(body, h);
      }
      add(body, wheel);
      advance(body, h);
    }
  }

  /// At rest: nothing but noise.
  void park(int samples) {
    for (int k = 0; k < samples; ++k) add(0.0, 0.0);
  }

  /// At rest, but for a reading.
  void read(double body, double wheel) { add(body, wheel); }

  /// At rest, with a body that the engine shakes.
  void idle(int samples, double amplitude, double frequency) {
    for (int k = 0; k < samples; ++k) add(amplitude * std::sin(2.0 * M_PI * frequency * kPeriod * k), 0.0);
  }

  const StrutEstimate& estimate() const { return monitor_.report().estimate; }
  const StrutEstimate& la() const { return monitor_.report().la; }
  const StrutEstimate& ls() const { return monitor_.report().ls; }
  const HealthReport& health() const { return monitor_.report().health; }
  double time() const { return t_; }

 private:
  void advance(double body, double h) {
    v_ += h * body;
    z_ += h * v_;
    t_ += h;
  }

  void add(double body, double wheel) {
    stamp_ += std::chrono::milliseconds(20);
    monitor_.addSample({stamp_, 9.81 + body + noise * normal_(engine_), 9.81 + wheel + noise * normal_(engine_)});
  }

  SuspensionMonitor monitor_;
  double z_ = 0.0, v_ = 0.0, t_ = 0.0;
  Stamp stamp_{};
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

/// A rough road that begins and ends gently.
inline std::function<double(double)> roadBetween(double begin, double end) {
  return [=](double t) {
    if (t <= begin || t >= end) return 0.0;
    const double gentle = std::pow(std::sin(0.5 * M_PI * std::min({1.0, (t - begin) / 3.0, (end - t) / 3.0})), 2);
    return gentle * (0.02 * std::sin(2.0 * M_PI * 0.55 * t) + 0.01 * std::sin(2.0 * M_PI * 1.3 * t + 1.0) +
                     0.006 * std::sin(2.0 * M_PI * 2.7 * t + 2.0));
  };
}

}  // namespace suspension_health_monitor
