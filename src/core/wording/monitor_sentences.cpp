#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/health/baseline.h"
#include "suspension_health_monitor/internal/health/health_rules.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

// What is the matter with the readings, and with estimates that are not valid.

std::string describe(EstimateDoubt doubt) {
  switch (doubt) {
    case EstimateDoubt::kNone: return "valid";
    case EstimateDoubt::kNoRows: return "too few readings since a start or a gap";
    case EstimateDoubt::kWrongPeriod: return "stamps do not fit sample_period";
    case EstimateDoubt::kWrongUnit: return "one of the IMUs reads in g, must be in m/s^2";
    case EstimateDoubt::kFewRows: return "too few samples yet";
    case EstimateDoubt::kNotExcited:
      return "too little motion to know damping and stiffness: drive on, or use a rougher road";
    case EstimateDoubt::kDampingNotExcited: return "too little motion to know damping: drive on, or use a rougher road";
    case EstimateDoubt::kStiffnessNotExcited:
      return "too little motion to know stiffness: drive on, or use a rougher road";
    case EstimateDoubt::kNotExplained:
      return "the strut explains less than half of the body's motion: other struts, other forces, or a sensor";
    case EstimateDoubt::kNotAStrut: return "the estimates are not those of a spring and a damper";
    case EstimateDoubt::kVehicleFile: return "the drives contradict the vehicle file: see what is said of the coupling";
    case EstimateDoubt::kOldData: return "parked: the newest data on the strut are older than health/oldest_data";
    case EstimateDoubt::kDisagrees: return "differs from `estimate`, or `estimate` is not valid";
    case EstimateDoubt::kFreeRunFails:
      return "the model, driven by the wheel, fits the body's motion worse than a constant";
    case EstimateDoubt::kModelError:
      return "the body does not move as a rigid one on linear struts: absolute values are not known to 15 %, changes "
             "are";
  }
  return "unknown";
}

std::string describeShaking(const InputStatus& input) {
  constexpr double kLeastLevel = 0.3;  // [m/s^2]: more than a sensor's noise
  if (!(input.beyond_strut > kMajority && input.beyond_strut_level > kLeastLevel)) return "";
  return formatted(
      "the sprung IMU shakes above the strut's band (%.0f %% of its power, %.2g m/s^2): an engine, or the unsprung IMU "
      "taken for it?",
      100.0 * input.beyond_strut, input.beyond_strut_level);
}

std::string describe(const SensorReport& report) {
  const auto& [sprung, unsprung] = report.mean;
  const auto stuck = [](const char* one, const char* other) {
    return formatted("the %s IMU reads one value while the %s one moves: stuck", one, other);
  };
  switch (report.fault) {
    case SensorFault::kNone: return {};
    case SensorFault::kSprungStuck: return stuck("sprung", "unsprung");
    case SensorFault::kUnsprungStuck: return stuck("unsprung", "sprung");
    case SensorFault::kOtherAxis: {
      const auto onAnother = [](const char* imu, std::string_view up) {
        return up.empty()
                   ? ""
                   : formatted("gravity of the %s IMU is on another axis: give %s_axis: %.2s", imu, imu, up.data());
      };
      return join({onAnother("sprung", report.up[0]), onAnother("unsprung", report.up[1])}, "; ");
    }
    case SensorFault::kInG:
      return formatted("the %s IMU reads about 1 where the other reads gravity: it is in g, must be in m/s^2",
                       std::abs(sprung) < std::abs(unsprung) ? "sprung" : "unsprung");
    case SensorFault::kNegativeDamping:
      return "damping is negative: are the IMUs swapped, is one upside down, or has its axis the wrong sign?";
    case SensorFault::kUnrelated:
      return "both IMUs move, but no strut makes the one of the other: "
             "sensor fault, wrong axis, wrong topic, or the two swapped";
    case SensorFault::kGainsDiffer:
      return formatted(
          "the sprung IMU reads %.3g times what the unsprung one reads of the same slow motion: unit, gain or tilt of "
          "one of them; damping and stiffness take it into account",
          1.0 + report.gain);
  }
  return {};
}

namespace {

// @param roughest  how much quicker the roughest quarter of the last drive is than this road, on average.
std::string describeKnown(double known_to, double enough, double seconds, double roughest) {
  if (!std::isfinite(known_to)) return {};
  const std::string known = "; damping and stiffness are known to " + sizeInPercent(known_to);
  if (!(seconds > 0.0)) return known;
  if (!(seconds < kDay)) return known + ", this road cannot tell them";
  // The time itself is known to a factor of 1.5, so less than that is not worth a word.
  const std::string quicker = roughest > 1.5 ? formatted(" (%.0f s on a road as rough as the roughest quarter so far)",
                                                         std::fmax(1.0, seconds / roughest))
                                             : "";
  return known + formatted(", about %.0f s more on this road to ", std::fmax(1.0, seconds)) + sizeInPercent(enough) +
         quicker;
}

std::string describeDoubt(EstimateDoubt doubt, const std::string& known) {
  const bool is_excitation = doubt == EstimateDoubt::kNotExcited || doubt == EstimateDoubt::kDampingNotExcited ||
                             doubt == EstimateDoubt::kStiffnessNotExcited;
  return describe(doubt) + (is_excitation ? known : "");
}

// @param stddev  of ln(1 + change).
// @return what holds its size 95 times of 100: "28 to 34 %", "2 % below to 4 % above"; empty: not known, or no wider
// than the last digit.
std::string intervalOf(double change, double stddev) {
  const double half = normalQuantile(0.025) * stddev;
  if (!std::isfinite(half)) return {};
  if (half > std::log(10.0)) return "its size is not known";
  const auto percent = [&](double log_change) {
    return std::lround(std::copysign(100.0, change) * std::expm1(log_change));
  };
  const auto [low, high] = std::minmax({percent(std::log1p(change) - half), percent(std::log1p(change) + half)});
  if (low == high) return {};
  if (low >= 0) return formatted("%ld to %ld %%", low, high);
  const bool is_below = change < 0.0;
  return formatted("%ld %% %s to %ld %% %s", -low, is_below ? "above" : "below", high, is_below ? "below" : "above");
}

std::string describeChange(const std::string& parameter, const std::optional<double>& change, double stddev,
                           const std::string& reference) {
  if (!change) return {};
  if (std::lround(100.0 * *change) == 0) return parameter + " at " + reference;
  const std::string interval = intervalOf(*change, stddev);
  return parameter + " " + sideInPercent(*change) + " " + reference + (interval.empty() ? "" : " (" + interval + ")");
}

std::string describeChanges(const HealthReport& report) {
  const std::string reference = report.learned ? "baseline" : "nominal";
  const double payload = report.payload_change.value_or(0.0);
  return join({describeChange("damping", report.damping_change, report.damping_stddev, reference),
               describeChange("stiffness", report.stiffness_change, report.stiffness_stddev, reference),
               std::lround(100.0 * payload) != 0 ? "body mass " + sideInPercent(payload) : ""});
}

std::string describe(LoadDoubt doubt) {
  switch (doubt) {
    case LoadDoubt::kNone: return "";
    case LoadDoubt::kLoadOrDamper: return "payload or damper: cannot tell yet";
    case LoadDoubt::kLoadOrSpring: return "payload or spring: cannot tell yet";
    case LoadDoubt::kLoadOrBoth: return "payload, or damper and spring worn alike: one strut alone cannot tell";
  }
  return "";
}

std::string describeJudgement(const HealthReport& report) {
  const std::string known = describeKnown(report.known_to, report.enough, report.seconds_more, report.roughest);
  if (report.level == HealthLevel::kStale) {
    if (!report.uncertain && report.doubt == EstimateDoubt::kNone)
      return "cannot tell yet: a new level must last for health/confirm_time";
    if (!report.uncertain) return "cannot tell: " + describeDoubt(report.doubt, known);
    if (report.load_doubt != LoadDoubt::kNone) return describe(report.load_doubt);
    if (report.friction_doubt)
      return "cannot tell: dry friction, or a damper that is not linear, makes too much of the difference between this "
             "road and that of the baseline (learn one on such a road)";
    return "cannot tell: estimates too uncertain to prove a change (drive on, or use a rougher road" + known + ")";
  }
  const std::string changes = describeChanges(report);
  if (!changes.empty()) return join({changes, describe(report.load_doubt)}, "; ");
  if (!report.learning) return "estimates valid; no nominal values given to judge them by";
  return "learning the baseline: " + sizeInPercent(*report.learning) + " of the learning time" + known +
         (report.learning_restarted ? " (begun anew: the strut was changing)" : "");
}

std::string describeShared(const HealthReport& report) {
  if (!report.shared_damping_change) return "";
  const double change = *report.shared_damping_change;
  return "all dampers " + sizeInPercent(change) + (change < 0.0 ? " softer: warm?" : " stiffer: cold?");
}

std::string nameOf(std::size_t corner) { return std::string(kCornerNames[corner]); }

std::string describe(const CornerDamage& damage, const CornerComparisonReport& report) {
  const bool is_damper = report.verdicts[damage.corner] == CornerVerdict::kDamper;
  const char* of_axle = report.by_nominal ? "when the baseline was learned" : "no baseline";
  const std::string note = join({intervalOf(damage.change, damage.stddev), damage.partner ? of_axle : ""});
  return nameOf(damage.corner) + (is_damper ? " damping " : " stiffness ") + sideInPercent(damage.change) + " " +
         (damage.partner ? nameOf(*damage.partner) : "the other corners") + (note.empty() ? "" : " (" + note + ")") +
         ": damage";
}

std::string describeLoad(const CornerComparisonReport& report) {
  std::vector<std::string> names;
  for (std::size_t corner = 0; corner < kNumCorners; ++corner)
    if (report.verdicts[corner] == CornerVerdict::kLoad) names.push_back(nameOf(corner));
  return (names.size() == report.numValid() ? "all corners" : join(names)) + " stiffness/mass " +
         sizeInPercent(*report.load) + (*report.load < 0.0 ? " down: payload" : " up: unloaded");
}

}  // namespace

std::string describeDoubt(const StrutEstimate& estimate, double enough) {
  return describeDoubt(estimate.doubt,
                       describeKnown(estimate.knownTo(), enough, estimate.secondsUntil(enough), estimate.roughest));
}

const char* nameOf(HealthLevel level) {
  constexpr std::array kNames{"OK", "WARN", "ERROR", "STALE"};
  static_assert(kNames.size() == static_cast<std::size_t>(HealthLevel::kStale) + 1);
  return kNames[static_cast<std::size_t>(level)];
}

std::string describeSilent(const std::vector<std::string>& topics) {
  return topics.empty() ? "" : join(topics) + (topics.size() == 1 ? " is" : " are") + " silent";
}

std::string describeNoReading(double seconds, const std::vector<std::string>& silent, const std::string& before) {
  const std::string why = silent.empty() ? "" : ", " + describeSilent(silent);
  return formatted("cannot tell: no reading accepted for %.0f s", seconds) + why + "; before: " + before;
}

std::string describe(const HealthReport& report) {
  const bool is_why = report.level == HealthLevel::kStale && report.sensor.fault != SensorFault::kNone;
  return join({(is_why ? "cannot tell: " : "") + describe(report.sensor), is_why ? "" : describeJudgement(report),
               describeShared(report),
               report.early_warning && report.level == HealthLevel::kOk ? "early warning: a change is certain" : "",
               report.outliers ? "outliers or saturation present (residuals have heavy tails)" : ""},
              "; ");
}

std::optional<StrutOfDrive> strutOf(const IdentifyResult& found) {
  const double horizon = found.horizon_samples * found.sample_period;
  if (found.estimate.valid() && found.isSteady()) return StrutOfDrive{found.estimate, "over the whole drive", horizon};
  if (found.now.valid()) return StrutOfDrive{found.now, "at the end of the drive", horizon};
  return std::nullopt;
}

std::string describeChange(const IdentifyResult& found, const Baseline& healthy, const MonitorOptions& options) {
  const std::optional<StrutOfDrive> strut = strutOf(found);
  if (!strut) return "";
  HealthReport report = reportOf(splitChange(changeFrom(healthy, strut->strut), options.payload_range, 0.0));
  report.learned = healthy.learned;
  const std::string changes = describeChanges(report);
  return changes.empty() ? "" : "the strut, " + strut->by + ": " + changes;
}

std::string describeChange(const std::vector<Drive>& drives, const DiagnoseOptions& searched, const Baseline& healthy,
                           const MonitorOptions& options) {
  if (healthy.isEmpty()) return "";
  IdentifyOptions identifying;
  identifying.sample_period = searched.sample_period;
  identifying.horizon_samples = searched.horizon_samples;
  identifying.memory = options.memory;
  return describeChange(identify(drives, identifying), healthy, options);
}

std::string describe(const CornerComparisonReport& report) {
  if (report.numValid() < 3)
    return "cannot tell: " + std::to_string(report.numValid()) + " of 4 corners have a valid estimate, 3 are needed";
  auto parts = mapped(report.damages, [&](const CornerDamage& damage) { return describe(damage, report); });
  if (report.load) parts.push_back(describeLoad(report));
  if (report.dampers)
    parts.push_back("damping of all other corners alike " + sizeInPercent(*report.dampers) +
                    (*report.dampers < 0.0 ? " down: warm or worn dampers" : " up: cold dampers"));
  if (parts.empty() && !report.by_nominal) parts.emplace_back("left and right alike (no baseline)");
  if (parts.empty()) parts.emplace_back(report.missing.empty() ? "all corners alike" : "the other corners alike");
  for (const std::size_t corner : report.missing) parts.push_back("no valid estimate of " + nameOf(corner));
  return join(parts, "; ");
}

}  // namespace suspension_health_monitor
