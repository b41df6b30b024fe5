// Prints the tables of doc/effect_search.md: how often the search names what is hidden in simulated drives.
//   tables effect_battery [SEEDS [FIRST_SEED [KIND [VEHICLE [EFFECT]]]]]
// KIND: single, none, two, elsewhere, undersampled or all; EFFECT: what is hidden in single drives
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>

#include "battery_drives.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/search/effect_search.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

constexpr std::size_t kLargestGroup = 3;

enum class Outcome { kNamed, kGrouped, kSuspect, kNothing, kUnexplained, kWrongSuspect, kWrong };
constexpr const char* kOutcomes[] = {"named",       "in a group",    "suspect",   "nothing missing",
                                     "unexplained", "wrong suspect", "wrong name"};

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string join(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " + ") + name;
  return text;
}

/// Named: every hidden name and no other is selected. In a group: some of them only as one of at most three. A suspect
/// is right if it is one of those hidden, alone or in a group.
Outcome judge(const SearchResult& result, const Names& hidden) {
  if (result.verdict == Verdict::kNothingMissing) return Outcome::kNothing;
  if (result.verdict == Verdict::kUnexplained) return Outcome::kUnexplained;
  bool all = true, grouped = true, any = false;
  for (const std::string& name : hidden) {
    const bool selected = contains(result.selected, name);
    all = all && selected;
    bool in_group = false;
    for (const Names& group : result.indistinguishable)
      in_group = in_group || (group.size() <= kLargestGroup && contains(group, name));
    grouped = grouped && (selected || in_group);
    any = any || selected || in_group;
  }
  if (result.verdict == Verdict::kSuspect) return any ? Outcome::kSuspect : Outcome::kWrongSuspect;
  if (result.selected.size() != hidden.size() || !grouped) return Outcome::kWrong;
  return all ? Outcome::kNamed : Outcome::kGrouped;
}

/// What the true model leaves of the held-out samples when it is driven by the measured w'' [m/s^2].
double floorOf(const BatteryDrive& drive) {
  const auto held_out = splitHoldOut({&drive.record}, drive.truth.stiffness_to_mass);
  std::vector<std::vector<double>> residuals;
  for (const DriveSegment& segment : drive.record.segments()) {
    residuals.emplace_back();
    if (!runFree(drive.truth, segment, {}, residuals.back())) return std::nan("");
    for (std::size_t k = 0; k < segment.size(); ++k) residuals.back()[k] = segment.sprung[k] - residuals.back()[k];
  }
  return held_out->rmse(residuals);
}

struct Tally {
  std::map<Outcome, int> outcomes;
  std::vector<double> coefficient_errors, floor_ratios, seconds;
  int drives = 0;

  void add(const Tally& other) {
    for (const auto& [outcome, count] : other.outcomes) outcomes[outcome] += count;
    coefficient_errors.insert(coefficient_errors.end(), other.coefficient_errors.begin(),
                              other.coefficient_errors.end());
    floor_ratios.insert(floor_ratios.end(), other.floor_ratios.begin(), other.floor_ratios.end());
    seconds.insert(seconds.end(), other.seconds.begin(), other.seconds.end());
    drives += other.drives;
  }
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * (static_cast<double>(values.size()) - 1.0))];
}

void noteAccuracy(const SearchResult& result, const BatteryDrive& drive, double floor, Tally& tally) {
  if (!result.extended) return;
  tally.floor_ratios.push_back(result.extended->held_out_rmse / floor);
  for (const ActiveEffect& found : result.final_fit->model.effects)
    for (const ActiveEffect& hidden : drive.truth.effects)
      if (found.effect.name == hidden.effect.name)
        tally.coefficient_errors.push_back(std::abs(found.coefficient / hidden.coefficient - 1.0));
}

Tally searchIn(const std::string& label, const BatteryDrive& drive, const Names& hidden, bool explainable) {
  Tally tally;
  ++tally.drives;
  StrutModel start = drive.truth;  // as rough as least squares would be
  start.damping_to_mass *= 1.1;
  start.stiffness_to_mass *= 0.95;
  start.effects.clear();
  start.reading.clear();
  const std::clock_t before = std::clock();
  const auto result = searchEffects({&drive.record}, start);
  tally.seconds.push_back(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
  const Outcome outcome = judge(result, hidden);  // a disturbance has no name, so that a name is a wrong one
  ++tally.outcomes[outcome];
  const double floor = floorOf(drive);
  if (explainable && outcome == Outcome::kNamed) noteAccuracy(result, drive, floor, tally);
  std::string groups;
  for (const Names& group : result.indistinguishable) groups += " {" + join(group) + "}";
  std::printf("  %-34s %-46s %-15s base %.4f found %.4f truth %.4f noise %.4f %4.1f s: %s%s\n", label.c_str(),
              join(hidden).c_str(), kOutcomes[static_cast<int>(outcome)], result.base.held_out_rmse,
              result.extended ? result.extended->held_out_rmse : result.base.held_out_rmse, floor, result.noise_floor,
              tally.seconds.back(), join(result.selected).c_str(), groups.c_str());
  std::fflush(stdout);
  return tally;
}

void print(const char* title, const Tally& tally) {
  std::printf("%-16s %4d drives:", title, tally.drives);
  for (std::size_t i = 0; i < std::size(kOutcomes); ++i) {
    const auto found = tally.outcomes.find(static_cast<Outcome>(i));
    std::printf(" %s %d,", kOutcomes[i], found == tally.outcomes.end() ? 0 : found->second);
  }
  std::printf(
      " coefficient error median %.2f %% (90 %%: %.1f %%), rmse / truth median %.3f (95 %%: %.3f, worst %.3f), "
      "processor time median %.1f s, worst %.1f s\n",
      100.0 * quantile(tally.coefficient_errors, 0.5), 100.0 * quantile(tally.coefficient_errors, 0.9),
      quantile(tally.floor_ratios, 0.5), quantile(tally.floor_ratios, 0.95), quantile(tally.floor_ratios, 1.0),
      quantile(tally.seconds, 0.5), quantile(tally.seconds, 1.0));
}

Tally runKind(const std::string& kind, const BatteryVehicle& vehicle, int seed, const std::string& wanted) {
  Tally tally;
  const auto hide = [&](const Names& hidden) {
    if (join(hidden).find(wanted) == std::string::npos) return;
    BatteryDriver driver(vehicle, seed);
    tally.add(searchIn(vehicle.label, driver.drive(hidden), hidden, true));
  };
  const std::vector<ForceEffect>& effects = forceEffects();
  if (kind == "single") {
    for (const ForceEffect& effect : effects) hide({effect.name});
    for (const MeasurementEffect& effect : measurementEffects())
      if (effect.channels.empty()) hide({effect.name});  // these drives have no other axes
  } else if (kind == "none") {
    hide({});
  } else if (kind == "two") {
    RandomStream random(seed, RandomPurpose::kUnsprungDelivery);
    const auto pick = [&] { return static_cast<std::size_t>(random.uniform() * static_cast<double>(effects.size())); };
    const std::size_t first = pick();
    std::size_t second = pick();
    while (second == first) second = pick();
    hide({effects[first].name, effects[second].name});
  } else {
    for (std::size_t i = 0; i < std::size(kDisturbances); ++i) {
      BatteryDriver driver(vehicle, seed);
      tally.add(searchIn(vehicle.label, driver.disturbed(i), {kDisturbances[i]}, false));
    }
  }
  return tally;
}

int command(const Arguments& arguments) {
  const int seeds = arguments.count(0, 1), first = arguments.count(1, 1);
  const std::string wanted = arguments.word(2, "all"), vehicle_part = arguments.word(3),
                    effect_part = arguments.word(4);
  for (const char* kind : {"single", "none", "two", "elsewhere", "undersampled"}) {
    if (wanted != "all" && wanted != kind) continue;
    Tally tally;
    for (int seed = first; seed < first + seeds; ++seed) {
      if (kind == std::string("undersampled")) {
        tally.add(runKind("single", kUndersampled, seed, effect_part));
        continue;
      }
      for (const BatteryVehicle& vehicle : kBatteryVehicles)
        if (std::string(vehicle.label).find(vehicle_part) != std::string::npos)
          tally.add(runKind(kind, vehicle, seed, effect_part));
    }
    print(kind, tally);
  }
  return 0;
}

const AddTable kAdded("effect_battery", {"[SEEDS [FIRST_SEED [KIND [VEHICLE [EFFECT]]]]]", command});

}  // namespace
}  // namespace suspension_health_monitor
