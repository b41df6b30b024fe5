#include "suspension_health_monitor/health/assessment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace suspension_health_monitor {
namespace {

constexpr double kTrendMemories = 3.0;  // long enough to be calm, short enough to bend; measured in doc/health.md

void checkThresholds(const char* parameter, double warn, double error) {
  if (!(error >= warn))
    throw std::invalid_argument("health/" + std::string(parameter) + "_error = " + std::to_string(error) +
                                ", must be at least health/" + parameter + "_warn = " + std::to_string(warn));
}

// Of the estimates, in updates; one that never forgets has none.
double memoryOf(const HealthOptions& options) {
  return 1.0 / (1.0 - std::min(options.forgetting_factor, 1.0 - 1e-9)) / options.rows_per_update;
}

double horizonOf(const HealthOptions& options) {
  return static_cast<double>(options.horizon_samples) / options.rows_per_update;
}

// LS lags a ramp by its memory and by the filter.
ParameterTrend trendOf(const HealthOptions& options) {
  const double gain = std::min(0.5, 1.0 / (kTrendMemories * memoryOf(options)));
  return {gain, memoryOf(options) + horizonOf(options)};
}

double spacingOfEarly(const HealthOptions& options) { return 2.0 * (memoryOf(options) + horizonOf(options)); }

EarlyWarning earlyWarning(const HealthOptions& options) {
  const double spacing = spacingOfEarly(options) * options.rows_per_update * options.period;  // [s]
  return {options.early_change, std::max(2.0, options.false_alarm_interval / spacing)};
}

bool apart(double ls, double la, double ls_stddev, double la_stddev, double most, double tails) {
  return std::abs(ls - la) > most * la_stddev || ls_stddev > tails * la_stddev;
}

// |ln(1 + change)| to 1 % for changes up to a third; its significance needs no more.
double logSize(double change) { return std::abs(2.0 * change / (2.0 + change)); }

// std::hypot without its care for huge and tiny numbers, which costs most of it.
double sumOf(double a_stddev, double b_stddev) { return std::sqrt(a_stddev * a_stddev + b_stddev * b_stddev); }

// The value that tells of the larger change.
double worse(double a, double b, double healthy) {
  return std::abs(std::log(a / healthy)) > std::abs(std::log(b / healthy)) ? a : b;
}

// Level of one parameter. A level that holds already ends only below its threshold less the hysteresis.
HealthLevel levelOf(double change, double stddev, double warn, double error, HealthLevel before,
                    const HealthOptions& options) {
  const double size = std::abs(change);
  const bool certain = !(logSize(change) < options.min_significance * stddev);
  const auto reaches = [&](HealthLevel level, double threshold) {
    const bool holds = before >= level && before != HealthLevel::kStale;
    return size + 1e-9 >= threshold - (holds ? options.hysteresis : 0.0) && certain;
  };
  if (reaches(HealthLevel::kError, error)) return HealthLevel::kError;
  if (reaches(HealthLevel::kWarn, warn)) return HealthLevel::kWarn;
  const bool blind = options.min_significance * stddev > error;  // a change as large as that would not be certain
  return blind ? HealthLevel::kStale : HealthLevel::kOk;
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
      damping_(trendOf(options)),
      stiffness_(trendOf(options)),
      damping_early_(earlyWarning(options)),
      stiffness_early_(earlyWarning(options)) {
  options.validate();
  baseline_.damping_to_mass = options.nominal_damping_to_mass;
  baseline_.stiffness_to_mass = options.nominal_stiffness_to_mass;
  const double rows = options.learn_time / options.period;
  if (baseline_.isEmpty() && rows > 0.0) learner_.emplace(rows, memory_ * options.rows_per_update);
}

void HealthAssessment::setOptions(const HealthOptions& options) {
  options.validate();
  options_ = options;
  confirmation_.setConfirmTime(fromSeconds(options.confirm_time));
}

void HealthAssessment::setBaseline(const Baseline& baseline) {
  baseline_ = baseline;
  learner_.reset();
  damping_early_ = stiffness_early_ = earlyWarning(options_);
  since_early_ = 0.0;
  damping_level_ = stiffness_level_ = HealthLevel::kOk;
}

const HealthReport& HealthAssessment::update(Stamp stamp, const StrutEstimate& ls, const StrutEstimate& la) {
  HealthReport now;
  now.estimate_valid = la.valid;
  now.sensor = sensor_;
  if (la.valid) {
    follow(ls, la);
    if (learner_) learn(stamp, la);
    const StrutChange changed = change(ls, la);
    judge(changed, now);
    warnEarly(changed);
  }
  now.early_warning = damping_early_.isOn() || stiffness_early_.isOn();
  now.outliers = disagreement_ > kOutlierShare;
  now.learned = baseline_.learned;
  if (learner_) {
    now.learning = learner_->progress();
    now.learning_restarted = learner_->restarts() > 0;
  }
  const HealthLevel level = confirmation_.update(stamp, now.level);
  if (la.valid || level == HealthLevel::kStale) report_ = now;  // else the last judgement stands, with its reasons
  report_.level = level;
  return report_;
}

void HealthAssessment::follow(const StrutEstimate& ls, const StrutEstimate& la) {
  agree_ = ls.valid && !apart(ls.damping_to_mass, la.damping_to_mass, ls.damping_to_mass_stddev,
                              la.damping_to_mass_stddev, kAgreement, kTails) &&
           !apart(ls.stiffness_to_mass, la.stiffness_to_mass, ls.stiffness_to_mass_stddev, la.stiffness_to_mass_stddev,
                  kAgreement, kTails);
  disagreement_ += ((agree_ ? 0.0 : 1.0) - disagreement_) / (kOutlierMemories * memory_);
  coasted_ = agree_ ? 0.0 : coasted_ + 1.0;
  if (agree_) {
    damping_.follow(ls.damping_to_mass, ls.damping_to_mass_stddev);
    stiffness_.follow(ls.stiffness_to_mass, ls.stiffness_to_mass_stddev);
  } else if (coasted_ <= kCoastMemories * memory_) {
    damping_.coast();
    stiffness_.coast();
  } else {
    damping_.follow(la.damping_to_mass, la.damping_to_mass_stddev);
    stiffness_.follow(la.stiffness_to_mass, la.stiffness_to_mass_stddev);
  }
}

void HealthAssessment::learn(Stamp stamp, const StrutEstimate& la) {
  if (!agree_) return;
  if (const std::optional<Baseline> learned = learner_->add(stamp, la, options_.rows_per_update)) setBaseline(*learned);
}

StrutChange HealthAssessment::change(const StrutEstimate& ls, const StrutEstimate& la) const {
  const auto against = [&](const std::optional<double>& healthy, double healthy_stddev, const ParameterTrend& trend,
                           double la_value, double stddev) -> std::optional<LogChange> {
    if (!healthy) return std::nullopt;
    const double by_trend = trend.now().value_or(la_value);
    const bool usable = options_.forgetting_factor < 1.0 && by_trend > 0.0;
    const double value = !usable ? la_value : agree_ ? by_trend : worse(by_trend, la_value, *healthy);
    return LogChange{std::log(value / *healthy), sumOf(stddev / la_value, healthy_stddev / *healthy)};
  };
  const StrutEstimate& of = agree_ ? ls : la;
  return splitChange(against(baseline_.damping_to_mass, baseline_.damping_to_mass_stddev, damping_, la.damping_to_mass,
                             of.damping_to_mass_stddev),
                     against(baseline_.stiffness_to_mass, baseline_.stiffness_to_mass_stddev, stiffness_,
                             la.stiffness_to_mass, of.stiffness_to_mass_stddev),
                     options_.payload_range);
}

void HealthAssessment::judge(const StrutChange& change, HealthReport& now) {
  now.damping_change = change.damping;
  now.stiffness_change = change.stiffness;
  now.payload_change = change.payload;
  if (change.damping) {
    now.damping_significance = logSize(*change.damping) / change.damping_stddev;
    damping_level_ = levelOf(*change.damping, change.damping_stddev, options_.damping_warn, options_.damping_error,
                             damping_level_, options_);
  }
  if (change.stiffness) {
    now.stiffness_significance = logSize(*change.stiffness) / change.stiffness_stddev;
    stiffness_level_ = levelOf(*change.stiffness, change.stiffness_stddev, options_.stiffness_warn,
                               options_.stiffness_error, stiffness_level_, options_);
  }
  now.damping_level = damping_level_;
  now.stiffness_level = stiffness_level_;
  const auto known = [](HealthLevel level) { return level == HealthLevel::kStale ? HealthLevel::kOk : level; };
  now.level = std::max(known(damping_level_), known(stiffness_level_));
  now.uncertain = std::max(damping_level_, stiffness_level_) == HealthLevel::kStale;
  if (now.level == HealthLevel::kOk && now.uncertain) now.level = HealthLevel::kStale;
  if (now.sensor.fault != SensorFault::kNone) now.level = HealthLevel::kWarn;
}

void HealthAssessment::warnEarly(const StrutChange& change) {
  since_early_ += 1.0;
  if (!agree_ || since_early_ < spacingOfEarly(options_)) return;
  since_early_ = 0.0;
  if (change.damping) damping_early_.add(*change.damping, change.damping_stddev);
  if (change.stiffness) stiffness_early_.add(*change.stiffness, change.stiffness_stddev);
}

}  // namespace suspension_health_monitor
