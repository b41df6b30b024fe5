#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"

namespace suspension_health_monitor {

/// A quarter car as it is met in the field, and the two IMUs on it.
struct FieldVehicle {
  const char* name;
  double b1, b0;         ///< beta/M [1/s], K/M [1/s^2]
  double wheel_to_body;  ///< m/M [-]
  double tyre_to_body;   ///< K0/M [1/s^2]
};

inline constexpr std::array kFieldVehicles{
    FieldVehicle{"golden car", 6.0, 63.3, 0.15, 653.0}, FieldVehicle{"sedan", 4.2, 52.0, 0.12, 600.0},
    FieldVehicle{"truck", 5.5, 90.0, 0.18, 420.0}, FieldVehicle{"robot", 9.0, 190.0, 0.25, 2300.0}};

/// A road, and how it is driven and measured on: as in FieldDrive.
struct FieldWay {
  const char* name;
  double road, speed;
  int rate;
};

/// What happens on a drive. Times in [s].
struct FieldDrive {
  FieldVehicle vehicle = kFieldVehicles[0];
  double road = 64e-6;  ///< Gd(0.1 cycles/m) [m^3]: 16e-6 is class A, each class four times as much
  double speed = 15.0;  ///< [m/s]
  int rate = 200;       ///< of both IMUs [Hz], a divisor of kFieldRate
  int wheel_steps = 0;  ///< of the integration, from one reading of the wheel's IMU to the next; 0: it reads at `rate`
  bool anti_aliased = true;
  double noise = 0.03;                               ///< of both IMUs [m/s^2]
  double wheel_noise = 1.0;                          ///< that of the wheel's, of it
  double offset = 0.0;                               ///< of the wheel's IMU [m/s^2]
  double offset_swing = 0.0, offset_period = 600.0;  ///< it drifts besides by +-swing [m/s^2]
  double tilt = 0.0;                                 ///< of the wheel's IMU from the body's: it reads braking [rad]
  double skew = 0.0;                                 ///< the wheel's readings are stamped so much late, up to 30 ms [s]
  double mass = 1.0;                                 ///< of the body, to that of the healthy vehicle
  bool potholes = false, washboard = false, stops = false;
  static constexpr double kStopsEvery = 60.0, kDrivesFor = 40.0;  ///< [s]; if it stops

  bool restsAt(double time) const { return stops && std::fmod(time, kStopsEvery) >= kDrivesFor; }
  double engine = 0.0;                      ///< acceleration of the body by an engine [m/s^2]
  double idle_from = 25.0, idle_to = 40.0;  ///< that turns at this frequency, slowly up and down [Hz]
  double friction = 0.0;                    ///< dry, between body and wheel, over the body's mass [m/s^2]
  double digressive = 0.0;                  ///< v0 of a damper b1 v / (1 + |v| / v0) [m/s]; 0: it is linear
  double asymmetry = 0.0;  ///< rebound is damped by so much more, compression by so much less than b1, as a share of it
  double fade = 0.0;       ///< share of the damping that is lost while it is hot
  double change_at = 1e300, damping_left = 1.0, stiffness_left = 1.0;
  double change_over = 0.0;  ///< strut and load change along a ramp of this length, second by second [s]; 0: at once
  double mass_after = 0.0;   ///< of the body in the end, to that of the healthy vehicle; 0: as it was
  double road_after = 0.0;   ///< the road from change_at on; 0: the same [m^3]
  unsigned seed = 1;
};

inline constexpr int kFieldRate = 2000;  ///< steps per second of the integration

/// Integrates the vehicle's equations (1), (2) in steps of 1/kFieldRate by their exact solution for a road that is
/// straight over a step, and what a strut has beside its linear force by steps of Euler; nothing is shared with the
/// package. The road is integrated white noise, G(n) = Gd(0.1) (0.1/n)^2 above 0.01 cycles/m, under a tyre that touches
/// 0.1 m of it.
class FieldSimulator {
 public:
  explicit FieldSimulator(const FieldDrive& drive) : drive_(drive), random_(drive.seed) {
    designFilter();
    refresh();
  }

  /// @return the next sample of both IMUs.
  CornerSample next() {
    for (int i = 0; i < bodySteps(); ++i) advance();
    const double body = readBody(), wheel = readWheel();
    return {fromSeconds(time_), body, wheel};
  }

  /// One step of the integration, for IMUs that are not read together.
  void advance() {
    step();
    const std::array motion{body_, lateWheel()};
    for (std::size_t i = 0; i < 2; ++i) {
      const double passed = filtered(i, motion[i]);
      sensed_[i] = drive_.anti_aliased ? passed : motion[i];
    }
  }

  /// @return what an IMU reads now, with new noise.
  double readBody() { return sensed_[0] + drive_.noise * gauss_(random_); }
  double readWheel() {
    const double offset = drive_.offset + drive_.offset_swing * std::sin(2 * M_PI * time_ / drive_.offset_period);
    return sensed_[1] + offset + drive_.tilt * braking_ + drive_.wheel_noise * drive_.noise * gauss_(random_);
  }

  /// Steps from one reading to the next.
  int bodySteps() const { return kFieldRate / drive_.rate; }
  int wheelSteps() const { return drive_.wheel_steps > 0 ? drive_.wheel_steps : bodySteps(); }

  double time() const { return time_; }

 private:
  static constexpr double kStep = 1.0 / kFieldRate;

  void refresh() {
    damping_left_ =
        changed(1.0, drive_.damping_left) * (1.0 - drive_.fade * 0.5 * (1.0 - std::cos(2 * M_PI * time_ / 1800.0)));
    const double b1 = drive_.vehicle.b1 * damping_left_;
    const double b0 = drive_.vehicle.b0 * changed(1.0, drive_.stiffness_left);
    const double body = drive_.mass_after > 0.0 ? changed(drive_.mass, drive_.mass_after) : drive_.mass;
    const double wheel = drive_.vehicle.wheel_to_body, tyre = drive_.vehicle.tyre_to_body;
    Eigen::Matrix<double, 7, 7> e = Eigen::Matrix<double, 7, 7>::Zero();  // z, w, z', w', road, force, road's rate
    e(0, 2) = e(1, 3) = 1.0;
    e.row(2) << -b0 / body, b0 / body, -b1 / body, b1 / body, 0.0, 1.0, 0.0;
    e.row(3) << b0 / wheel, -(b0 + tyre) / wheel, b1 / wheel, -b1 / wheel, tyre / wheel, 0.0, 0.0;
    e(4, 6) = 1.0;
    strut_ << 0.0, 0.0, 1.0 / body, -1.0 / wheel;
    derivative_ = e.block<2, 6>(2, 0);
    transition_ = (e * kStep).exp().topRows<4>();
  }

  double changed(double before, double after) const {
    if (time_ < drive_.change_at) return before;
    const double since = time_ - drive_.change_at;
    return since < drive_.change_over ? before + (after - before) * since / drive_.change_over : after;
  }

  double speed() {
    if (!drive_.stops) return drive_.speed;
    constexpr double kToStop = 4.0;  // [s], and to start
    const double since = std::fmod(time_, FieldDrive::kStopsEvery), until = FieldDrive::kDrivesFor - since;
    return drive_.speed * std::clamp(std::min(since, until) / kToStop, 0.0, 1.0);
  }

  double roadHeight() {
    constexpr double kBrakesBuildUp = 0.3;  // [s]
    const double v = speed();
    braking_ += kStep / kBrakesBuildUp * ((speed_ - v) / kStep - braking_);
    speed_ = v;
    const double road = time_ >= drive_.change_at && drive_.road_after > 0.0 ? drive_.road_after : drive_.road;
    const double density = 2 * M_PI * 0.1 * std::sqrt(road * v);  // of the road's rate
    profile_ += kStep * (-2 * M_PI * 0.01 * v * profile_ + density * gauss_(random_) / std::sqrt(2.0 * kStep));
    place_ += kStep * v;
    double height = profile_;
    if (drive_.potholes && v > 0.0) height += pothole();
    if (drive_.washboard && std::fmod(place_, 40.0 * drive_.speed) < 10.0 * drive_.speed)
      height += 0.006 * std::sin(2 * M_PI * place_ / 0.7);
    const double share = std::min(1.0, kStep * v / 0.05);
    for (double& enveloped : enveloped_) height = enveloped += share * (height - enveloped);
    return height;
  }

  double pothole() {
    if (place_ > pothole_ + 1.0) {
      pothole_ = place_ + drive_.speed * (5.0 + 30.0 * uniform_(random_));
      depth_ = 0.03 + 0.05 * uniform_(random_);
    }
    const double along = place_ - pothole_;
    return along > 0.0 && along < 0.6 ? -depth_ * 0.5 * (1.0 - std::cos(2 * M_PI * along / 0.6)) : 0.0;
  }

  void step() {
    if (++steps_ % kFieldRate == 0) refresh();
    time_ = static_cast<double>(steps_) * kStep;
    const double idle =
        drive_.idle_from + (drive_.idle_to - drive_.idle_from) * 0.5 * (1.0 + std::sin(2 * M_PI * time_ / 97.0));
    phase_ = std::fmod(phase_ + 2 * M_PI * idle * kStep, 2 * M_PI);
    const double height = roadHeight(), force = drive_.engine * std::sin(phase_);
    Eigen::Matrix<double, 7, 1> input;
    input << state_, height_, force, (height - height_) / kStep;
    state_ = transition_ * input + kStep * strutForce() * strut_;
    height_ = height;
    Eigen::Matrix<double, 6, 1> now;
    now << state_, height, force;
    const Eigen::Vector2d accelerations = derivative_ * now + strutForce() * strut_.tail<2>();
    body_ = accelerations[0];
    wheel_ = accelerations[1];
  }

  // Beside the linear one, over the healthy body's mass.
  double strutForce() const {
    constexpr double kCreep = 0.004;  // [m/s]
    const double rate = state_[3] - state_[2];
    double force = drive_.friction == 0.0 ? 0.0 : drive_.friction * std::tanh(rate / kCreep);
    if (drive_.digressive > 0.0)
      force -= drive_.vehicle.b1 * damping_left_ * rate * std::abs(rate) / (drive_.digressive + std::abs(rate));
    return force - drive_.asymmetry * drive_.vehicle.b1 * damping_left_ * std::abs(rate);  // compression is positive
  }

  // What the wheel did `skew` ago, by a straight line between steps.
  double lateWheel() {
    wheels_[static_cast<std::size_t>(steps_) % wheels_.size()] = wheel_;
    const double late = drive_.skew * kFieldRate, share = late - std::floor(late);
    const auto place = static_cast<std::size_t>(steps_) + wheels_.size() - static_cast<std::size_t>(late);
    return (1.0 - share) * wheels_[place % wheels_.size()] + share * wheels_[(place - 1) % wheels_.size()];
  }

  // Butterworth of fourth order at 0.35 of an IMU's rate, as two sections by the bilinear transform.
  void designFilter() {
    const std::array q{0.54119610, 1.3065630};
    for (std::size_t channel = 0; channel < 2; ++channel) {
      const double k = std::tan(M_PI * 0.35 / (channel == 0 ? bodySteps() : wheelSteps()));
      for (std::size_t i = 0; i < 2; ++i) {
        const double norm = 1.0 / (1.0 + k / q[i] + k * k);
        sections_[channel][i] = {k * k * norm, 2.0 * (k * k - 1.0) * norm, (1.0 - k / q[i] + k * k) * norm};
      }
    }
  }

  double filtered(std::size_t channel, double x) {
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& [gain, a1, a2] = sections_[channel][i];
      auto& [s1, s2] = memory_[channel][i];
      const double y = gain * x + s1;
      s1 = 2.0 * gain * x - a1 * y + s2;
      s2 = gain * x - a2 * y;
      x = y;
    }
    return x;
  }

  FieldDrive drive_;
  double damping_left_ = 1.0;  // share, now
  std::mt19937_64 random_;
  std::normal_distribution<double> gauss_;
  std::uniform_real_distribution<double> uniform_;
  Eigen::Matrix<double, 2, 6> derivative_;
  Eigen::Matrix<double, 4, 7> transition_;
  Eigen::Vector4d strut_ = Eigen::Vector4d::Zero();  // what a force of the strut does to the state
  Eigen::Vector4d state_ = Eigen::Vector4d::Zero();
  std::array<std::array<std::array<double, 3>, 2>, 2> sections_{};
  std::array<std::array<std::array<double, 2>, 2>, 2> memory_{};
  std::array<double, 2> sensed_{};  // by body's and wheel's IMU, without noise
  std::array<double, 2> enveloped_{};
  std::array<double, 64> wheels_{};  // of the newest steps
  long steps_ = 0;
  double time_ = 0.0, profile_ = 0.0, place_ = 0.0, pothole_ = 30.0, depth_ = 0.05, phase_ = 0.0;
  double height_ = 0.0, body_ = 0.0, wheel_ = 0.0, speed_ = drive_.stops ? 0.0 : drive_.speed, braking_ = 0.0;
};

}  // namespace suspension_health_monitor
