#pragma once

// Whole vehicles for the tables of doc/vehicle.md: a rigid body on N struts, integrated by classical Runge-Kutta, with
// tracks of filtered noise and an anti-alias filter before the sampling. It shares no code with the package, so that no
// table checks a formula against itself.

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace vehicle_drive {

inline constexpr double kPi = 3.14159265358979323846;

struct Strut {
  double x, y;                // [m], from the centre of gravity, forward and left
  double damping, stiffness;  // [N s/m], [N/m]
  double wheel_mass, tyre;    // [kg], [N/m]
  double tyre_damping;        // [N s/m]
};

struct Vehicle {
  std::string name;
  double mass, pitch_inertia, roll_inertia;  // [kg], [kg m^2]; 0: does not rotate so
  std::vector<Strut> struts;
  double speed;      // [m/s]
  double roughness;  // ISO 8608 G_d(n0) [m^3]
  double horizon;    // [s] that suits it

  double mobility(std::size_t i, std::size_t j) const { return mobility(i, struts[j].x, struts[j].y); }
  double mobility(std::size_t i, double x, double y) const {
    double sum = 1.0 / mass;
    if (pitch_inertia > 0) sum += struts[i].x * x / pitch_inertia;
    if (roll_inertia > 0) sum += struts[i].y * y / roll_inertia;
    return sum;
  }
  double b1(std::size_t i) const { return mobility(i, i) * struts[i].damping; }
  double b0(std::size_t i) const { return mobility(i, i) * struts[i].stiffness; }
};

enum class Tracks { kCoherent, kIndependent, kIdentical };

/// Force of a hidden effect of strut i [N], of travel, travel rate and time.
using Law = std::function<double(double, double, double)>;

/// A six-axis IMU of the body, as high as the struts' tops.
struct BodyImu {
  double x, y;          // [m], from the centre of gravity
  double gyro = 0.002;  // [rad/s], noise
};

struct Drive {
  double seconds = 120.0, rate = 100.0;
  double noise = 0.03;  // [m/s^2]
  Tracks tracks = Tracks::kCoherent;
  unsigned seed = 1;
  std::vector<Law> hidden;            // one per strut, empty: none
  double anti_roll = 0.0;             // [N/m] between struts 0 and 1
  double offset = 0.0;                // [m/s^2], largest of a sensor
  double pull = 0.0;                  // [N], rms of a vertical force on the body that is measured
  double pull_x = 0.0, pull_y = 0.0;  // [m], where it acts, from the centre of gravity
  std::optional<BodyImu> imu;
};

struct Record {
  std::vector<std::vector<double>> body, wheel;    // by strut [m/s^2]
  std::vector<std::vector<double>> imu;            // of the body: upward [m/s^2], rates of roll and pitch [rad/s]
  std::vector<double> travel, travel_rate, force;  // rms by strut [m], [m/s], [N]
  std::vector<double> pull;                        // [N], up positive
};

inline std::vector<double> lowPass(double cutoff, double rate, int half) {
  std::vector<double> taps;
  double sum = 0.0;
  for (int i = -half; i <= half; ++i) {
    const double x = 2 * cutoff / rate * i;
    const double sinc = i == 0 ? 1.0 : std::sin(kPi * x) / (kPi * x);
    const double window = 0.54 + 0.46 * std::cos(kPi * i / half);
    taps.push_back(sinc * window);
    sum += taps.back();
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

inline std::vector<double> track(std::mt19937& random, std::size_t n, double dt, const Vehicle& vehicle) {
  std::normal_distribution<double> normal;
  // Displacement spectrum G_d(n0) (n / n0)^-2 is white vertical speed.
  const double size = 2 * kPi * 0.1 * std::sqrt(vehicle.roughness * vehicle.speed / (2 * dt));
  const double leak = std::exp(-2 * kPi * 0.05 * dt);
  std::vector<double> height(n);
  double now = 0.0;
  for (double& each : height) {
    now = leak * now + size * normal(random) * dt;
    each = now;
  }
  return height;
}

inline std::vector<double> smooth(const std::vector<double>& input, double corner, double dt) {
  const double gain = 1.0 - std::exp(-2 * kPi * corner * dt);
  std::vector<double> output;
  double now = input.front();
  for (double each : input) output.push_back(now += gain * (each - now));
  return output;
}

/// Noise between about 0.3 and 4 Hz, of this rms.
inline std::vector<double> pulling(double rms, unsigned seed, std::size_t n, double dt) {
  std::mt19937 random(seed * 104729 + 5);
  std::normal_distribution<double> normal;
  std::vector<double> force(n);
  for (double& each : force) each = normal(random);
  for (const double corner : {4.0, 4.0}) force = smooth(force, corner, dt);
  const std::vector<double> slow = smooth(force, 0.3, dt);
  double square = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    force[k] -= slow[k];
    square += force[k] * force[k] / static_cast<double>(n);
  }
  for (double& each : force) each *= rms / std::sqrt(square);
  return force;
}

inline Record drive(const Vehicle& vehicle, const Drive& options) {
  constexpr int kSub = 16;
  constexpr double kLead = 8.0;  // [s] before the record
  const double rate = options.rate * kSub, dt = 1.0 / rate;
  const std::size_t n = vehicle.struts.size();
  const auto steps = static_cast<std::size_t>((options.seconds + kLead + 1.0) * rate);
  std::mt19937 random(options.seed);
  std::vector<double> left = track(random, steps, dt, vehicle), right = left;
  if (options.tracks == Tracks::kIndependent) right = track(random, steps, dt, vehicle);
  if (options.tracks == Tracks::kCoherent) {
    // What is longer than the track's width is the same on both sides.
    const double corner = vehicle.speed / (2 * kPi * 1.2);
    const std::vector<double> shared = smooth(left, corner, dt);
    for (std::vector<double>* side : {&left, &right}) {
      std::vector<double> own = track(random, steps, dt, vehicle);
      const std::vector<double> slow = smooth(own, corner, dt);
      for (std::size_t k = 0; k < steps; ++k) (*side)[k] = shared[k] + own[k] - slow[k];
    }
  }
  const std::vector<double> pull = pulling(options.pull, options.seed, steps, dt);
  double front = -1e9;
  for (const Strut& strut : vehicle.struts) front = std::max(front, strut.x);

  // State: heave, pitch, roll, wheels; then their speeds.
  const std::size_t dof = 3 + n;
  std::vector<double> state(2 * dof, 0.0), top(n), force(n);
  const auto road = [&](std::size_t i, std::size_t k) {
    const auto late = static_cast<std::size_t>((front - vehicle.struts[i].x) / vehicle.speed * rate);
    return (vehicle.struts[i].y >= 0 ? left : right)[k >= late ? k - late : 0];
  };
  const std::size_t channels = 2 * n + (options.imu ? 3 : 0);
  std::vector<double> readings(channels);
  const auto slope = [&](const std::vector<double>& s, std::size_t k, double half, double time) {
    std::vector<double> d(2 * dof, 0.0);
    for (std::size_t i = 0; i < dof; ++i) d[i] = s[dof + i];
    std::vector<double> travel(n), speed(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Strut& strut = vehicle.struts[i];
      travel[i] = s[3 + i] - (s[0] + strut.x * s[1] + strut.y * s[2]);
      speed[i] = s[dof + 3 + i] - (s[dof] + strut.x * s[dof + 1] + strut.y * s[dof + 2]);
      force[i] = strut.damping * speed[i] + strut.stiffness * travel[i];
      if (i < options.hidden.size() && options.hidden[i]) force[i] += options.hidden[i](travel[i], speed[i], time);
    }
    if (options.anti_roll != 0.0) {
      const double bar = options.anti_roll * (travel[0] - travel[1]);
      force[0] += bar;
      force[1] -= bar;
    }
    const double load = pull[k] + half * (pull[k + 1] - pull[k]);
    d[dof] += load / vehicle.mass;
    if (vehicle.pitch_inertia > 0) d[dof + 1] += load * options.pull_x / vehicle.pitch_inertia;
    if (vehicle.roll_inertia > 0) d[dof + 2] += load * options.pull_y / vehicle.roll_inertia;
    for (std::size_t i = 0; i < n; ++i) {
      const Strut& strut = vehicle.struts[i];
      d[dof] += force[i] / vehicle.mass;
      if (vehicle.pitch_inertia > 0) d[dof + 1] += force[i] * strut.x / vehicle.pitch_inertia;
      if (vehicle.roll_inertia > 0) d[dof + 2] += force[i] * strut.y / vehicle.roll_inertia;
      const double height = road(i, k) + half * (road(i, k + 1) - road(i, k));
      d[dof + 3 + i] =
          (-force[i] + strut.tyre * (height - s[3 + i]) - strut.tyre_damping * s[dof + 3 + i]) / strut.wheel_mass;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const Strut& strut = vehicle.struts[i];
      readings[i] = d[dof] + strut.x * d[dof + 1] + strut.y * d[dof + 2];
      readings[n + i] = d[dof + 3 + i];
    }
    if (options.imu) {
      readings[2 * n] = d[dof] + options.imu->x * d[dof + 1] + options.imu->y * d[dof + 2];
      readings[2 * n + 1] = s[dof + 2];
      readings[2 * n + 2] = -s[dof + 1];  // about the axis to the left a positive rate turns the nose down
    }
    return d;
  };

  const std::vector<double> taps = lowPass(0.4 * options.rate, rate, 6 * kSub);
  std::vector<std::vector<double>> raw(channels, std::vector<double>(steps - 1));
  Record record;
  record.travel.assign(n, 0.0), record.travel_rate = record.force = record.travel;
  const auto moved = [](const std::vector<double>& s, double by, const std::vector<double>& d) {
    std::vector<double> to = s;
    for (std::size_t i = 0; i < s.size(); ++i) to[i] += by * d[i];
    return to;
  };
  for (std::size_t k = 0; k + 1 < steps; ++k) {
    const double time = static_cast<double>(k) * dt - kLead;
    const std::vector<double> k1 = slope(state, k, 0.0, time);
    for (std::size_t c = 0; c < channels; ++c) raw[c][k] = readings[c];
    for (std::size_t i = 0; i < n; ++i) {
      const Strut& strut = vehicle.struts[i];
      const double d = state[3 + i] - (state[0] + strut.x * state[1] + strut.y * state[2]);
      const double v = state[dof + 3 + i] - (state[dof] + strut.x * state[dof + 1] + strut.y * state[dof + 2]);
      record.travel[i] += d * d / static_cast<double>(steps);
      record.travel_rate[i] += v * v / static_cast<double>(steps);
      record.force[i] += force[i] * force[i] / static_cast<double>(steps);
    }
    const std::vector<double> k2 = slope(moved(state, dt / 2, k1), k, 0.5, time);
    const std::vector<double> k3 = slope(moved(state, dt / 2, k2), k, 0.5, time);
    const std::vector<double> k4 = slope(moved(state, dt, k3), k, 1.0, time);
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += dt / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }

  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (std::vector<double>* squares : {&record.travel, &record.travel_rate, &record.force})
    for (double& each : *squares) each = std::sqrt(each);
  record.body.resize(n);
  record.wheel.resize(n);
  record.imu.resize(channels - 2 * n);
  const auto samples = static_cast<std::size_t>(options.seconds * options.rate);
  const auto first = static_cast<std::size_t>(kLead * rate), half = taps.size() / 2;
  for (std::size_t c = 0; c < channels; ++c) {
    const double offset = options.offset * uniform(random);
    auto& channel = c < n ? record.body[c] : c < 2 * n ? record.wheel[c - n] : record.imu[c - 2 * n];
    const double noise = c > 2 * n ? options.imu->gyro : options.noise;
    for (std::size_t k = 0; k < samples; ++k) {
      double sum = offset + noise * normal(random);
      for (std::size_t i = 0; i < taps.size(); ++i) sum += taps[i] * raw[c][first + k * kSub + i - half];
      channel.push_back(sum);
    }
  }
  for (std::size_t k = 0; options.pull > 0 && k < samples; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < taps.size(); ++i) sum += taps[i] * pull[first + k * kSub + i - half];
    record.pull.push_back(sum);
  }
  return record;
}

/// Vehicles of the battery; none is one of those that the method was found with.
inline Vehicle made(const std::string& kind, unsigned seed) {
  std::mt19937 random(seed * 7919 + 13);
  std::uniform_real_distribution<double> spread(0.85, 1.15);
  const auto about = [&](double value) { return value * spread(random); };
  Vehicle v;
  v.name = kind;
  const auto add = [&](double x, double y, double mass, double frequency, double ratio, double wheel, double hop) {
    // Stiffness for the frequency that the strut has with its share of the body.
    const double w = 2 * kPi * about(frequency), k = mass * w * w, m = about(wheel);
    v.struts.push_back({x, y, 2 * about(ratio) * mass * w, k, m, m * std::pow(2 * kPi * about(hop), 2) - k, 0.02 * m});
  };
  if (kind == "half") {
    v.mass = about(620), v.pitch_inertia = about(900), v.roll_inertia = 0;
    const double f = about(1.15), r = about(1.45);
    add(f, 0, 330, 1.2, 0.3, 38, 11);
    add(-r, 0, 290, 1.4, 0.28, 36, 12);
    v.speed = 14, v.roughness = 16e-6, v.horizon = 0.3;
  } else if (kind == "sedan") {
    v.mass = about(1250), v.pitch_inertia = about(1900), v.roll_inertia = about(450);
    const double f = about(1.15), r = about(1.45), t = about(0.72);
    for (const double side : {t, -t}) add(f, side, 330, 1.2, 0.3, 38, 11);
    for (const double side : {t, -t}) add(-r, side, 290, 1.4, 0.28, 36, 12);
    v.speed = 14, v.roughness = 16e-6, v.horizon = 0.3;
  } else if (kind == "robot") {
    v.mass = about(22), v.pitch_inertia = about(0.8), v.roll_inertia = about(0.35);
    const double f = about(0.27), r = about(0.3), t = about(0.22);
    for (const double side : {t, -t}) add(f, side, 6, 2.2, 0.3, 0.9, 13);
    for (const double side : {t, -t}) add(-r, side, 5, 2.4, 0.28, 0.9, 13);
    v.speed = 2.5, v.roughness = 64e-6, v.horizon = 0.2;
  } else {  // truck
    v.mass = about(7200), v.pitch_inertia = about(28000), v.roll_inertia = about(5200);
    const double f = about(2.0), r = about(2.2), t = about(1.0);
    for (const double side : {t, -t}) add(f, side, 1900, 1.3, 0.25, 270, 10);
    for (const double side : {t, -t}) add(-r, side, 1700, 1.6, 0.22, 330, 10);
    v.speed = 14, v.roughness = 32e-6, v.horizon = 0.3;
  }
  return v;
}

}  // namespace vehicle_drive
