#include "suspension_health_monitor/internal/monitor/drive_identification.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "suspension_health_monitor/internal/health/sensor_check.h"
#include "suspension_health_monitor/internal/monitor/validity_gate.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/recording_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

constexpr double kInterval = 1.96;  // standard deviations either way: 95 %

constexpr double kForgetsNothing = 1.0;

bool isAboveZero(double value, double stddev) { return value > kInterval * stddev; }

}  // namespace

std::optional<std::string> periodWarning(const SuspensionMonitor& monitor) {
  if (monitor.input().period_fits) return std::nullopt;
  char text[200];
  std::snprintf(text, sizeof text,
                "stamps come every %.6g s, but sample_period = %.6g [s]: no estimate is valid; leave sample_period out "
                "to have it measured",
                monitor.input().mean_period, monitor.period());
  return text;
}

IdentifiedStrut atTheEnd(const StrutEstimate& estimate) {
  IdentifiedStrut strut{estimate.damping_to_mass,
                        estimate.stiffness_to_mass,
                        estimate.damping_to_mass_stddev,
                        estimate.stiffness_to_mass_stddev,
                        estimate.effective_rows,
                        estimate.explained,
                        estimate.valid(),
                        {}};
  if (!strut.valid) strut.reason = describe(estimate.doubt);
  return strut;
}

DriveIdentification::WholeDrive::WholeDrive(const MonitorSettings& settings, int rows_late)
    : strut(settings.filter(*settings.sample_period), rows_late, settings.estimators.noise),
      wrong_variance(kForgetsNothing) {}

DriveIdentification::DriveIdentification(const MonitorSettings& settings, Sink sink)
    : strut_(settings, {std::move(sink), [this](const CornerSample& sample) { take(sample); }}),
      whole_drive_(std::in_place, settings, monitor().identifier().regression().delay()) {}

void DriveIdentification::setEffects(const std::vector<ActiveEffect>& effects) {
  strut_.setEffects(effects);
  if (!effects.empty()) whole_drive_.reset();
}

void DriveIdentification::take(const CornerSample& sample) {
  const InputStatus before = std::exchange(seen_, monitor().input());
  if (!whole_drive_ || seen_.samples == before.samples) return;  // the monitor has rejected it
  if (seen_.gaps + seen_.restarts != before.gaps + before.restarts) whole_drive_->strut.interrupt();
  const StrutIdentifier& live = monitor().identifier();
  whole_drive_->strut.push(sample, live.hasRow() ? &live.regression().row() : nullptr, live.regression().wheel());
  if (live.hasRow()) whole_drive_->wrong_variance.add(live.errors().wrongVariances()[1]);
}

IdentifiedStrut DriveIdentification::overTheDrive() const {
  IdentifiedStrut strut;
  if (!whole_drive_) {
    strut.reason = "instrumental variables know no effects";
    return strut;
  }
  strut.explained = whole_drive_->strut.explained();
  const StrutIdentifier& live = monitor().identifier();
  const SkewProfile* skew = live.regression().skew();
  const std::optional<InstrumentalVariables::Solution> solution = whole_drive_->strut.solution(
      {live.errors().noiseVariance(), whole_drive_->wrong_variance.mean(), skew != nullptr ? skew->variance() : 0.0});
  EstimateFacts facts;
  if (solution) {
    strut.damping_to_mass = solution->theta[kDampingToMass];
    strut.stiffness_to_mass = solution->theta[kStiffnessToMass];
    strut.damping_to_mass_stddev = solution->stddev[kDampingToMass];
    strut.stiffness_to_mass_stddev = solution->stddev[kStiffnessToMass];
    strut.rows = solution->rows;
    facts.wrong_share = solution->wrong_share;
  }
  facts.period_fits = monitor().input().period_fits;
  facts.has_row = monitor().input().rows > 0;
  facts.rows = strut.rows;
  facts.fewest_rows = kFewestHorizons * monitor().horizonSamples();
  facts.explained = strut.explained;
  facts.is_physical = isAboveZero(strut.damping_to_mass, strut.damping_to_mass_stddev) &&
                      isAboveZero(strut.stiffness_to_mass, strut.stiffness_to_mass_stddev);
  facts.skew_is_known = skew == nullptr || skew->isWithin();
  facts.has_stddev = std::isfinite(strut.damping_to_mass_stddev + strut.stiffness_to_mass_stddev);
  const EstimateDoubt doubt = doubtOf(facts);
  strut.valid = doubt == EstimateDoubt::kNone;
  if (!strut.valid) strut.reason = describe(doubt);
  if (doubt == EstimateDoubt::kFewRows)
    strut.reason += describeEnough(whole_drive_->strut.enoughSamples() * monitor().period());
  return strut;
}

IdentifyResult DriveIdentification::result() const {
  IdentifyResult result;
  result.sample_period = monitor().period();
  result.horizon_samples = monitor().horizonSamples();
  result.ls = atTheEnd(monitor().report().ls);
  result.la = atTheEnd(monitor().report().la);
  result.iv = overTheDrive();
  result.samples = monitor().input().samples;
  result.rows = monitor().input().rows;
  result.gaps = monitor().input().gaps;
  result.clock_jumps = monitor().input().restarts;
  result.rejected = rejected().byName();
  if (const auto warning = periodWarning(monitor())) result.warnings.push_back(*warning);
  const SensorReport& sensor = monitor().report().health.sensor;
  if (sensor.fault != SensorFault::kNone && sensor.fault != SensorFault::kUnrelated)
    result.warnings.push_back(describe(sensor));
  if (!result.isSteady()) result.warnings.push_back(describeUnsteady(result.iv, result.la));
  return result;
}

bool IdentifyResult::isSteady() const {
  constexpr double kCertain = 4.0;  // standard deviations: by chance once in 16 000 drives
  const auto agree = [this](double IdentifiedStrut::*value, double IdentifiedStrut::*stddev) {
    return std::abs(iv.*value - la.*value) <= kCertain * std::hypot(iv.*stddev, la.*stddev);
  };
  return !iv.valid || !la.valid ||
         (agree(&IdentifiedStrut::damping_to_mass, &IdentifiedStrut::damping_to_mass_stddev) &&
          agree(&IdentifiedStrut::stiffness_to_mass, &IdentifiedStrut::stiffness_to_mass_stddev));
}

}  // namespace suspension_health_monitor
