#include "suspension_health_monitor/internal/health/assessment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

void checkThresholds(const char* parameter, double warn, double error) {
  if (!(error >= warn))
    throw std::invalid_argument("health/" + std::string(parameter) + "_error = " + std::to_string(error) +
                                ", must be at least health/" + parameter + "_warn = " + std::to_string(warn));
}

// Of the estimates, in updates; infinite for one that never forgets.
double memoryOf(const HealthOptions& options) {
  return 1.0 / (1.0 - options.forgetting_factor) / options.rows_per_update;
}

double horizonOf(const HealthOptions& options) {
  return static_cast<double>(options.horizon_samples) / options.rows_per_update;
}

double spacingOfEarly(const HealthOptions& options) { return 2.0 * (memoryOf(options) + horizonOf(options)); }

EarlyWarning earlyWarning(const HealthOptions& options) {
  const double spacing = spacingOfEarly(options) * options.rows_per_update * options.period;  // [s]
  return {options.early_change, std::max(2.0, options.false_alarm_interval / spacing),
          FollowedParameter::varianceOfMeans(memoryOf(options), horizonOf(options), spacingOfEarly(options))};
}

// |ln(1 + change)| to 1 % for changes up to a third; its significance needs no more.
double logSize(double change) { return std::abs(2.0 * change / (2.0 + change)); }

constexpr double kHeldShare = 0.5;  // of the significance that a level began with

/// A change of one parameter, and what it is judged by.
struct PartChange {
  double size;          ///< [-]
  double stddev;        ///< of ln(1 + size)
  double significance;  ///< also against a load that explains the same
  double blind;         ///< standard deviation that a change is proved against
  double warn, error;   ///< thresholds [-]
};

// Half of the change's variance and more.
bool isMostlyFriction(const std::optional<HealthyValue>& healthy, const std::optional<LogChange>& change) {
  return healthy && change && healthy->by_friction / healthy->value >= std::sqrt(0.5) * change->stddev;
}

// Level of one parameter. A level that holds already ends below its threshold less the hysteresis, or less a standard
// deviation if that is more, or when the change has lost half of the significance that it began with.
HealthLevel levelOf(const PartChange& change, HealthLevel before, const HealthOptions& options) {
  const double size = std::abs(change.size);
  const auto reaches = [&](HealthLevel level, double threshold) {
    const bool holds = before >= level && before != HealthLevel::kStale;
    if (change.significance < options.min_significance * (holds ? kHeldShare : 1.0)) return false;
    return size + 1e-9 >= threshold - (holds ? std::fmax(options.hysteresis, change.stddev) : 0.0);
  };
  if (reaches(HealthLevel::kError, change.error)) return HealthLevel::kError;
  if (reaches(HealthLevel::kWarn, change.warn)) return HealthLevel::kWarn;
  // A change as large as the error threshold would not be certain.
  return options.min_significance * change.blind > change.error ? HealthLevel::kStale : HealthLevel::kOk;
}

}  // namespace

void HealthOptions::validate() const {
  checkThresholds("damping", damping_warn, damping_error);
  checkThresholds("stiffness", stiffness_warn, stiffness_error);
}

HealthAssessment::HealthAssessment(const HealthOptions& options)
    : options_(options),
      memory_(memoryOf(options)),
      confirmation_(fromSeconds(options.confirm_time)),
      damping_{FollowedParameter(memory_, horizonOf(options)), earlyWarning(options)},
      stiffness_(damping_) {
  options.validate();
  baseline_.damping_to_mass = options.nominal_damping_to_mass;
  baseline_.stiffness_to_mass = options.nominal_stiffness_to_mass;
  const double rows = options.learn_time / options.period;
  if (baseline_.isEmpty() && rows > 0.0) learner_.emplace(rows, memory_ * options.rows_per_update);
}

void HealthAssessment::setOptions(const HealthOptions& options) {
  options.validate();
  options_ = options;
  if (memoryOf(options) != memory_) {
    memory_ = memoryOf(options);
    damping_.course = stiffness_.course = FollowedParameter(memory_, horizonOf(options));
  }
  confirmation_.setConfirmTime(fromSeconds(options.confirm_time));
}

void HealthAssessment::setMemory(double rows) {
  const double memory = std::min(memory_, rows / options_.rows_per_update);
  damping_.course.setMemory(memory, horizonOf(options_));
  stiffness_.course.setMemory(memory, horizonOf(options_));
}

void HealthAssessment::setBaseline(const Baseline& baseline) {
  baseline_ = baseline;
  learner_.reset();
  since_early_ = known_load_ = 0.0;
  for (Parameter* parameter : {&damping_, &stiffness_}) {
    parameter->early = earlyWarning(options_);
    parameter->level = HealthLevel::kOk;
  }
}

const HealthReport& HealthAssessment::update(Stamp stamp, const StrutEstimate& ls, const StrutEstimate& la) {
  HealthReport now;
  now.estimate_valid = la.valid();
  now.doubt = la.doubt;
  now.sensor = sensor_;
  if (la.valid()) {
    follow(ls, la);
    if (learner_ && agreement_.holds())
      if (const std::optional<Baseline> learned = learner_->add(stamp, ls, options_.rows_per_update))
        setBaseline(*learned);
    const HealthyValues healthy = onThisRoad(baseline_, la.friction, options_.min_significance);
    const StrutChange changed = change(healthy);
    judge(changed, now);
    now.friction_doubt = now.uncertain && (isMostlyFriction(healthy.damping, changed.measured_damping) ||
                                           isMostlyFriction(healthy.stiffness, changed.measured_stiffness));
    noteLoad(changed);
    warnEarly(changed);
  }
  now.early_warning = damping_.early.isOn() || stiffness_.early.isOn();
  now.outliers = agreement_.fails();
  now.learned = baseline_.learned;
  if (learner_) {
    now.learning = learner_->progress();
    now.learning_restarted = learner_->restarts() > 0;
  }
  const HealthLevel level = confirmation_.update(stamp, now.level);
  if (la.valid() || level == HealthLevel::kStale) report_ = now;  // else the last judgement stands, with its reasons
  report_.level = level;
  return report_;
}

void HealthAssessment::follow(const StrutEstimate& ls, const StrutEstimate& la) {
  agreement_.update(ls, la, memory_);
  const auto if_valid = [&](double value, double stddev) {
    return ls.valid() ? std::optional<UncertainValue>({value, stddev}) : std::nullopt;
  };
  damping_.course.follow(if_valid(ls.damping_to_mass, ls.damping_to_mass_stddev),
                         {la.damping_to_mass, la.damping_to_mass_stddev});
  stiffness_.course.follow(if_valid(ls.stiffness_to_mass, ls.stiffness_to_mass_stddev),
                           {la.stiffness_to_mass, la.stiffness_to_mass_stddev});
}

StrutChange HealthAssessment::change(const HealthyValues& healthy) const {
  const auto from = [&](const std::optional<HealthyValue>& value, const FollowedParameter& parameter) {
    return value ? parameter.changeFrom(*value, options_.min_significance) : std::nullopt;
  };
  return splitChange(from(healthy.damping, damping_.course), from(healthy.stiffness, stiffness_.course),
                     options_.payload_range, known_load_);
}

// The load is known while nothing but it has changed, and that is certain enough to be no beginning of a damage.
void HealthAssessment::noteLoad(const StrutChange& change) {
  if (!change.load_alone) return;
  const double apart = std::abs(change.measured_damping->size - change.measured_stiffness->size);
  if (apart + kLoadCertain * change.apartStddev() <
      kLoadShare * std::min(options_.damping_warn, options_.stiffness_warn))
    known_load_ = std::log1p(*change.payload);
}

// A part whose parameter has certainly changed, while a load may have done it.
LoadDoubt HealthAssessment::doubtOfLoad(const StrutChange& change) const {
  if (!change.load_alone) return LoadDoubt::kNone;
  const bool load_may = change.load_alone->distance < options_.min_significance;
  const auto is_doubtful = [&](double part, double stddev, double warn) {
    return load_may && std::abs(part) >= warn && logSize(part) >= options_.min_significance * stddev;
  };
  if (is_doubtful(*change.damping, change.damping_stddev, options_.damping_warn)) return LoadDoubt::kLoadOrDamper;
  if (is_doubtful(*change.stiffness, change.stiffness_stddev, options_.stiffness_warn)) return LoadDoubt::kLoadOrSpring;
  const bool is_loaded = *change.payload >= std::min(options_.damping_warn, options_.stiffness_warn);
  return is_loaded ? LoadDoubt::kLoadOrBoth : LoadDoubt::kNone;
}

void HealthAssessment::judge(const StrutChange& change, HealthReport& now) {
  now.damping_change = change.damping;
  now.stiffness_change = change.stiffness;
  now.payload_change = change.payload;
  now.load_doubt = doubtOfLoad(change);
  const auto part = [&](double size, double stddev, const LogChange& measured, double warn, double error) {
    const double significance = logSize(size) / stddev;
    if (!change.load_alone) return PartChange{size, stddev, significance, measured.stddev, warn, error};
    return PartChange{size,
                      stddev,
                      std::fmin(significance, change.load_alone->distance),
                      std::fmax(measured.stddev, change.apartStddev()),
                      warn,
                      error};  // NaN: not known
  };
  if (change.damping) {
    const PartChange damping = part(*change.damping, change.damping_stddev, *change.measured_damping,
                                    options_.damping_warn, options_.damping_error);
    now.damping_significance = damping.significance;
    damping_.level = levelOf(damping, damping_.level, options_);
  }
  if (change.stiffness) {
    const PartChange stiffness = part(*change.stiffness, change.stiffness_stddev, *change.measured_stiffness,
                                      options_.stiffness_warn, options_.stiffness_error);
    now.stiffness_significance = stiffness.significance;
    stiffness_.level = levelOf(stiffness, stiffness_.level, options_);
  }
  now.damping_level = damping_.level;
  now.stiffness_level = stiffness_.level;
  const auto known = [](HealthLevel level) { return level == HealthLevel::kStale ? HealthLevel::kOk : level; };
  now.level = std::max(known(damping_.level), known(stiffness_.level));
  now.uncertain = std::max(damping_.level, stiffness_.level) == HealthLevel::kStale;
  if (now.level == HealthLevel::kOk && now.uncertain) now.level = HealthLevel::kStale;
  if (now.sensor.fault != SensorFault::kNone) now.level = HealthLevel::kWarn;
}

void HealthAssessment::warnEarly(const StrutChange& change) {
  since_early_ += 1.0;
  if (since_early_ < spacingOfEarly(options_)) return;
  since_early_ = 0.0;
  if (change.damping) damping_.early.add(*change.damping, change.damping_stddev);
  if (change.stiffness) stiffness_.early.add(*change.stiffness, change.stiffness_stddev);
}

}  // namespace suspension_health_monitor
