#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "field_monitor.h"

namespace suspension_health_monitor {

/// A drive, how its readings arrive, and how long it lasts.
struct FamilyDrive {
  std::string name;
  FieldDrive field;
  FieldDelivery delivery = {};
  double seconds = 300.0;
  double changes_at = 0.0;  ///< when `field` changes, if it does [s]
};

/// Drives that have one difficulty in common.
struct DriveFamily {
  std::string name;
  bool is_pooled;  ///< it counts in the row of all families
  std::vector<FamilyDrive> drives;
};

/// Indices of kFieldVehicles, by the names that they have in names of drives.
enum FamilyVehicle : std::size_t { kGolden, kSuv, kRover, kUgv };

/// @param road  its class, 'A' to 'E'.
inline double roadOfClass(char road) { return 16e-6 * std::pow(4.0, road - 'A'); }

/// A drive on a road of class `road` at `speed` [m/s], read at `rate` [Hz].
inline FamilyDrive on(char road, double speed, int rate, FamilyVehicle vehicle) {
  FamilyDrive drive;
  drive.field.vehicle = kFieldVehicles[vehicle];
  drive.field.road = roadOfClass(road);
  drive.field.speed = speed;
  drive.field.rate = rate;
  drive.field.offset = 0.2;
  return drive;
}

/// @return class of the road, speed, rate, vehicle.
inline std::string nameOf(const FieldDrive& drive) {
  const auto road = static_cast<char>('A' + std::lround(std::log2(drive.road / roadOfClass('A')) / 2.0));
  return road + std::to_string(std::lround(drive.speed)) + " " + std::to_string(drive.rate) + " Hz " +
         drive.vehicle.name;
}

/// Makes a drive change at a whole second, when FieldSimulator looks whether it is to.
inline void changeAt(FamilyDrive& drive, double seconds) {
  drive.changes_at = seconds;
  drive.field.change_at = seconds - 1e-3;
}

/// @return the drives, each with a seed of its own.
inline std::vector<FamilyDrive> seeded(std::vector<FamilyDrive> drives, unsigned seed) {
  for (FamilyDrive& drive : drives) drive.field.seed = seed++;
  return drives;
}

/// Makes the families of healthy struts. Roads and vehicles take turns over all of their drives.
class HealthyFamilies {
 public:
  explicit HealthyFamilies(unsigned seed) : seed_(seed) {
    addRoads();
    addShaken();
    addSensors();
    addReadings();
  }

  const std::vector<DriveFamily>& families() const { return families_; }

 private:
  using Set = std::function<void(FamilyDrive&)>;

  FamilyDrive next() {
    constexpr std::array kRoads{'A', 'C', 'B', 'E', 'A', 'D', 'C'};
    constexpr std::array kSpeeds{10.0, 15.0, 20.0, 3.0, 30.0, 8.0, 6.0};
    constexpr std::array kRates{200, 200, 500, 100, 250, 100, 400};
    const std::size_t way = count_ % kRoads.size(), vehicle = count_ % kFieldVehicles.size();
    FamilyDrive drive = on(kRoads[way], kSpeeds[way], kRates[way], static_cast<FamilyVehicle>(vehicle));
    drive.field.seed = seed_ + count_++;
    return drive;
  }

  void add(const char* name, const std::vector<Set>& sets, bool is_pooled = true) {
    DriveFamily& family = families_.emplace_back(DriveFamily{name, is_pooled, {}});
    for (const Set& set : sets) {
      FamilyDrive& drive = family.drives.emplace_back(next());
      set(drive);
      drive.name = nameOf(drive.field);
    }
  }

  /// A drive for each value.
  void add(const char* name, const std::vector<double>& values, void (*set)(FamilyDrive&, double)) {
    std::vector<Set> sets;
    for (const double value : values) sets.emplace_back([=](FamilyDrive& drive) { set(drive, value); });
    add(name, sets);
  }

  void addRoads() {
    add("offset 0-0.8, drift 0.3", {0.0, 0.1, 0.2, -0.3, 0.4, -0.5, 0.6, 0.8}, [](FamilyDrive& drive, double offset) {
      drive.field.offset = offset;
      drive.field.offset_swing = 0.3;
    });
    add("plain, payload, potholes", {1.0, 1.0, 1.0, 1.0, 1.0, 0.7, 0.85, 1.15, 1.3, 0.0, 0.0, 0.0, 0.0},
        [](FamilyDrive& drive, double mass) {
          drive.field.potholes = mass == 0.0;
          if (mass > 0.0) drive.field.mass = mass;
        });
    add("stop and go", std::vector<Set>(4, [](FamilyDrive& drive) { drive.field.stops = true; }));
  }

  void addShaken() {
    add("engine 0.5-1.5, stops", {0.5, 0.5, 0.75, 1.0, 1.0, 1.25, 1.5}, [](FamilyDrive& drive, double engine) {
      drive.field.engine = engine;
      drive.field.stops = true;
    });
    add("lines 8-16 Hz, 0.5", {8.0, 12.0, 16.0}, [](FamilyDrive& drive, double frequency) {
      drive.field.engine = 0.5;
      drive.field.idle_from = drive.field.idle_to = frequency;
    });
    add("tilt 2 deg, stops", std::vector<Set>(3, [](FamilyDrive& drive) {
          drive.field.tilt = 2.0 * M_PI / 180.0;
          drive.field.stops = true;
        }));
  }

  void addSensors() {
    add("class A at 3 m/s", {100, 200, 500, 200, 100}, [](FamilyDrive& drive, double rate) {
      drive.field.road = roadOfClass('A');
      drive.field.speed = 3.0;
      drive.field.rate = static_cast<int>(rate);
    });
    add("unfiltered 50-200 Hz", {50, 100, 200, 100, 200, 50, 100, 200}, [](FamilyDrive& drive, double rate) {
      drive.field.anti_aliased = false;
      drive.field.rate = static_cast<int>(rate);
    });
    add("wheel noise 0.3", std::vector<Set>(3, [](FamilyDrive& drive) { drive.field.wheel_noise = 10.0; }));
  }

  void addReadings() {
    add("clock 1-10 ms", {1e-3, 2e-3, 4e-3, 7e-3, 10e-3},
        [](FamilyDrive& drive, double late) { drive.delivery.late = late; });
    const Set jitter = [](FamilyDrive& drive) { drive.delivery.jitter = 0.5e-3; };
    const Set loss = [](FamilyDrive& drive) { drive.delivery.lost = 0.02; };
    const Set rates = [](FamilyDrive& drive) { drive.field.rate = 200, drive.field.wheel_steps = kFieldRate / 333; };
    add("jitter, loss, 333 Hz", {jitter, loss, rates});
    const Set zeros = [](FamilyDrive& drive) { drive.delivery.zeros = true; };
    const Set spikes = [](FamilyDrive& drive) { drive.delivery.spikes = 1.0 / 4000.0; };
    add("zeros 1 s; spikes 1/4000", {zeros, zeros, spikes, spikes});
    add("spikes 1/350", {[](FamilyDrive& drive) { drive.delivery.spikes = 1.0 / 350.0; }}, false);
    add("load +30, -25 midway", {1.3, 0.75}, [](FamilyDrive& drive, double mass) {
      changeAt(drive, 150.0);
      drive.field.mass_after = mass;
    });
  }

  unsigned seed_;
  unsigned count_ = 0;  // of drives
  std::vector<DriveFamily> families_;
};

/// @return drives of 240 s whose damper or spring is weaker from 120 s on.
inline std::vector<FamilyDrive> stepDrives(unsigned seed) {
  std::vector<FamilyDrive> drives;
  const auto add = [&](const std::string& name, FamilyDrive drive, double damping, double stiffness) -> FieldDrive& {
    changeAt(drive, 120.0);
    drive.name = name;
    drive.seconds = 240.0;
    drive.field.damping_left = damping;
    drive.field.stiffness_left = stiffness;
    return drives.emplace_back(drive).field;
  };
  for (const int percent : {20, 30, 50}) {
    const double left = 1.0 - 0.01 * percent;
    const std::string size = std::to_string(percent);
    add("damp-" + size + "_golden", on('C', 15.0, 200, kGolden), left, 1.0);
    add("stiff-" + size + "_golden", on('C', 15.0, 200, kGolden), 1.0, left);
    add("damp-" + size + "_ugv", on('D', 6.0, 200, kUgv), left, 1.0);
    add("stiff-" + size + "_ugv", on('D', 6.0, 200, kUgv), 1.0, left);
  }
  add("damp-20_pay+30_suv", on('C', 15.0, 200, kSuv), 0.8, 1.0).mass = 1.3;
  add("damp-31_A10_suv", on('A', 10.0, 200, kSuv), 0.69, 1.0);
  add("damp-31_E3_rover", on('E', 3.0, 100, kRover), 0.69, 1.0);
  add("stiff-31_A10_golden", on('A', 10.0, 200, kGolden), 1.0, 0.69);
  add("stiff-31_B20_rover", on('B', 20.0, 500, kRover), 1.0, 0.69);
  add("x_damp-30_noisy_ugv", on('C', 6.0, 200, kUgv), 0.7, 1.0).noise = 0.1;
  add("x_stiff-30_stops_golden", on('C', 15.0, 200, kGolden), 1.0, 0.7).stops = true;
  add("x_damp-31_alias_golden", on('C', 15.0, 200, kGolden), 0.69, 1.0).anti_aliased = false;
  add("x_damp-40_engine_suv", on('B', 15.0, 100, kSuv), 0.6, 1.0).engine = 1.0;
  return seeded(drives, seed);
}

/// @return drives whose damper loses a third between 40 and 100 s, as that of the paper.
inline std::vector<FamilyDrive> rampDrives(unsigned seed) {
  std::vector<FamilyDrive> drives{on('C', 15.0, 200, kGolden), on('A', 20.0, 200, kSuv), on('D', 6.0, 100, kRover),
                                  on('B', 10.0, 500, kUgv)};
  for (FamilyDrive& drive : drives) {
    changeAt(drive, 40.0);
    drive.field.change_over = 60.0;
    drive.field.damping_left = 2.0 / 3.0;
    drive.name = "ramp-33 " + nameOf(drive.field);
    drive.seconds = 200.0;
  }
  return seeded(drives, seed);
}

/// @return drives of 420 s on one road until 120 s, on another from then on, of struts that are not linear.
inline std::vector<FamilyDrive> frictionDrives(unsigned seed) {
  std::vector<FamilyDrive> drives;
  const auto add = [&](const char* name, const char* roads, FamilyVehicle vehicle, double FieldDrive::*law,
                       double value, double damping_left = 1.0) {
    FamilyDrive& drive = drives.emplace_back(on(roads[0], 15.0, 200, vehicle));
    changeAt(drive, 120.0);
    drive.name = name;
    drive.seconds = 420.0;
    drive.field.road_after = roadOfClass(roads[1]);
    drive.field.*law = value;
    drive.field.damping_left = damping_left;
  };
  add("fric0.05_AC_golden", "AC", kGolden, &FieldDrive::friction, 0.05);
  add("fric0.1_AC_suv", "AC", kSuv, &FieldDrive::friction, 0.1);
  add("fric0.1_AC_ugv", "AC", kUgv, &FieldDrive::friction, 0.1);
  add("fric0.2_AC_rover", "AC", kRover, &FieldDrive::friction, 0.2);
  add("fric0.2_AC_golden", "AC", kGolden, &FieldDrive::friction, 0.2);
  add("fric0.1_CA_golden", "CA", kGolden, &FieldDrive::friction, 0.1);
  add("fric0.2_CA_suv", "CA", kSuv, &FieldDrive::friction, 0.2);
  add("fric0.1_AC_worn_golden", "AC", kGolden, &FieldDrive::friction, 0.1, 0.6);
  add("fric0.1_CA_worn_suv", "CA", kSuv, &FieldDrive::friction, 0.1, 0.6);
  add("fricx_dig0.8_AC_golden", "AC", kGolden, &FieldDrive::digressive, 0.8);
  add("fricx_dig0.8_CA_golden", "CA", kGolden, &FieldDrive::digressive, 0.8);
  add("fricx_dig0.3_AC_suv", "AC", kSuv, &FieldDrive::digressive, 0.3);
  add("fricx_dig0.3_CA_suv", "CA", kSuv, &FieldDrive::digressive, 0.3);
  add("fricx_asym_AC_golden", "AC", kGolden, &FieldDrive::asymmetry, 0.3);
  add("fricx_0.4_AC_suv", "AC", kSuv, &FieldDrive::friction, 0.4);
  add("fricx_0.4_CA_ugv", "CA", kUgv, &FieldDrive::friction, 0.4);
  return seeded(drives, seed);
}

}  // namespace suspension_health_monitor
