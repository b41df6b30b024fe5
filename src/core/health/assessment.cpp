#include "suspension_health_monitor/internal/health/assessment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

void checkThresholds(const std::string& parameter, double warn, double error) {
  if (!(error >= warn))
    refuse("health/" + parameter + "_error", error, "", "at least health/" + parameter + "_warn = " + numberText(warn));
}

// Mean number of windows between two early warnings of a healthy strut: 1e6 s over the shortest window, 4 s. Longer
// windows come at longer spacings.
constexpr double kWindowsBetweenFalseAlarms = 1e6 / 4.0;

// |ln(1 + change)| to 1 % for changes up to a third; its significance needs no more.
double logSize(double change) { return std::abs(2.0 * change / (2.0 + change)); }

// Times the significance that a level needs: no second estimate has to confirm it. Of 4 standard deviations 5, by
// chance once in a month of estimates every 2 s.
constexpr double kDecisive = 1.25;

/// A change of one parameter, and what it is judged by.
struct PartChange {
  double size;          ///< [-]
  double stddev;        ///< of ln(1 + size)
  double significance;  ///< also against a load that explains the same
  double blind;         ///< standard deviation that a change is proved against
  double warn, error;   ///< thresholds [-]
};

// Level of one parameter. A level that holds already ends below its threshold less the hysteresis, or less a standard
// deviation if that is more, or when the change has lost half of the significance that it began with.
HealthLevel levelOf(const PartChange& change, HealthLevel before) {
  constexpr double kHysteresis = 0.02;
  const double size = std::abs(change.size);
  const auto reaches = [&](HealthLevel level, double threshold) {
    const bool holds = before >= level && before != HealthLevel::kStale;
    if (change.significance < kCertain * (holds ? 0.5 : 1.0)) return false;
    return size + 1e-9 >= threshold - (holds ? std::fmax(kHysteresis, change.stddev) : 0.0);
  };
  if (reaches(HealthLevel::kError, change.error)) return HealthLevel::kError;
  if (reaches(HealthLevel::kWarn, change.warn)) return HealthLevel::kWarn;
  // A change as large as the error threshold would not be certain.
  return kCertain * change.blind > change.error ? HealthLevel::kStale : HealthLevel::kOk;
}

/// @return the change beyond what the others have, too.
PartChange beyond(const Measured& others, PartChange change) {
  const double stddev = std::hypot(change.stddev, others.stddev);
  change.size = std::expm1(std::log1p(change.size) - others.value);
  change.significance = std::fmin(change.significance, logSize(change.size) / stddev);
  change.stddev = stddev;
  return change;
}

}  // namespace

void requireConsistent(const HealthThresholds& thresholds) {
  checkThresholds("damping", thresholds.damping_warn, thresholds.damping_error);
  checkThresholds("stiffness", thresholds.stiffness_warn, thresholds.stiffness_error);
  if (thresholds.nominal_friction.has_value() != thresholds.nominal_friction_gain.has_value())
    throw std::invalid_argument("nominal/friction and nominal/friction_gain must be given together, or neither");
}

HealthAssessment::HealthAssessment(const HealthThresholds& options)
    : options_(options), damping_{{}, {kLeastChange, kWindowsBetweenFalseAlarms}}, stiffness_(damping_) {
  requireConsistent(options);
  baseline_ = nominalOf(options);
  if (baseline_.isEmpty() && options.learn_time > 0.0) learner_.emplace(options.learn_time);
}

void HealthAssessment::setOptions(const HealthThresholds& options) {
  requireConsistent(options);
  options_ = options;
}

void HealthAssessment::setBaseline(const Baseline& baseline) {
  baseline_ = baseline;
  learner_.reset();
  since_early_ = known_load_ = 0.0;
  for (Parameter* parameter : {&damping_, &stiffness_}) {
    parameter->trend.restart();
    parameter->early = {kLeastChange, kWindowsBetweenFalseAlarms};
    parameter->level = HealthLevel::kOk;
  }
}

const HealthReport& HealthAssessment::update(Stamp stamp, const StrutEstimate& estimate, bool is_new) {
  const bool tells = estimate.tellsChanges(), judges = tells && is_new;
  if (judges) take(stamp, estimate);
  HealthReport now = tells ? judged_ : HealthReport();  // which is kStale
  now.doubt = tells ? EstimateDoubt::kNone : estimate.doubt;
  now.sensor = sensor_;
  now.early_warning = damping_.early.isOn() || stiffness_.early.isOn();
  now.outliers = outlying_ > kOutlyingOften;
  now.learned = baseline_.learned;
  now.known_to = estimate.knownTo();
  now.enough = options_.enough();
  now.seconds_more = estimate.secondsUntil(now.enough);
  now.roughest = estimate.roughest;
  if (learner_) {
    now.learning = learner_->progress();
    now.learning_restarted = learner_->restarts() > 0;
  }
  const bool is_judgement = tells && sensor_.fault == SensorFault::kNone;
  if (tells && !is_judgement) now.level = HealthLevel::kWarn;
  // The same estimate twice is no confirmation of itself, unless it needs none.
  const bool is_decisive =
      std::max(judged_.damping_significance * (judged_.damping_level > HealthLevel::kOk),
               judged_.stiffness_significance * (judged_.stiffness_level > HealthLevel::kOk)) > kDecisive * kCertain;
  HealthLevel level = report_.level;
  if (judges || !is_judgement || is_decisive || stamp < report_stamp_)
    level = confirmation_.update(stamp, now.level, fromSeconds(options_.confirm_time));
  report_stamp_ = stamp;
  if (tells || level == HealthLevel::kStale) report_ = now;  // else the last judgement stands
  report_.level = level;
  return report_;
}

// What a new estimate says.
void HealthAssessment::take(Stamp stamp, const StrutEstimate& estimate) {
  const double seconds = taken_ && stamp > *taken_ ? std::min(toSeconds(stamp - *taken_), estimate.window) : 0.0;
  taken_ = stamp;
  if (learner_ && seconds > 0.0 && sensor_.fault == SensorFault::kNone)
    if (const std::optional<Baseline> learned = learner_->add(stamp, estimate, seconds)) setBaseline(*learned);
  MeasuredChange measured = changeFrom(baseline_, estimate);
  const auto carryOn = [&](Parameter& parameter, std::optional<Measured>& change) {
    if (change) change = parameter.trend.carryOn(*change, estimate.age, toSeconds(stamp), estimate.window);
  };
  carryOn(damping_, measured.damping);
  carryOn(stiffness_, measured.stiffness);
  const StrutChange change = splitChange(measured, options_.payload_range, known_load_);
  judged_ = reportOf(change);
  judge(change);
  judged_.friction_doubt = judged_.uncertain && measured.is_mostly_friction;
  noteLoad(change);
  since_early_ += seconds;
  if (since_early_ < estimate.window) return;
  since_early_ = 0.0;
  if (change.damping)
    damping_.early.add(std::expm1(damping_change_->value - (others_ ? others_->value : 0.0)), change.damping_stddev);
  if (change.stiffness) stiffness_.early.add(*change.stiffness, change.stiffness_stddev);
}

// The load is known while nothing but it has changed, and that is certain enough to be no beginning of a damage.
void HealthAssessment::noteLoad(const StrutChange& change) {
  if (!change.distance_from_load) return;
  const double apart = std::abs(change.measured.damping->value - change.measured.stiffness->value);
  if (apart + kLikely * change.apartStddev() < std::min(options_.damping_warn, options_.stiffness_warn) / 2.0)
    known_load_ = std::log1p(*change.payload);
}

// A part whose parameter has certainly changed, while a load may have done it.
LoadDoubt HealthAssessment::doubtOfLoad(const StrutChange& change) const {
  if (!change.distance_from_load) return LoadDoubt::kNone;
  const bool load_may = *change.distance_from_load < kCertain;
  const auto is_doubtful = [&](double part, double stddev, double warn) {
    return load_may && std::abs(part) >= warn && logSize(part) >= kCertain * stddev;
  };
  if (is_doubtful(*change.damping, change.damping_stddev, options_.damping_warn)) return LoadDoubt::kLoadOrDamper;
  if (is_doubtful(*change.stiffness, change.stiffness_stddev, options_.stiffness_warn)) return LoadDoubt::kLoadOrSpring;
  const bool is_loaded = *change.payload >= std::min(options_.damping_warn, options_.stiffness_warn);
  return is_loaded ? LoadDoubt::kLoadOrBoth : LoadDoubt::kNone;
}

void HealthAssessment::judge(const StrutChange& change) {
  HealthReport& now = judged_;
  const bool is_first = !damping_change_;
  damping_change_.reset();
  now.load_doubt = doubtOfLoad(change);
  const auto part = [&](double size, double stddev, const Measured& measured, double warn, double error) {
    PartChange its{size, stddev, logSize(size) / stddev, measured.stddev, warn, error};
    if (change.distance_from_load) {  // NaN: not known
      its.significance = std::fmin(its.significance, *change.distance_from_load);
      its.blind = std::fmax(its.blind, change.apartStddev());
    }
    return its;
  };
  if (change.damping) {
    const PartChange damping = part(*change.damping, change.damping_stddev, *change.measured.damping,
                                    options_.damping_warn, options_.damping_error);
    now.damping_significance = damping.significance;
    const HealthLevel before = damping_.level;
    damping_.level = levelOf(damping, before);
    damping_change_ = Measured{std::log1p(*change.damping), change.damping_stddev};
    if (others_ && damping_.level < HealthLevel::kError) {
      const HealthLevel own = levelOf(beyond(*others_, damping), before);
      if (own == HealthLevel::kOk && damping_.level == HealthLevel::kWarn)
        now.shared_damping_change = std::expm1(nearestToNone(std::minmax(damping_change_->value, others_->value)));
      if (own != HealthLevel::kStale) damping_.level = std::min(own, HealthLevel::kWarn);
    }
    if (is_first && awaits_others_ && damping_.level == HealthLevel::kWarn) damping_.level = before;
  }
  if (change.stiffness) {
    const PartChange stiffness = part(*change.stiffness, change.stiffness_stddev, *change.measured.stiffness,
                                      options_.stiffness_warn, options_.stiffness_error);
    now.stiffness_significance = stiffness.significance;
    stiffness_.level = levelOf(stiffness, stiffness_.level);
  }
  now.damping_level = damping_.level;
  now.stiffness_level = stiffness_.level;
  const auto known = [](HealthLevel level) { return level == HealthLevel::kStale ? HealthLevel::kOk : level; };
  now.level = std::max(known(damping_.level), known(stiffness_.level));
  now.uncertain = std::max(damping_.level, stiffness_.level) == HealthLevel::kStale;
  if (now.level == HealthLevel::kOk && now.uncertain) now.level = HealthLevel::kStale;
}

}  // namespace suspension_health_monitor
