#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

#include <cmath>

#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

// More standard deviations than that nobody needs to count.
constexpr long kBeyondDoubt = 10;

std::string describeSignificance(long sigmas) {
  if (sigmas == 0) return {};
  return sigmas > kBeyondDoubt ? " (beyond doubt)" : formatted(" (%ld sigma)", sigmas);
}

std::string describeChange(const std::string& parameter, const std::optional<double>& change, double significance,
                           const std::string& reference) {
  if (!change) return {};
  if (std::lround(100.0 * *change) == 0) return parameter + " at " + reference;
  const std::string text =
      parameter + " " + sizeInPercent(*change) + (*change < 0.0 ? " below " : " above ") + reference;
  return std::isfinite(significance) ? text + describeSignificance(std::lround(significance)) : text;
}

std::string describePayload(double change) {
  if (std::lround(100.0 * change) == 0) return {};
  return "body mass " + sizeInPercent(change) + (change < 0.0 ? " below" : " above");
}

const char* referenceOf(bool learned) { return learned ? "baseline" : "nominal"; }

std::string describeChanges(const HealthReport& report) {
  const std::string reference = referenceOf(report.learned);
  return join({describeChange("damping", report.damping_change, report.damping_significance, reference),
               describeChange("stiffness", report.stiffness_change, report.stiffness_significance, reference),
               describePayload(report.payload_change.value_or(0.0))});
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
  if (report.level == HealthLevel::kStale && report.uncertain && report.load_doubt != LoadDoubt::kNone)
    return describe(report.load_doubt);
  if (report.level == HealthLevel::kStale && report.uncertain)
    return "cannot tell: estimates too uncertain to prove a change (drive on, or on a rougher road)";
  if (report.level == HealthLevel::kStale && report.estimate_valid)
    return "cannot tell yet: a new level must last for health/confirm_time";
  if (report.level == HealthLevel::kStale) return "cannot tell: " + describe(report.doubt);
  const std::string changes = describeChanges(report);
  if (!changes.empty()) return join({changes, describe(report.load_doubt)}, "; ");
  if (!report.learning) return "estimates valid; no nominal values given to judge them by";
  return "learning the baseline: " + sizeInPercent(*report.learning) + " of the learning time" +
         (report.learning_restarted ? " (begun anew: the strut was changing)" : "");
}

std::string nameOf(std::size_t corner) { return std::string(kCornerNames[corner]); }

std::string describe(const CornerDamage& damage, CornerVerdict verdict) {
  return nameOf(damage.corner) + (verdict == CornerVerdict::kDamper ? " damping " : " stiffness ") +
         sizeInPercent(damage.change) + (damage.change < 0.0 ? " below " : " above ") +
         (damage.partner ? nameOf(*damage.partner) + " (no baseline)" : "the other corners") + ": damage";
}

std::string describeLoad(const CornerComparisonReport& report) {
  std::vector<std::string> names;
  for (std::size_t corner = 0; corner < kNumCorners; ++corner)
    if (report.verdicts[corner] == CornerVerdict::kLoad) names.push_back(nameOf(corner));
  return (names.size() == report.numValid() ? "all corners" : join(names)) + " stiffness/mass " +
         sizeInPercent(*report.load) + (*report.load < 0.0 ? " down: payload" : " up: unloaded");
}

}  // namespace

const char* nameOf(HealthLevel level) {
  switch (level) {
    case HealthLevel::kOk: return "OK";
    case HealthLevel::kWarn: return "WARN";
    case HealthLevel::kError: return "ERROR";
    case HealthLevel::kStale: break;
  }
  return "STALE";
}

std::string describeNoReading(double seconds, const std::vector<std::string>& silent, const std::string& before) {
  const std::string why = silent.empty() ? "" : ", " + join(silent) + (silent.size() == 1 ? " is" : " are") + " silent";
  return formatted("cannot tell: no reading accepted for %.0f s", seconds) + why + "; before: " + before;
}

std::string describe(AlignmentJudge::Verdict verdict) {
  switch (verdict) {
    case AlignmentJudge::Verdict::kApart: return "the sensors read at different instants";
    case AlignmentJudge::Verdict::kLoneReadings: return "many readings find no partner: the sensors' rates differ";
    case AlignmentJudge::Verdict::kInterrupted:
      return "readings are lost so often that the integral filter would hardly ever be full";
    case AlignmentJudge::Verdict::kDoesWell: break;
  }
  return "";
}

std::string describe(EstimateDoubt doubt) {
  switch (doubt) {
    case EstimateDoubt::kNone: return "valid";
    case EstimateDoubt::kNoRows: return "the filter is filling after a start or a gap";
    case EstimateDoubt::kSensorStuck: return "the body's acceleration does not change: sensor stuck, or nothing moves";
    case EstimateDoubt::kWrongPeriod: return "stamps do not fit sample_period";
    case EstimateDoubt::kFewRows: return "too few samples yet";
    case EstimateDoubt::kNotExcited: return "parked: no excitation of damping and stiffness, estimates held";
    case EstimateDoubt::kDampingNotExcited: return "no excitation of damping, its estimate is held";
    case EstimateDoubt::kStiffnessNotExcited: return "no excitation of stiffness, its estimate is held";
    case EstimateDoubt::kUndersampled:
      return "an IMU shakes at half the sampling rate and beyond: sample faster, or filter before sampling";
    case EstimateDoubt::kOutsideForce:
      return "something else than the wheel moves the body, or did so just now: wind, loading, a sensor that is not on "
             "the wheel";
    case EstimateDoubt::kNotExplained: return "the model does not explain the measured acceleration";
    case EstimateDoubt::kNotAStrut: return "the estimates are not those of a spring and a damper";
    case EstimateDoubt::kClockSkew:
      return "the clocks of the two IMUs differ by too much for the estimation: synchronise them, diagnose tells "
             "by how much";
    case EstimateDoubt::kNoSpread: return "the estimates' standard deviation cannot be told";
    case EstimateDoubt::kFreeRunFails:
      return "the model, driven by the wheel, fits the body's motion worse than a constant";
  }
  return "unknown";
}

std::string describeShaking(const InputStatus& input) {
  constexpr double kMostBeyond = 0.5, kLeastLevel = 0.3;  // of the power; [m/s^2]: more than a sensor's noise
  std::vector<std::string> found;
  for (const Side side : {Side::kUnsprung, Side::kSprung}) {
    const InputStatus::SamplingLimit& limit = input.sampling_limit[static_cast<std::size_t>(side)];
    if (limit.isReached())
      found.push_back(
          formatted("the %s IMU shakes near half the sampling rate (power density there %.0f %% of its mean "
                    "one): sample faster or filter before sampling",
                    side == Side::kSprung ? "sprung" : "unsprung", 100.0 * limit.density));
  }
  if (input.beyond_strut > kMostBeyond && input.beyond_strut_level > kLeastLevel)
    found.push_back(
        formatted("the sprung IMU shakes above the strut's band (%.0f %% of its power, %.2g m/s^2): engine?",
                  100.0 * input.beyond_strut, input.beyond_strut_level));
  return join(found, "; ");
}

std::string describe(const SensorReport& report) {
  const auto& [sprung, unsprung] = report.mean;
  const auto stuck = [](const char* one, const char* other) {
    return formatted("the %s IMU reads one value while the %s one moves: stuck", one, other);
  };
  const auto off = [](const char* sensor, double mean) {
    return formatted("the %s IMU reads %.2f m/s^2 on average, neither 9.81 nor 0: gain, offset or mount", sensor, mean);
  };
  const auto in_g = [](const char* sensor) {
    return formatted("the %s IMU reads about 1 where the other reads gravity: it is in g, must be in m/s^2", sensor);
  };
  switch (report.fault) {
    case SensorFault::kNone: return {};
    case SensorFault::kSprungStuck: return stuck("sprung", "unsprung");
    case SensorFault::kUnsprungStuck: return stuck("unsprung", "sprung");
    case SensorFault::kSprungGravity: return off("sprung", sprung);
    case SensorFault::kUnsprungGravity: return off("unsprung", unsprung);
    case SensorFault::kGravityOnOneSide:
      return formatted("mean readings %.2f (sprung) and %.2f m/s^2 (unsprung): only one of the IMUs reads gravity",
                       sprung, unsprung);
    case SensorFault::kGravityOpposed:
      return "one IMU reads gravity upward, the other downward: "
             "one is mounted upside down, or its axis has the wrong sign";
    case SensorFault::kSprungInG: return in_g("sprung");
    case SensorFault::kUnsprungInG: return in_g("unsprung");
    case SensorFault::kNegativeDamping:
      return "damping is negative: are the IMUs swapped, or is an axis the wrong way up?";
    case SensorFault::kUnrelated:
      return "both IMUs move, but no strut makes the one of the other: "
             "sensor fault, wrong axis, wrong topic, or the two swapped";
  }
  return {};
}

std::string describe(const HealthReport& report) {
  return join(
      {describe(report.sensor), describeJudgement(report),
       report.early_warning && report.level == HealthLevel::kOk ? "early warning: a small change is certain" : "",
       report.outliers ? "outliers or saturation present (LS and LA disagree)" : ""},
      "; ");
}

std::string describe(const StrutChange& change, const Baseline& healthy) {
  const std::string reference = referenceOf(healthy.learned);
  const auto part = [&](const char* parameter, const std::optional<double>& size, double stddev) {
    return describeChange(parameter, size, std::abs(std::log1p(size.value_or(0.0))) / stddev, reference);
  };
  return join({part("damping", change.damping, change.damping_stddev),
               part("stiffness", change.stiffness, change.stiffness_stddev),
               describePayload(change.payload.value_or(0.0))});
}

std::string describe(const CornerComparisonReport& report) {
  if (report.numValid() < 3)
    return "cannot tell: " + std::to_string(report.numValid()) + " of 4 corners have a valid estimate, 3 are needed";
  std::vector<std::string> parts;
  for (const CornerDamage& damage : report.damages) parts.push_back(describe(damage, report.verdicts[damage.corner]));
  if (report.load) parts.push_back(describeLoad(report));
  if (report.dampers)
    parts.push_back("damping of all other corners alike " + sizeInPercent(*report.dampers) +
                    (*report.dampers < 0.0 ? " down: warm or worn dampers" : " up: cold dampers"));
  const std::optional<std::size_t>& missing = report.missing;
  if (parts.empty() && !report.by_nominal) parts.emplace_back("left and right alike (no baseline)");
  if (parts.empty()) parts.emplace_back(missing ? "the other corners alike" : "all corners alike");
  if (missing) parts.push_back("no valid estimate of " + nameOf(*missing));
  return join(parts, "; ");
}

}  // namespace suspension_health_monitor
