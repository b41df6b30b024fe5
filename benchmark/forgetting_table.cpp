// Prints the tables of doc/defaults.md: how late LS and LA follow the paper's ramp of the damping and a step of it,
// how much they scatter, and what faults do to them, against the forgetting factors.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "../test/core/simulated_drive.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr int kFirstSeed = 101, kNumSeeds = 30;

struct Point {
  double time;
  double b1_change;     // of the strut [1/s]
  double b1[2], b0[2];  // errors of LS, LA
};

std::vector<Point> follow(const std::vector<DriveSample>& drive, double forgetting_factor) {
  MonitorSettings options;
  options.sample_period = 0.02;
  options.forgetting_factor = forgetting_factor;
  SuspensionMonitor monitor(options);
  std::vector<Point> points;
  for (const DriveSample& sample : drive) {
    const MonitorReport* report =
        monitor.addSample({sample.stamp, sample.sprung->acceleration, sample.unsprung->acceleration});
    if (report == nullptr || !report->has_row) continue;
    Point point{toSeconds(sample.stamp), sample.truth.damping_to_mass - drive.front().truth.damping_to_mass, {}, {}};
    for (const int i : {0, 1}) {
      const StrutEstimate& estimate = i == 0 ? report->ls : report->la;
      point.b1[i] = estimate.damping_to_mass - sample.truth.damping_to_mass;
      point.b0[i] = estimate.stiffness_to_mass - sample.truth.stiffness_to_mass;
    }
    points.push_back(point);
  }
  return points;
}

std::vector<DriveSample> driven(SimulationOptions options, int seed) {
  options.seed = seed;
  return drive(options);
}

SimulationOptions stepDrive() {
  SimulationOptions options;
  options.damping_end_fraction = 0.8;
  options.ramp_start = 40.0;
  options.ramp_end = 40.02;
  options.duration = 80.0;
  return options;
}

using Errors = double (Point::*)[2];

double rms(const std::vector<Point>& points, double from, double to, Errors errors, int estimator) {
  double sum = 0.0, count = 0.0;
  for (const Point& point : points) {
    if (point.time <= from || point.time > to) continue;
    sum += std::pow((point.*errors)[estimator], 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

double lagOnRamp(const std::vector<Point>& points, int estimator) {
  double sum = 0.0, count = 0.0;
  for (const Point& point : points) {
    if (point.time < 55.0 || point.time > 100.0) continue;
    sum += point.b1[estimator];
    ++count;
  }
  return sum / count * 60.0;  // the ramp falls by 1/60 1/s per s
}

// Until 15 of the 20 % have been seen.
double timeToSee(const std::vector<Point>& points, int estimator) {
  for (const Point& point : points)
    if (point.time > 40.0 && point.b1[estimator] + point.b1_change < -0.15 * 3.0) return point.time - 40.0;
  return 40.0;
}

struct Drives {
  std::vector<std::vector<DriveSample>> ramp, step, loss, stops;
};

Drives simulateAll() {
  Drives drives;
  SimulationOptions loss, stops;
  loss.scenario = "paper_outliers";
  stops.scenario = "paper_saturation";
  for (int seed = kFirstSeed; seed < kFirstSeed + kNumSeeds; ++seed) {
    drives.ramp.push_back(driven({}, seed));
    drives.step.push_back(driven(stepDrive(), seed));
    drives.loss.push_back(driven(loss, seed));
    drives.stops.push_back(driven(stops, seed));
  }
  return drives;
}

// One row for LS, one for LA.
std::vector<std::string> rowsOf(double forgetting_factor, const Drives& drives) {
  std::vector<double> lag[2], scatter1[2], scatter0[2], step[2], loss1[2], loss0[2], stops1[2], stops0[2];
  for (std::size_t k = 0; k < drives.ramp.size(); ++k) {
    const auto ramp = follow(drives.ramp[k], forgetting_factor), stepped = follow(drives.step[k], forgetting_factor);
    const auto lost = follow(drives.loss[k], forgetting_factor), stopped = follow(drives.stops[k], forgetting_factor);
    for (const int i : {0, 1}) {
      lag[i].push_back(lagOnRamp(ramp, i));
      scatter1[i].push_back(rms(ramp, 10.0, 40.0, &Point::b1, i));
      scatter0[i].push_back(rms(ramp, 10.0, 40.0, &Point::b0, i));
      step[i].push_back(timeToSee(stepped, i));
      loss1[i].push_back(rms(lost, 10.0, 120.0, &Point::b1, i));
      loss0[i].push_back(rms(lost, 10.0, 120.0, &Point::b0, i));
      stops1[i].push_back(rms(stopped, 10.0, 120.0, &Point::b1, i));
      stops0[i].push_back(rms(stopped, 10.0, 120.0, &Point::b0, i));
    }
  }
  std::vector<std::string> rows;
  for (const int i : {0, 1}) {
    char row[256];
    std::snprintf(row, sizeof row, "| %s, %g | %.1f | %.1f | %.3f, %.3f | %.3f, %.3f | %.3f, %.3f |",
                  i == 0 ? "LS" : "LA", forgetting_factor, medianOf(lag[i]), medianOf(step[i]), medianOf(scatter1[i]),
                  medianOf(scatter0[i]), medianOf(loss1[i]), medianOf(loss0[i]), medianOf(stops1[i]),
                  medianOf(stops0[i]));
    rows.push_back(row);
  }
  return rows;
}

void printTable() {
  std::printf(
      "| estimator, lambda | lag on the ramp [s] | -15 %% of a step of -20 %% seen after [s] | rms while nothing "
      "changes | data loss | end stops |\n|---|---|---|---|---|---|\n");
  const Drives drives = simulateAll();
  std::vector<std::string> of_la;
  for (const double forgetting_factor : {0.97, 0.98, 0.985, 0.99, 0.995}) {
    const std::vector<std::string> rows = rowsOf(forgetting_factor, drives);
    std::printf("%s\n", rows[0].c_str());
    std::fflush(stdout);
    of_la.push_back(rows[1]);
  }
  for (const std::string& row : of_la) std::printf("%s\n", row.c_str());
}

int command(const Arguments&) { return printTable(), 0; }

const AddTable kAdded("forgetting", {"", command});

}  // namespace
}  // namespace suspension_health_monitor
