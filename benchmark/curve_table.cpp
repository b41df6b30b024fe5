// Prints the table of curves of doc/comparison.md: how much of the true laws of damper and spring the bands of 90 %
// hold, how wide they are at half of the rms motion, and how far the curves reach.
//   tables curve [SEEDS] [SHARE of the linear force's rms that the hidden force has]
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "battery_drives.h"
#include "suspension_health_monitor/internal/fit/curve_fit.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr BatteryVehicle kVehicles[] = {{"paper, D", "iso_road", "paper", "D", 5.0, 0.0},
                                        {"golden car, B", "iso_road", "golden_car", "B", 15.0, 0.0},
                                        {"golden car, C", "iso_road", "golden_car", "C", 15.0, 0.0},
                                        {"rover, D", "iso_road", "rover", "D", 2.0, 0.0},
                                        {"ugv, C", "iso_road", "ugv", "C", 6.0, 0.0}};
constexpr const char* kLaws[] = {"linear",           "digressive_damping", "quadratic_damping", "asymmetric_damping",
                                 "coulomb_friction", "progressive_spring", "asymmetric_spring", "bump_stop",
                                 "rebound_stop"};
constexpr int kPoints = 400;              // of a curve that are judged
constexpr double kNinetyPercent = 1.645;  // standard deviations

/// The curves of one kind, judged.
struct Judged {
  double held = 0.0, points = 0.0;
  int none = 0;
  std::vector<double> width, reach;

  /// @param law  true one.  @param rms  of its variable.
  template <class Law>
  void add(const ForceCurve& curve, const Law& law, double rms) {
    if (curve.at.empty()) return void(++none);
    const double length = curve.at.back() - curve.at.front();
    reach.push_back(0.5 * length / rms);
    for (int i = 0; i < kPoints; ++i) {
      const double x = curve.at.front() + (i + 0.5) / kPoints * length;
      held += std::abs(curve.forceAt(x) - law(x)) <= kNinetyPercent * curve.stddevAt(x);
      points += 1.0;
    }
    for (const double x : {-0.5 * rms, 0.5 * rms})
      if (curve.covers(x)) width.push_back(kNinetyPercent * curve.stddevAt(x) / std::abs(curve.forceAt(x)));
  }

  void print() const {
    std::printf(" %.1f %% | %.1f %% | %.1f | %d |", 100.0 * held / points, 100.0 * median(width), median(reach), none);
  }
};

void judge(const BatteryVehicle& vehicle, const char* law, int seed, double share, std::array<Judged*, 2> damper,
           std::array<Judged*, 2> spring) {
  BatteryDriver driver(vehicle, seed, share);
  const BatteryDrive drive =
      driver.drive(law == std::string("linear") ? std::vector<std::string>{} : std::vector<std::string>{law});
  const Records records{&drive.record};
  const StrutModel& truth = drive.truth;
  const FitOutcome linear = fitOutputError(records, {}, {truth.damping_to_mass, truth.stiffness_to_mass, {}, {}});
  if (!linear) return void(std::printf("%s, %s, seed %d: no linear fit\n", law, vehicle.label, seed));
  const LinearResponse motion(records, *linear);
  const StrutCurves curves = fitCurves(records, linear->model);
  const std::array<Memory, kMostEffects> rest{};
  for (Judged* each : damper)
    each->add(
        curves.damper, [&](double v) { return truth.force(0.0, v, 0.0, rest.data()); }, motion.scale().travel_rate);
  for (Judged* each : spring)
    each->add(
        curves.spring, [&](double d) { return truth.force(d, 0.0, 0.0, rest.data()); }, motion.scale().travel);
}

void printRow(const char* law, const char* vehicle, const Judged& damper, const Judged& spring) {
  std::printf("| %s | %s |", law, vehicle);
  damper.print();
  spring.print();
  std::printf("\n");
  std::fflush(stdout);
}

void printTable(int seeds, double share) {
  std::printf(
      "| law | vehicle | damper: held | half width | to [rms] | none | spring: held | half width | to [rms] | none |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const char* law : kLaws) {
    Judged damper, spring;
    for (BatteryVehicle vehicle : kVehicles)
      for (const double rate : {100.0, 200.0}) {
        vehicle.rate = rate;
        Judged its_damper, its_spring;
        for (int seed = 1; seed <= seeds; ++seed)
          judge(vehicle, law, seed, share, {&damper, &its_damper}, {&spring, &its_spring});
        printRow(law, (vehicle.label + std::string(rate > 150.0 ? ", 200 Hz" : ", 100 Hz")).c_str(), its_damper,
                 its_spring);
      }
    printRow(law, "all", damper, spring);
  }
}

int command(const Arguments& arguments) { return printTable(arguments.count(0, 20), arguments.number(1, 0.15)), 0; }

const AddTable kAdded("curve", {"[SEEDS [SHARE]]", command});

}  // namespace
}  // namespace suspension_health_monitor
