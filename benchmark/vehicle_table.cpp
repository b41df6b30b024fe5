// Whole vehicles, simulated by vehicle_drive.h, which shares nothing with the package: the tables of doc/vehicle.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/monitor/vehicle_monitor.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "tables.h"
#include "vehicle_case.h"

namespace {

using namespace suspension_health_monitor;

constexpr std::array kKinds{"half", "sedan", "robot", "truck"};

constexpr double kInterval = 1.96;  // standard deviations either way: 95 %

double percent(double value, double truth) { return 100.0 * (value / truth - 1.0); }

/// What LA has said of one parameter in the second half of a drive.
struct Course {
  std::vector<double> off;  // [%]
  double inside = 0.0;      // of the 95 % intervals

  void add(double value, double stddev, double truth) {
    off.push_back(percent(value, truth));
    inside += std::abs(value - truth) < kInterval * stddev ? 1.0 : 0.0;
  }
  double medianOff() const { return off.empty() ? std::nan("") : std::abs(median(off)); }
};

void printLinear(const char* kind, unsigned seed, const Setup& how) {
  Driven driven = prepared(kind, seed, how);
  drive(driven);
  const std::vector<VehicleDrive> drives{driven.asMeasured()};
  const Stamp half = fromSeconds(0.5 * driven.options.seconds);
  std::vector<std::array<Course, 2>> courses(driven.size());
  const VehicleIdentification found =
      identifyVehicle(drives, driven.names, {}, [&](std::size_t i, const MonitorReport& report) {
        if (!report.estimate.valid() || report.stamp < half) return;
        courses[i][0].add(report.estimate.damping_to_mass, report.estimate.damping_to_mass_stddev,
                          driven.vehicle.b1(i));
        courses[i][1].add(report.estimate.stiffness_to_mass, report.estimate.stiffness_to_mass_stddev,
                          driven.vehicle.b0(i));
      });
  if (!found) {
    std::printf("%-6s %3u   the drives %s\n", kind, seed, found.coupling.reason.c_str());
    return;
  }
  const VehicleDiagnosis diagnosis = diagnoseVehicle(drives, driven.names);
  double most[2] = {0.0, 0.0}, inside = 0.0, count = 0.0, floor = 0.0;
  int whole = 0;  // parameters that the interval of the estimate holds
  for (std::size_t i = 0; i < driven.size(); ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      most[j] = std::max(most[j], courses[i][j].medianOff());
      inside += courses[i][j].inside;
      count += static_cast<double>(courses[i][j].off.size());
    }
    const StrutEstimate& whole_drive = found.struts[i].estimate;
    whole +=
        std::abs(whole_drive.damping_to_mass - driven.vehicle.b1(i)) < kInterval * whole_drive.damping_to_mass_stddev
            ? 1
            : 0;
    whole += std::abs(whole_drive.stiffness_to_mass - driven.vehicle.b0(i)) <
                     kInterval * whole_drive.stiffness_to_mass_stddev
                 ? 1
                 : 0;
    floor = std::max(floor, diagnosis.struts[i].base.held_out_rmse / diagnosis.struts[i].noise_floor);
  }
  std::printf("%-6s %3u  %8.2f  %8.2f  %6.0f   %d of %zu  %8.3f   %s\n", kind, seed, most[0], most[1],
              100.0 * inside / count, whole, 2 * driven.size(), floor, diagnosis.summary.c_str());
}

void printTwo(const char* kind, unsigned seed, const Setup& how) {
  Driven driven = prepared(kind, seed, how);
  drive(driven);
  const std::size_t first = placeOf(seed, driven.size()), second = (first + 1) % driven.size();
  const Hidden &one = lawOf(seed), &other = lawOf(seed + 2);
  hide(driven, one, first);
  hide(driven, other, second);
  drive(driven);
  const VehicleDiagnosis found = diagnoseVehicle({driven.asMeasured()}, driven.names);
  std::printf("%-6s %3u  %-18s in %-7s %-18s in %-7s  %s\n", kind, seed, one.name, driven.names[first].c_str(),
              other.name, driven.names[second].c_str(), found.summary.c_str());
}

/// @return rms error of the force that a model has for strut `at`, over that of the force which is hidden there, along
/// normal motion of the drive's size [%]; nan for a law with memory, whose force depends on what was before.
double forceError(const Driven& driven, std::size_t at, const StrutModel& model) {
  for (const ActiveEffect& active : model.effects)
    if (active.effect.memory_rate) return std::nan("");
  const double mobility = driven.vehicle.mobility(at, at);
  const std::vector<Memory> memory(model.effects.size());
  double error = 0.0, size = 0.0;
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const double travel = driven.record.travel[at] * normal(random),
                 rate = driven.record.travel_rate[at] * normal(random);
    const double hidden = mobility * driven.options.hidden[at](travel, rate, 0.0);
    const double truth = driven.vehicle.b1(at) * rate + driven.vehicle.b0(at) * travel + hidden;
    error += std::pow(model.force(travel, rate, 0.0, memory.data()) - truth, 2);
    size += hidden * hidden;
  }
  return 100.0 * std::sqrt(error / size);
}

void printEffect(const char* kind, unsigned seed, const Setup& how) {
  Driven driven = prepared(kind, seed, how);
  drive(driven);
  const Hidden& law = lawOf(seed);
  const std::size_t at = placeOf(seed, driven.size());
  hide(driven, law, at);
  drive(driven);
  const VehicleDiagnosis found = diagnoseVehicle({driven.asMeasured()}, driven.names);
  std::printf("%-6s %3u  %-18s in %-7s  %7.1f  %s\n", kind, seed, law.name, driven.names[at].c_str(),
              found ? forceError(driven, at, found.struts[at].model()) : std::nan(""), found.summary.c_str());
}

// @return largest error of LA in any strut, of b1 and b0 alike [%].
double worstError(const Driven& driven, const VehicleIdentification& found) {
  double worst = found ? 0.0 : std::nan("");
  for (std::size_t i = 0; i < found.struts.size(); ++i) {
    worst = std::max(worst, std::abs(percent(found.struts[i].estimate.damping_to_mass, driven.vehicle.b1(i))));
    worst = std::max(worst, std::abs(percent(found.struts[i].estimate.stiffness_to_mass, driven.vehicle.b0(i))));
  }
  return worst;
}

// A force behind the rear axle and to one side, with nothing hidden behind it and then one law.
void printForce(const char* kind, unsigned seed, const Setup& how) {
  Driven driven = prepared(kind, seed, how);
  const vehicle_drive::Strut &front = driven.vehicle.struts.front(), &rear = driven.vehicle.struts.back();
  driven.options.pull = 0.1 * driven.vehicle.mass;
  driven.options.pull_x = 1.6 * rear.x;
  driven.options.pull_y = 0.4 * front.y;
  drive(driven);
  const VehicleIdentification known = identifyVehicle({driven.withForce()}, driven.names);
  double off = 0.0;
  for (std::size_t i = 0; i < driven.size(); ++i) {
    const double truth = driven.vehicle.mobility(i, driven.options.pull_x, driven.options.pull_y);
    off = std::max(off, 100.0 * driven.vehicle.mass * std::abs(known.coupling.forces[0].values[i] - truth));
  }
  std::printf("%-6s %3u  %8.2f  %9.1f  %11.2f  %-29s  %s\n", kind, seed, worstError(driven, known),
              worstError(driven, identifyVehicle({driven.asMeasured()}, driven.names)), off, "nothing",
              diagnoseVehicle({driven.withForce()}, driven.names).summary.c_str());
  const std::size_t at = placeOf(seed, driven.size());
  hide(driven, lawOf(seed), at);
  drive(driven);
  std::printf("%44s%-18s in %-7s  %s\n", "", lawOf(seed).name, driven.names[at].c_str(),
              diagnoseVehicle({driven.withForce()}, driven.names).summary.c_str());
}

void printBar(const char* kind, unsigned seed, const Setup& how) {
  Driven driven = prepared(kind, seed, how);
  if (driven.size() < 4) return;
  driven.options.anti_roll = 0.4 * driven.vehicle.struts[0].stiffness;
  drive(driven);
  const VehicleDiagnosis found = diagnoseVehicle({driven.asMeasured()}, driven.names);
  std::printf("%-6s %3u  ", kind, seed);
  for (const AntiRollBarFound& bar : found.coupling.bars) {
    const auto truth = [&](std::size_t i) { return driven.vehicle.mobility(i, i) * driven.options.anti_roll; };
    std::printf("%+6.1f %+6.1f  ", percent(bar.first_stiffness_to_mass, truth(bar.first)),
                percent(bar.second_stiffness_to_mass, truth(bar.second)));
  }
  std::printf("%s\n", found.summary.c_str());
}

// How far the ratios are off, over their standard deviations.
void printCoupling(const char* kind, unsigned seed, const Setup& how) {
  Driven driven = prepared(kind, seed, how);
  drive(driven);
  const VehicleCoupling coupling = separateVehicle({driven.asMeasured()}, driven.names).coupling;
  double squares = 0.0, most = 0.0, count = 0.0;
  for (std::size_t i = 0; coupling && i < driven.size(); ++i)
    for (std::size_t j = 0; j < driven.size(); ++j) {
      if (i == j) continue;
      const double truth = driven.vehicle.mobility(i, j) / driven.vehicle.mobility(j, j);
      const double off = coupling.ratios[i][j] - truth;
      squares += std::pow(off / coupling.stddevs[i][j], 2);
      most = std::max(most, std::abs(off));
      count += 1.0;
    }
  std::printf("%-6s %3u  %9.4f  %11.2f  %9.2f   %s\n", kind, seed, most, squares / count, 100.0 * coupling.model_error,
              coupling.reason.c_str());
}

// Every strut judged by its own two IMUs: nothing is hidden in any.
void printAlone(const char* kind, unsigned seed, const Setup& how) {
  Driven driven = prepared(kind, seed, how);
  drive(driven);
  const StrutDrives struts = driven.asMeasured().struts;
  for (std::size_t i = 0; i < driven.size(); ++i) {
    const Diagnosis found = diagnose({struts[i]});
    std::printf("%-6s %3u  %zu  structured %.2f explained %.2f rmse/floor %.1f  %s\n", kind, seed, i,
                found.structured_share, found.explained_share, found.base.held_out_rmse / found.noise_floor,
                found ? found.summary.c_str() : found.reason.c_str());
  }
}

/// What a monitor said of one strut.
struct Said {
  double reports = 0.0, ok = 0.0, valid = 0.0, inside = 0.0;
  double warn = -1.0, error = -1.0;  // first [s]; below 0: never
};

void printHealth(const char* kind, unsigned seed, const Setup& how) {
  constexpr double kLoss = 300.0;
  Driven driven = prepared(kind, seed, how);
  const std::size_t at = seed % driven.size(), n = driven.size();
  driven.options.seconds = 2.0 * kLoss;
  driven.options.hidden.resize(n);
  driven.options.hidden[at] = [c = driven.vehicle.struts[at].damping](double, double v, double t) {
    return t > kLoss ? -0.4 * c * v : 0.0;
  };
  drive(driven);
  MonitorSettings settings;
  settings.sample_period = driven.period();
  std::vector<Said> said(n);
  const auto hear = [&](std::size_t i, const MonitorReport& report) {
    Said& its = said[i];
    const double now = toSeconds(report.stamp);
    its.reports += 1.0;
    if (report.health.level == HealthLevel::kOk) its.ok += 1.0;
    if (report.health.level == HealthLevel::kWarn && its.warn < 0.0) its.warn = now;
    if (report.health.level == HealthLevel::kError && its.error < 0.0) its.error = now;
    if (!report.estimate.valid() || (i == at && now > kLoss)) return;
    its.valid += 1.0;
    const double off = report.estimate.damping_to_mass - driven.vehicle.b1(i);
    its.inside += std::abs(off) < kInterval * report.estimate.dampingAbsoluteStddev() ? 1.0 : 0.0;
  };
  const VehicleDrive drive = driven.asMeasured();
  VehicleMonitor monitor(std::vector<MonitorSettings>(n, settings), hear);
  double known = -1.0;
  for (std::size_t k = 0; k < drive.struts.front().samples.size(); ++k) {
    monitor.addSample(sampleOf(drive, k));
    monitor.fitBodyIfDue();
    if (known < 0.0 && monitor.isCoupled()) known = static_cast<double>(k) * driven.period();
  }
  double least_ok = 1.0, inside = 0.0;
  int alarms = 0;
  for (std::size_t i = 0; i < n; ++i) {
    inside += said[i].inside / said[i].valid / static_cast<double>(n);
    if (i == at) continue;
    least_ok = std::min(least_ok, said[i].ok / said[i].reports);
    alarms += (said[i].warn >= 0.0 ? 1 : 0) + (said[i].error >= 0.0 ? 1 : 0);
  }
  std::printf("%-6s %3u  %6.0f  %8.1f  %8.1f  %9.1f  %7d  %6.0f\n", kind, seed, known,
              said[at].error < 0.0 ? said[at].error : said[at].error - kLoss,
              said[at].warn < 0.0 ? said[at].warn : said[at].warn - kLoss, 100.0 * least_ok, alarms, 100.0 * inside);
}

/// What a drive with one damaged strut has shown, added up.
struct Damages {
  double drives = 0.0, right = 0.0, off = 0.0, inside = 0.0;
};

/// A healthy drive makes the baseline; the next one has one damper or spring weaker by 15 to 60 %, another load, speed
/// and road; the comparison knows none of these.
void printDamage(const char* kind, unsigned seed, const Setup& how) {
  static Damages all;
  Driven driven = prepared(kind, seed, how);
  if (driven.size() != kNumCorners) return;
  const auto corners = [&] {
    drive(driven);
    const VehicleDrive drive = driven.asMeasured();
    MonitorSettings settings;
    settings.sample_period = driven.period();
    VehicleMonitor monitor(std::vector<MonitorSettings>(kNumCorners, settings), [](auto&&...) {});
    for (std::size_t k = 0; k < drive.struts.front().samples.size(); ++k) monitor.addSample(sampleOf(drive, k));
    monitor.fitBody();
    std::array<StrutEstimate, kNumCorners> estimates;
    for (std::size_t i = 0; i < kNumCorners; ++i) estimates[i] = monitor.overTheDrive(i);
    return estimates;
  };
  const auto healthy = corners();
  std::mt19937 random(seed * 31 + 5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double size = between(0.15, 0.6), load = between(0.9, 1.3);
  const std::size_t at = random() % kNumCorners;
  const bool in_damper = random() % 2 == 0;
  vehicle_drive::Vehicle& vehicle = driven.vehicle;
  (in_damper ? vehicle.struts[at].damping : vehicle.struts[at].stiffness) *= 1.0 - size;
  vehicle.mass *= load, vehicle.pitch_inertia *= load * between(0.95, 1.05);
  vehicle.roll_inertia *= load * between(0.95, 1.05);
  const double ahead = between(-0.05, 0.05) * vehicle.struts[0].x, aside = between(-0.05, 0.05) * vehicle.struts[0].y;
  for (vehicle_drive::Strut& strut : vehicle.struts) strut.x += ahead, strut.y += aside;
  vehicle.speed *= between(0.7, 1.4), vehicle.roughness *= std::pow(4.0, between(-0.5, 1.0));
  driven.options.seed += 1000;
  const auto damaged = corners();
  std::array<CornerState, kNumCorners> states;
  for (std::size_t i = 0; i < kNumCorners; ++i) states[i] = {damaged[i], baselineOf(healthy[i], {})};
  const CornerComparisonReport report = compareCorners(states);
  const bool is_right = report.damages.size() == 1 && report.damages[0].corner == at &&
                        report.verdicts[at] == (in_damper ? CornerVerdict::kDamper : CornerVerdict::kSpring);
  all.drives += 1.0;
  std::printf("%-6s %3u  %-7s of %zu  %5.1f  ", kind, seed, in_damper ? "damper" : "spring", at, 100.0 * size);
  if (is_right) {
    const CornerDamage& found = report.damages[0];
    all.right += 1.0, all.off += 100.0 * std::abs(found.change + size);
    all.inside += std::abs(std::log((1.0 + found.change) / (1.0 - size))) < kInterval * found.stddev ? 1.0 : 0.0;
    std::printf("%5.1f", -100.0 * found.change);
  } else {
    std::printf("%s", describe(report).c_str());
  }
  std::printf("   | right %.1f %%, off by %.2f (mean), inside %.1f %%\n", 100.0 * all.right / all.drives,
              all.off / all.right, 100.0 * all.inside / all.right);
}

/// A mode of the table.
struct Table {
  const char* name;
  const char* heading;
  void (*print)(const char* kind, unsigned seed, const Setup& how);
};

constexpr std::array kTables{
    Table{"linear", "kind  seed  b1 off %  b0 off %  inside  iv inside  rmse/floor  verdict", printLinear},
    Table{"coupling", "kind  seed  ratio off  mean square  model error %", printCoupling},
    Table{"effect", "kind  seed  hidden                         error %  verdict", printEffect},
    Table{"two", "kind  seed  hidden                        and                            verdict", printTwo},
    Table{"bar", "kind  seed  stiffness off %  verdict", printBar},
    Table{"force", "kind  seed   known %  unknown %  coeff. off %  hidden                         verdict", printForce},
    Table{"alone", "kind  seed  strut", printAlone},
    Table{"health", "kind  seed  known s   ERROR s    WARN s  others OK  alarms  inside", printHealth},
    Table{"damage", "kind  seed  hidden        size %  found  | so far", printDamage}};

int command(const Arguments& arguments) {
  const auto table =
      std::find_if(kTables.begin(), kTables.end(), [&](const Table& each) { return arguments.word(0) == each.name; });
  if (table == kTables.end()) return 2;
  const unsigned seeds = arguments.seed(1, 2), first = arguments.seed(2);
  Setup how;
  how.has_body_imu = arguments.word(3) == "body";
  how.rate = arguments.number(4, how.rate);
  how.seconds = arguments.number(5, how.seconds);
  std::printf("%s\n", table->heading);
  for (const char* kind : kKinds)
    for (unsigned seed = first; seed < first + seeds; ++seed) {
      table->print(kind, seed, how);
      std::fflush(stdout);
    }
  return 0;
}

const AddTable kAdded(
    "vehicle",
    {"linear|coupling|effect|two|bar|force|alone|health|damage [SEEDS [FIRST [own|body [RATE [SECONDS]]]]]", command});

}  // namespace
