#include "suspension_health_monitor/internal/monitor/vehicle_monitor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"

namespace suspension_health_monitor {

constexpr std::size_t kFewestToCompare = 3;  // struts: of two nobody knows which one has changed

// Half of the blocks are new then, of those that there are or that are kept.
constexpr Stamp kBodyFirst = std::chrono::seconds(5), kBodyEvery = std::chrono::seconds(30);

VehicleMonitor::VehicleMonitor(const std::vector<MonitorSettings>& settings, Sink sink, int num_forces)
    : sink_(std::move(sink)),
      starts_(settings.begin(), settings.end()),
      num_forces_(num_forces),
      is_alone_(starts_.size() == 1 && num_forces == 0) {
  requireNumStruts(starts_.size());
  for (const MonitorSettings& each : settings) each.validate();
  if (settings.front().sample_period) begin(*settings.front().sample_period);
}

void VehicleMonitor::begin(double period) {
  for (Start& start : starts_) {
    start.settings.sample_period = period;
    start.settings.validate();
  }
  period_ = fromSeconds(period);
  if (is_alone_) beginStruts();
}

void VehicleMonitor::beginStruts() {
  for (const Start& start : starts_) {
    SuspensionMonitor& strut = struts_.emplace_back(start.settings, is_alone_);
    if (!start.effects.empty()) strut.setEffects(start.effects, start.strut);
    if (start.baseline) strut.setBaseline(*start.baseline);
  }
}

void VehicleMonitor::setEffects(std::size_t strut, const std::vector<ActiveEffect>& effects,
                                const std::optional<LinearStrut>& start) {
  requireUsable(effects);
  if (isCoupled()) return struts_[strut].setEffects(effects, start);
  starts_[strut].effects = effects;
  starts_[strut].strut = start;
}

void VehicleMonitor::setBaseline(std::size_t strut, const Baseline& baseline) {
  for (const auto& [name, value] : {std::pair("baseline damping_to_mass", baseline.damping_to_mass),
                                    std::pair("baseline stiffness_to_mass", baseline.stiffness_to_mass)})
    if (value) requireAboveZero(name, *value, "");
  if (isCoupled()) return struts_[strut].setBaseline(baseline);
  starts_[strut].baseline = baseline;
}

Baseline VehicleMonitor::baseline(std::size_t strut) const {
  return isCoupled() ? struts_[strut].baseline() : starts_[strut].baseline.value_or(Baseline{});
}

void VehicleMonitor::reconfigure(std::size_t strut, MonitorSettings settings) {
  settings.sample_period = starts_[strut].settings.sample_period;
  if (!settings.integration_horizon) settings.integration_horizon = starts_[strut].settings.integration_horizon;
  if (isCoupled()) struts_[strut].reconfigure(settings);
  starts_[strut].settings = settings;
}

void VehicleMonitor::addTemperature(std::size_t strut, Stamp stamp, double celsius) {
  if (isCoupled()) struts_[strut].addTemperature(stamp, celsius);
}

void VehicleMonitor::setUp(const VehicleStreams::Sensor& imu, std::string_view up) {
  if (!isCoupled() || (imu.place != VehicleStreams::Place::kSprung && imu.place != VehicleStreams::Place::kUnsprung))
    return;
  struts_[imu.strut].setUp(imu.place == VehicleStreams::Place::kSprung ? Side::kSprung : Side::kUnsprung, up);
}

void VehicleMonitor::addReading(const VehicleChannels& vehicle, const VehicleReading& reading) {
  if (is_alone_) {
    const Side side = reading.sensor == VehicleReading::Sensor::kUnsprung ? Side::kUnsprung : Side::kSprung;
    return struts_.front().addReading(side, reading.stamp, reading.values[0]);
  }
  if (!std::all_of(reading.values.begin(), reading.values.end(), isUsable)) return;
  if (!blocks_) blocks_.emplace(vehicle, toSeconds(period_), settings().presentBlockLength());
  const TopEstimate* estimate = blocks_->push(reading);
  if (blocks_->hasDeadGyro()) return takeDeadGyro();
  if (estimate == nullptr) return;
  if (estimate->strut + 1 == numStruts() || !decoupler_) learnRows();
  if (!isCoupled()) return;
  if (numStruts() >= kFewestToCompare) struts_[estimate->strut].setOthers(sharedByOthers(estimate->strut));
  struts_[estimate->strut].takeEstimate(*estimate, modelStddev(*estimate));
}

// From now on blocks are kept out, so that no new estimate would end the validity of the newest ones.
void VehicleMonitor::takeDeadGyro() {
  if (mistake_.kind == VehicleMistake::Kind::kDeadGyro) return;
  mistake_ = {VehicleMistake::Kind::kDeadGyro};
  for (std::size_t i = 0; i < struts_.size(); ++i)
    if (const TopEstimate* newest = blocks_->estimate(i)) struts_[i].takeEstimate(*newest, modelStddev(*newest));
}

// The least that all of them have: a worn one among them has no say.
std::optional<Measured> VehicleMonitor::sharedByOthers(std::size_t strut) const {
  std::optional<Measured> shared;
  std::pair<double, double> range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < numStruts(); ++i) {
    if (i == strut) continue;
    const std::optional<Measured>& change = struts_[i].dampingChange();
    if (!change) return std::nullopt;
    if (!shared || std::abs(change->value) < std::abs(shared->value)) shared = change;
    range = {std::min(range.first, change->value), std::max(range.second, change->value)};
  }
  shared->value = nearestToNone(range);
  return shared;
}

void VehicleMonitor::addGridSample(const VehicleSample& sample) {
  const Continuity how = last_ ? continuity(sample.stamp - *last_, period_) : Continuity::kGap;
  if (how == Continuity::kTooSoon && !is_alone_) return;
  last_ = sample.stamp;
  if (how != Continuity::kContinues && decoupler_) decoupler_->startNewSeries();
  const VehicleSample* own = &sample;
  if (!is_alone_) {
    if (!decoupler_) return;
    const std::int64_t every = std::max(1L, std::lround(kVehicleTuning.models_every / toSeconds(period_)));
    if (samples_++ % every == 0) takeModels();
    own = decoupler_->push(sample);
    if (own == nullptr) return;
  }
  for (std::size_t i = 0; i < struts_.size(); ++i) {
    const CornerSample of_strut = own->ofStrut(i);
    if (!is_alone_) struts_[i].hold(blocks_->estimator(i).newestSayNothing());
    const MonitorReport* report = is_alone_ ? struts_[i].addGridSample(of_strut) : struts_[i].addSample(of_strut);
    if (report != nullptr && sink_) sink_(i, *report);
  }
}

void VehicleMonitor::addSample(const VehicleSample& sample) {
  VehicleChannels vehicle;
  if (!blocks_) vehicle = VehicleChannels::ofAccelerometers(numStruts(), num_forces_);
  forReadings(sample, [&](const VehicleReading& reading) { addReading(vehicle, reading); });
  addGridSample(sample);
}

// Once per block.
void VehicleMonitor::learnRows() {
  if (!blocks_->rows(newest_rows_) || !newest_rows_.areKnown()) return;
  std::swap(rows_, newest_rows_);
  if (decoupler_) return decoupler_->setRows(rows_);
  const std::vector<StrutModel> models = rows_.models();
  decoupler_.emplace(toSeconds(period_), rows_, models);
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    MonitorSettings& settings = starts_[i].settings;
    if (!settings.integration_horizon)
      settings.integration_horizon = proposeHorizon(models[i].damping_to_mass, models[i].stiffness_to_mass);
  }
  beginStruts();
}

// As long as a strut has no valid estimate it shows in others as its row has it.
void VehicleMonitor::takeModels() {
  for (std::size_t i = 0; i < struts_.size(); ++i) {
    const StrutEstimate& now = struts_[i].report().estimate;
    if (!now.tellsChanges()) continue;
    const double friction = now.friction ? now.friction->force * now.friction->damping_gain : 0.0;
    decoupler_->setModel(i, {now.damping_to_mass + friction, now.stiffness_to_mass, struts_[i].effects(), {}});
  }
}

void VehicleMonitor::fitBody() {
  if (!blocks_ || numStruts() < 2) return;
  claims_.emplace(blocks_->claims());
  claims_->find();
  fitRows();
}

void VehicleMonitor::fitRows() {
  mistake_ = claims_->found();
  model_errors_ = claims_->modelErrors();
  claims_.reset();
  BodyRows rows;
  if (!blocks_->rows(rows)) return;
  body_ = fitRigidBody(rows, blocks_->vehicle().places(), blocks_->rowsOfHalves());
}

void VehicleMonitor::fitBodyIfDue() {
  if (!decoupler_ || !last_) return;
  if (claims_) {
    if (claims_->work()) fitRows();
    return;
  }
  if (coupled_ && *last_ >= fitted_ && *last_ - fitted_ < std::clamp(fitted_ - *coupled_, kBodyFirst, kBodyEvery))
    return;
  fitted_ = *last_;
  if (!coupled_) {  // no estimate is to be valid before the vehicle file is tested
    coupled_ = last_;
    return fitBody();
  }
  if (numStruts() > 1) claims_.emplace(blocks_->claims());
}

Eigen::Vector2d VehicleMonitor::modelStddev(const TopEstimate& estimate) const {
  if (mistake_.isContradiction()) return Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  if (!body_) return Eigen::Vector2d::Zero();
  const Eigen::Array2d own = estimate.theta.head<2>();
  const Eigen::Array2d of_rows = own * model_errors_.row(estimate.strut).transpose();
  return (body_->modelVariances(estimate.strut, own, estimate.frictionDamping()) + of_rows.square()).sqrt();
}

StrutEstimate VehicleMonitor::overTheDrive(std::size_t strut) {
  if (is_alone_) return struts_.front().overTheDrive();
  if (!isCoupled()) return {};
  const std::optional<TopEstimate> estimate = blocks_->overTheDrive(strut);
  if (!estimate) return struts_[strut].overTheDrive(std::nullopt, Eigen::Vector2d::Zero());
  return struts_[strut].overTheDrive(*estimate, modelStddev(*estimate));
}

}  // namespace suspension_health_monitor
