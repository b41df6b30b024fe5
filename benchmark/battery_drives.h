#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/record/motion.h"
#include "suspension_health_monitor/internal/simulation/drive_simulator.h"
#include "suspension_health_monitor/internal/simulation/random_stream.h"

namespace suspension_health_monitor {

/// A vehicle on its road, sampled at a rate.
struct BatteryVehicle {
  const char *label, *scenario, *vehicle, *iso_class;
  double speed, rate;  ///< [m/s], [Hz]
};

inline constexpr BatteryVehicle kBatteryVehicles[] = {
    {"paper strut, paper's road, 50 Hz", "paper_clean", "paper", "default", 5.0, 50.0},
    {"paper strut, D, 100 Hz", "iso_road", "paper", "D", 5.0, 100.0},
    {"golden car, C, 100 Hz", "iso_road", "golden_car", "C", 15.0, 100.0},
    {"golden car, D, 50 Hz", "iso_road", "golden_car", "D", 7.0, 50.0},
    {"rover, E, 100 Hz", "iso_road", "rover", "E", 2.0, 100.0},
    {"rover, E, 50 Hz", "iso_road", "rover", "E", 2.0, 50.0},
    {"ugv, D, 100 Hz", "iso_road", "ugv", "D", 6.0, 100.0},
    {"ugv, D, 60 Hz", "iso_road", "ugv", "D", 6.0, 60.0},
};

/// Its wheel shakes up to 42 Hz: sampled at 50 Hz, a part of that is lost to any model.
inline constexpr BatteryVehicle kUndersampled{"golden car, C, 50 Hz", "iso_road", "golden_car", "C", 15.0, 50.0};

/// What no candidate explains: forces that do not come through the strut, and laws of other kinds.
inline constexpr const char* kDisturbances[] = {"sine force", "gusts", "bursts", "stepped spring", "travel times rate"};

/// A drive of the battery: what is hidden in it, and what the search gets to see.
struct BatteryDrive {
  StrutModel truth;
  DriveRecord record;
};

/// Makes drives of 120 s with noise of 0.024 to 0.04 m/s^2 in which every hidden force has 15 % of the linear force's
/// rms, if not told otherwise; shapes lie where the drive can show them. Readings are changed by as much. Everything
/// random comes from `seed`.
class BatteryDriver {
 public:
  /// @param share  of the linear force's rms that a hidden force has.
  BatteryDriver(const BatteryVehicle& vehicle, int seed, double share = 0.15)
      : random_(seed, RandomPurpose::kSprungDelivery), noise_(seed, RandomPurpose::kSprungNoise), share_(share) {
    options_.scenario = vehicle.scenario;
    options_.vehicle = vehicle.vehicle;
    options_.iso_class = vehicle.iso_class;
    options_.speed = vehicle.speed;
    options_.rate = vehicle.rate;
    options_.damping_end_fraction = 1.0;
    options_.noise = 0.0;
    options_.seed = seed;
    DriveSimulator simulator(options_);
    while (const auto sample = simulator.next()) plain_.push_back(*sample);
    for (std::size_t k = 1; k < plain_.size(); ++k)
      jerk_ +=
          std::pow((plain_[k].truth.sprung_acceleration - plain_[k - 1].truth.sprung_acceleration) * vehicle.rate, 2);
    for (const DriveSample& sample : plain_) {
      travel_ += std::pow(sample.truth.travel, 2);
      travel_rate_ += std::pow(sample.truth.travel_rate, 2);
      linear_ += std::pow(sample.truth.sprung_acceleration, 2);
    }
    for (double* square : {&travel_, &travel_rate_, &linear_, &jerk_})
      *square = std::sqrt(*square / static_cast<double>(plain_.size()));
    sensor_noise_ = 0.024 + 0.016 * random_.uniform();
  }

  /// @param hidden  names of the catalogue.
  BatteryDrive drive(const std::vector<std::string>& hidden) {
    std::vector<ActiveMeasurementEffect> readings;
    for (const std::string& name : hidden) {
      const auto& known = measurementEffects();
      const auto reading = std::find_if(known.begin(), known.end(), [&](const auto& r) { return r.name == name; });
      if (reading == known.end())
        options_.hidden.push_back(sized(findEffect(forceEffects(), name)));
      else
        readings.push_back({*reading,
                            {0.15 * (name == "clock_offset"  ? linear_ / jerk_
                                     : name == "scale_error" ? 1.0
                                                             : linear_)}});
    }
    return record(options_.hidden, readings);
  }

  /// @param kind  index into kDisturbances.
  BatteryDrive disturbed(std::size_t kind) {
    options_.hidden.push_back(sized(disturbance(kind)));
    return record({}, {});
  }

 private:
  static constexpr int kFiner = 40;  // samples per sample, for a clock that is late by a part of one

  double between(double low, double high) { return low * std::pow(high / low, random_.uniform()); }

  // Of the shapes named here the part of the range in which the drive can show them; of others the middle half.
  // Frequencies lie about that of the drive: a road of slow waves shows no load on a stiff spring.
  std::vector<double> shapesOf(const ForceEffect& effect) {
    const std::map<std::string, std::pair<double, double>> shown{
        {"p", {2.0, 4.0}},    {"g", {0.5, 1.5}},      {"vs", {0.03, 0.1}}, {"v0", {0.4, 1.2}}, {"x", {0.15, 1.0}},
        {"tau", {0.4, 2.0}},  {"xa", {0.3, 1.0}},     {"xb", {0.5, 1.5}},  {"w", {0.5, 2.0}},  {"f", {0.5, 1.8}},
        {"zeta", {0.1, 0.5}}, {"tc", {110.0, 220.0}}, {"vh", {0.35, 0.7}}};
    const MotionScale scale{travel_, travel_rate_, 1.0 / std::sqrt(stiffness())};
    std::vector<double> shapes;
    for (const ShapeParameter& shape : effect.shapes) {
      const auto known = shape.open_above ? shown.end() : shown.find(shape.name);
      const double quarter = std::pow(shape.max / shape.min, 0.25);
      const auto [low, high] =
          known != shown.end() ? known->second : std::pair{shape.min * quarter, shape.max / quarter};
      const double unit =
          shape.scale == ShapeScale::kFrequency ? travel_rate_ / (2.0 * M_PI * travel_) : scale.unit(shape.scale);
      shapes.push_back(between(low, high) * unit);
    }
    return shapes;
  }

  double stiffness() const { return plain_.front().truth.stiffness_to_mass; }

  // The coefficient that gives 15 % of the linear force along the drive without the effect.
  ActiveEffect sized(const ForceEffect& effect) {
    ActiveEffect active{effect, 0.0, shapesOf(effect)};
    constexpr int steps = 20;
    double square = 0.0, most = 0.0;
    Memory memory;
    for (const DriveSample& sample : plain_) {
      StrutMotion motion{sample.truth.travel, sample.truth.travel_rate, toSeconds(sample.stamp), memory,
                         sample.truth.sprung_acceleration};
      square += std::pow(effect.force(motion, active.shapes.data()), 2);
      if (!effect.memory_rate) continue;
      most = std::max(most, memory.s);
      for (int i = 0; i < steps; ++i) {
        motion.memory = memory;
        const Memory rate = effect.memory_rate(motion, active.shapes.data());
        memory = {memory.s + rate.s / options_.rate / steps, memory.second + rate.second / options_.rate / steps};
      }
    }
    active.coefficient = share_ * linear_ / std::sqrt(square / static_cast<double>(plain_.size()));
    if (effect.name == "warming")  // less damping is more heat: it would run away
      active.coefficient = std::min(active.coefficient, 0.15 * plain_.front().truth.damping_to_mass / most);
    const bool either_sign = effect.name.find("asymmetric") == 0 || effect.name.find("drift") != std::string::npos;
    if (either_sign && random_.uniform() < 0.5) active.coefficient *= -1.0;
    return active;
  }

  ForceEffect disturbance(std::size_t kind) {
    using M = StrutMotion;
    const double bounce = std::sqrt(stiffness()), d = travel_, v = travel_rate_, phase = 6.0 * random_.uniform();
    ForceEffect effect{kDisturbances[kind], "", "m/s^2", "", "", {}};
    if (kind == 0) effect.force = [=](const M& m, const double*) { return std::sin(0.83 * bounce * m.time + phase); };
    if (kind == 1)
      effect.force = [=](const M& m, const double*) {
        double sum = 0.0;
        for (int i = 1; i < 12; ++i) sum += std::sin(0.11 * std::pow(1.37, i) * bounce * m.time + i * i + phase) / i;
        return sum;
      };
    if (kind == 2)
      effect.force = [=](const M& m, const double*) {
        return std::sin(1.3 * bounce * m.time) * std::pow(std::sin(0.05 * bounce * m.time + phase), 8);
      };
    if (kind == 3) effect.force = [=](const M& m, const double*) { return std::sin(3.0 * m.travel / d); };
    if (kind == 4) effect.force = [=](const M& m, const double*) { return m.travel / d * m.travel_rate / v; };
    return effect;
  }

  BatteryDrive record(const std::vector<ActiveEffect>& effects, const std::vector<ActiveMeasurementEffect>& readings) {
    const bool late = !readings.empty() && readings.front().effect.name == "clock_offset";
    const int finer = late ? kFiner : 1;
    SimulationOptions options = options_;
    options.rate *= finer;
    Drive drive;
    DriveSimulator simulator(options);
    std::vector<DriveTruth> truths;
    while (const auto sample = simulator.next()) truths.push_back(sample->truth);
    const auto shift =
        late ? static_cast<std::size_t>(std::lround(readings.front().coefficients[0] * options.rate)) : 0;
    for (std::size_t k = shift, i = 0; k < truths.size(); k += static_cast<std::size_t>(finer), ++i) {
      double sprung = truths[k - shift].sprung_acceleration;
      for (const ActiveMeasurementEffect& reading : readings) {
        if (reading.effect.name == "scale_error") sprung *= 1.0 + reading.coefficients[0];
        if (reading.effect.name == "accelerometer_bias") sprung += reading.coefficients[0];
      }
      drive.samples.push_back({fromSeconds(static_cast<double>(i) / options_.rate),
                               sprung + sensor_noise_ * noise_.gaussian(),
                               truths[k].unsprung_acceleration + sensor_noise_ * noise_.gaussian()});
    }
    return {{plain_.front().truth.damping_to_mass, stiffness(), effects, readings},
            DriveRecord(drive, 1.0 / options_.rate)};
  }

  SimulationOptions options_;
  RandomStream random_, noise_;
  std::vector<DriveSample> plain_;
  double travel_ = 0.0, travel_rate_ = 0.0, linear_ = 0.0, jerk_ = 0.0;  // rms [m], [m/s], [m/s^2], [m/s^3]
  double share_;
  double sensor_noise_;  // [m/s^2]
};

}  // namespace suspension_health_monitor
