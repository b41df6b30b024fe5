// Prints what the monitor says of drives of many kinds (drive_families.h), whose readings arrive as two streams on
// their own stamps; default settings.
//   tables family [families|steps|friction|time|all [SEED]]      another SEED: other roads and noise, all else alike
//
// families: healthy struts with nominal values, per kind of drive. Judged: time at another level than STALE, from 20 s
// on. Bias: the median error of the valid estimates of a drive. Estimates are looked at once per second, not in the
// first 20 s, nor in those after the load has changed. WARN, ERROR: how often either was raised.
// steps: damper or spring weaker from 120 s on; ramps: damping -33 % between 40 and 100 s, -15 % at 67, -30 % at 94 s.
// time: the first seconds of a healthy drive predict how many more of driving make the estimate half as uncertain.
// friction: a baseline that is learned in 120 s on one road, then the same strut, or a worn one, on another
// for 300 s.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "drive_families.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr double kSettled = 20.0;  // [s]
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The estimate that is measured.
const StrutEstimate& judged(const MonitorReport& report) { return report.estimate; }

bool isRaised(HealthLevel level) { return level == HealthLevel::kWarn || level == HealthLevel::kError; }

/// Of all looks.
struct Share {
  double looks = 0.0, hits = 0.0;

  void add(bool hit) { looks += 1.0, hits += hit ? 1.0 : 0.0; }
  double percent() const { return 100.0 * hits / looks; }
};

/// Errors of one parameter: relative, of the valid estimates.
struct Errors {
  std::vector<double> relative;
  double inside = 0.0;  // 95 % intervals that hold the truth

  void add(double value, double stddev, double truth) {
    relative.push_back(value / truth - 1.0);
    inside += std::abs(value - truth) < 1.96 * stddev ? 1.0 : 0.0;
  }
};

struct HealthyFound {
  std::array<Errors, 2> errors;  // of b1, b0
  Share judged;
  int alarms = 0;
};

HealthyFound measureHealthy(const FamilyDrive& drive) {
  const FieldDrive& field = drive.field;
  HealthyFound found;
  HealthLevel before = HealthLevel::kStale;
  VehiclePipeline pipeline = pipelineFor(field);
  follow({field, drive.delivery}, drive.seconds, pipeline, [&](double time, const MonitorReport& report) {
    const StrutEstimate& estimate = judged(report);
    const HealthLevel level = report.health.level;
    found.alarms += int{level != before && isRaised(level)};
    before = level;
    if (time < kSettled) return;
    found.judged.add(level != HealthLevel::kStale);
    const double since = time - drive.changes_at;
    const bool settles = since > 0.0 && since < kSettled, is_whole_second = std::abs(std::remainder(time, 1.0)) < 1e-6;
    if (!estimate.valid() || settles || !is_whole_second) return;
    const double mass = field.mass_after > 0.0 && since > 0.0 ? field.mass_after : field.mass;
    found.errors[0].add(estimate.damping_to_mass, estimate.damping_to_mass_stddev, field.vehicle.b1 / mass);
    found.errors[1].add(estimate.stiffness_to_mass, estimate.stiffness_to_mass_stddev, field.vehicle.b0 / mass);
  });
  return found;
}

/// What is known of one parameter over some drives.
struct ParameterErrors {
  double drives = 0.0, bias = 0.0, estimates = 0.0, squares = 0.0, inside = 0.0;  // drives with estimates, and sums
  std::pair<double, std::string> worst;                                           // |bias|, and of which drive

  void add(const std::string& drive, const Errors& errors) {
    if (errors.relative.empty()) return;
    const double off = std::abs(median(errors.relative));
    drives += 1.0;
    bias += off;
    worst = std::max(worst, std::pair(off, drive));
    estimates += static_cast<double>(errors.relative.size());
    for (const double error : errors.relative) squares += square(error);
    inside += errors.inside;
  }
};

/// A row of the table of families: one family's drives, or all.
class FamilyRow {
 public:
  void add(const FamilyDrive& drive, const HealthyFound& found) {
    ++drives_;
    judged_ += found.judged.percent();
    alarms_ += found.alarms;
    for (std::size_t i = 0; i < 2; ++i) errors_[i].add(drive.name, found.errors[i]);
  }

  void print(const std::string& name) const {
    const auto& [b1, b0] = errors_;
    std::printf("| %s | %d | %.0f | ", name.c_str(), drives_, judged_ / drives_);
    if (b1.drives == 0.0) return void(std::printf("- | - | - | %d | - |\n", alarms_));
    std::printf("%.1f, %.1f | %.1f, %.1f | ", 100.0 * b1.bias / b1.drives, 100.0 * b0.bias / b0.drives,
                100.0 * std::sqrt(b1.squares / b1.estimates), 100.0 * std::sqrt(b0.squares / b0.estimates));
    std::printf("%.0f, %.0f | %d | %.1f %s, %.1f %s |\n", 100.0 * b1.inside / b1.estimates,
                100.0 * b0.inside / b0.estimates, alarms_, 100.0 * b1.worst.first, b1.worst.second.c_str(),
                100.0 * b0.worst.first, b0.worst.second.c_str());
  }

 private:
  int drives_ = 0, alarms_ = 0;
  double judged_ = 0.0;
  std::array<ParameterErrors, 2> errors_;
};

void printFamilies(unsigned seed) {
  std::printf(
      "| drives | n | judged %% | mean abs bias b1, b0 %% | rms b1, b0 %% | in 95 %% b1, b0 | WARN+ERROR "
      "| worst abs bias b1, b0 %% |\n|---|---|---|---|---|---|---|---|\n");
  FamilyRow all;
  const HealthyFamilies healthy(seed);
  for (const DriveFamily& family : healthy.families()) {
    FamilyRow row;
    measureEach(family.drives, measureHealthy, [&](const FamilyDrive& drive, const HealthyFound& found) {
      row.add(drive, found);
      if (family.is_pooled) all.add(drive, found);
    });
    row.print(family.name);
  }
  all.print("all but spikes 1/350");
}

struct ChangeFound {
  double raised = kNever, error = kNever;  // first WARN or ERROR, first ERROR, after the change [s]
  int before = 0;                          // WARN and ERROR before it
  Share judged;                            // after it
};

ChangeFound measureChange(const FamilyDrive& drive) {
  ChangeFound found;
  HealthLevel before = HealthLevel::kStale;
  VehiclePipeline pipeline = pipelineFor(drive.field);
  follow({drive.field, drive.delivery}, drive.seconds, pipeline, [&](double time, const MonitorReport& report) {
    const double since = time - drive.changes_at;
    const HealthLevel level = report.health.level;
    const bool alarms = level != before && isRaised(level);
    before = level;
    if (since <= 0.0) return void(found.before += int{alarms});
    found.judged.add(level != HealthLevel::kStale);
    if (isRaised(level)) found.raised = std::min(found.raised, since);
    if (level == HealthLevel::kError) found.error = std::min(found.error, since);
  });
  return found;
}

std::string secondsText(double delay) {
  if (!std::isfinite(delay)) return "-";
  char text[16];
  std::snprintf(text, sizeof text, "%.1f", delay);
  return text;
}

std::string summary(std::vector<double> delays) {
  std::sort(delays.begin(), delays.end());
  const auto found = std::count_if(delays.begin(), delays.end(), [](double delay) { return delay < kNever; });
  return secondsText(median(delays)) + ", " + secondsText(delays.back()) + " (" + std::to_string(found) + " of " +
         std::to_string(delays.size()) + ")";
}

void printChanges(const char* what, const std::vector<FamilyDrive>& drives) {
  std::printf(
      "| %s | first WARN or ERROR after s | first ERROR after s | false before | judged after it %% |\n"
      "|---|---|---|---|---|\n",
      what);
  std::vector<double> raised, error;
  int before = 0;
  double share = 0.0;
  measureEach(drives, measureChange, [&](const FamilyDrive& drive, const ChangeFound& found) {
    std::printf("| %s | %s | %s | %d | %.0f |\n", drive.name.c_str(), secondsText(found.raised).c_str(),
                secondsText(found.error).c_str(), found.before, found.judged.percent());
    raised.push_back(found.raised);
    if (std::min(drive.field.damping_left, drive.field.stiffness_left) < 0.75) error.push_back(found.error);
    before += found.before;
    share += found.judged.percent() / static_cast<double>(drives.size());
  });
  std::printf("| median, worst (found) | %s | %s | %d | %.0f |\n", summary(raised).c_str(), summary(error).c_str(),
              before, share);
}

struct FrictionFound {
  Baseline baseline;
  std::array<Share, 4> levels;                                  // after the change
  std::vector<double> heard_after, raw_change, damping_change;  // of valid estimates; as health judges it
};

FrictionFound measureFriction(const FamilyDrive& drive) {
  FrictionFound found;
  VehiclePipeline pipeline(MonitorOptions{});
  follow({drive.field, drive.delivery}, drive.seconds, pipeline, [&](double time, const MonitorReport& report) {
    if (time <= drive.changes_at) return void(found.baseline = pipeline.baseline());
    for (std::size_t i = 0; i < 4; ++i) found.levels[i].add(i == static_cast<std::size_t>(report.health.level));
    const StrutEstimate& estimate = judged(report);
    if (!estimate.valid() || found.baseline.isEmpty()) return;
    found.raw_change.push_back(estimate.damping_to_mass / *found.baseline.damping_to_mass - 1.0);
    if (estimate.friction) found.heard_after.push_back(estimate.friction->force);
    if (report.health.damping_change) found.damping_change.push_back(*report.health.damping_change);
  });
  return found;
}

void printFriction(unsigned seed) {
  std::printf(
      "| friction, learned baseline | STALE %% | OK %% | WARN %% | ERROR %% | heard before, after [m/s^2] | raw b1 "
      "change %% | damping judged %% |\n|---|---|---|---|---|---|---|---|\n");
  measureEach(frictionDrives(seed), measureFriction, [](const FamilyDrive& drive, const FrictionFound& found) {
    std::printf("| %s |", drive.name.c_str());
    for (const HealthLevel level : {HealthLevel::kStale, HealthLevel::kOk, HealthLevel::kWarn, HealthLevel::kError})
      std::printf(" %.0f |", found.levels[static_cast<std::size_t>(level)].percent());
    if (found.raw_change.empty()) return void(std::printf(" none learned or no estimate | | |\n"));
    std::printf(" %.3f, %.3f | %+.0f | %+.0f |\n", found.baseline.friction.value_or(DryFriction{}).force,
                median(found.heard_after), 100.0 * median(found.raw_change), 100.0 * median(found.damping_change));
  });
}

/// More seconds of driving until the estimate is half as uncertain.
struct Wait {
  double predicted = 0.0, passed = kNever;
};

Wait measureTime(const FamilyDrive& drive) {
  constexpr double kEvery = 2.5, kFirstLook = 30.0, kTarget = 0.5;  // [s]; of what it is known to then
  double wanted = 0.0, asked_at = 0.0, look_at = kFirstLook, driven = 0.0;
  Wait wait;
  VehiclePipeline pipeline = pipelineFor(drive.field);
  follow({drive.field, drive.delivery}, drive.seconds, pipeline, [&](double time, const MonitorReport&) {
    if (time < look_at || std::isfinite(wait.passed)) return;
    look_at += kEvery;
    if (!drive.field.restsAt(time)) driven += kEvery;
    const StrutEstimate estimate = pipeline.overTheDrive();
    const double known_to = estimate.knownTo();
    if (!(known_to > 0.0)) return;
    if (asked_at == 0.0) {
      asked_at = driven, wanted = kTarget * known_to;
      wait.predicted = estimate.secondsUntil(wanted);
    } else if (known_to <= wanted) {
      wait.passed = driven - 0.5 * kEvery - asked_at;
    }
  });
  return wait;
}

void printTime(unsigned seed) {
  std::printf("| drives | n | predicted within a factor of 1.5 [%%] | predicted, passed [s] |\n|---|---|---|---|\n");
  Share all;
  const HealthyFamilies healthy(seed);
  for (const DriveFamily& family : healthy.families()) {
    Share right;
    std::string waits;
    measureEach(family.drives, measureTime, [&](const FamilyDrive&, const Wait& wait) {
      right.add(wait.passed < 1.5 * wait.predicted && wait.passed > wait.predicted / 1.5);
      waits += " " + secondsText(wait.predicted) + ", " + secondsText(wait.passed) + ";";
    });
    std::printf("| %s | %.0f | %.0f |%s |\n", family.name.c_str(), right.looks, right.percent(), waits.c_str());
    all.looks += right.looks, all.hits += right.hits;
  }
  std::printf("| all | %.0f | %.0f | |\n", all.looks, all.percent());
}

int command(const Arguments& arguments) {
  const std::string what = arguments.word(0, "all");
  const unsigned seed = 1 + 1000 * arguments.seed(1, 0);
  const bool all = what == "all";
  if (!all && what != "families" && what != "steps" && what != "friction" && what != "time") return 2;
  if (all || what == "families") printFamilies(seed);
  if (all || what == "steps") printChanges("step", stepDrives(seed + 100));
  if (all || what == "steps") printChanges("ramp", rampDrives(seed + 200));
  if (all || what == "friction") printFriction(seed + 300);
  if (all || what == "time") printTime(seed);
  return 0;
}

const AddTable kAdded("family", {"[families|steps|friction|time|all [SEED]]", command});

}  // namespace
}  // namespace suspension_health_monitor
