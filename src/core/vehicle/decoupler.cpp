#include "suspension_health_monitor/internal/vehicle/decoupler.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {

TravelObserver::TravelObserver(double period, double stiffness_to_mass, int natural_period)
    : period_(period),
      washout_(kVehicleTuning.washout * std::sqrt(stiffness_to_mass)),
      horizon_(std::pow(natural_period * period, kVehicleTuning.means)),
      step_(0.0, 1.0, period),
      offset_(std::exp(-period / kVehicleTuning.offset_memory)),
      slow_(now_.size(),
            LinearIntegralFilter(kVehicleTuning.means, {natural_period, period, IntegrationRule::kTrapezoid}, 0)),
      recent_(now_.size(), boost::circular_buffer<double>(kVehicleTuning.means * natural_period / 2 + 1)) {}

void TravelObserver::push(double relative_acceleration) {
  offset_.add(relative_acceleration);
  auto& [travel, rate, acceleration] = now_;
  double leaves = 0.0;
  if (input_.full()) {
    const WheelStep gain = step_(input_.window());
    age_ += period_;
    const double washout = std::max(washout_, kVehicleTuning.washout_start / age_);
    leaves = washout * (2.0 * kVehicleTuning.washout_damping * rate + washout * travel);
    travel += period_ * rate + gain.end_position;
    rate += gain.end_velocity - period_ * leaves;
  }
  input_.push(relative_acceleration - offset_.mean());
  if (!input_.full()) return;
  acceleration = input_.window()[WheelInterpolator::kWidth / 2 - 1] - leaves;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    slow_[i].push(now_[i]);
    recent_[i].push_back(now_[i]);
  }
}

void TravelObserver::startNewSeries() {
  input_.reset();
  age_ = 0.0;
  now_ = {};
  for (LinearIntegralFilter& slow : slow_) slow.reset();
  for (auto& values : recent_) values.clear();
}

Decoupler::Decoupler(double period, const BodyRows& rows, const std::vector<StrutModel>& models,
                     const std::vector<double>& low_pass)
    : period_(period), taps_(low_pass.empty() ? std::vector<double>{1.0} : low_pass) {
  setRows(rows);
  double slowest = 0.0;  // natural period [s]
  for (const StrutModel& model : models) slowest = std::max(slowest, 2.0 * M_PI / std::sqrt(model.stiffness_to_mass));
  slowest = std::min(slowest, kVehicleTuning.longest_period);
  // in samples, even
  const int natural_period = 2 * std::max(1, static_cast<int>(std::lround(slowest / (2.0 * period))));
  const double forgetting = std::exp(-period / kVehicleTuning.mean_memory);
  force_means_.assign(rows.force.cols(), LimitedMean(forgetting));
  for (const StrutModel& model : models)
    struts_.push_back({model, TravelObserver(period, model.stiffness_to_mass, natural_period), LimitedMean(forgetting),
                       RunningMean(forgetting), boost::circular_buffer<Observed>(taps_.size())});
  recent_.set_capacity(TravelObserver::delayOf(natural_period) + taps_.size() / 2 + 1);
}

void Decoupler::setRows(const BodyRows& rows) {
  const Eigen::Index n = rows.size();
  for (StrutMatrix& ratios : ratios_) ratios.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      ratios_[kDamper](i, j) = i == j ? 0.0 : rows.rate(i, j) / rows.rate(j, j);
      ratios_[kSpring](i, j) = i == j ? 0.0 : rows.travel(i, j) / rows.travel(j, j);
      ratios_[kLaw](i, j) = i == j ? 0.0 : rows.ratio(i, j).value;
    }
  forces_ = rows.force;
}

const VehicleSample* Decoupler::push(const VehicleSample& sample) {
  recent_.push_back(sample);
  const StrutVector& wheels = taps_.size() > 1 ? sample.unfiltered : sample.unsprung;
  for (std::size_t j = 0; j < struts_.size(); ++j) {
    struts_[j].gravity.add(sample.sprung[j]);
    struts_[j].travel.push(wheels[j] - sample.sprung[j]);
  }
  for (std::size_t k = 0; k < force_means_.size(); ++k) force_means_[k].add(sample.forces[k]);
  if (!struts_.front().travel.full()) return nullptr;
  const std::size_t observed = recent_.size() + taps_.size() / 2 - recent_.capacity();
  const StrutVector& body = recent_[observed].sprung;
  for (std::size_t j = 0; j < struts_.size(); ++j) follow(struts_[j], body[j] - struts_[j].gravity.mean());
  if (!struts_.front().observed.full()) return nullptr;

  out_ = recent_.front();
  ForceVector forces = out_.forces;
  for (std::size_t k = 0; k < force_means_.size(); ++k) forces[k] -= force_means_[k].mean();
  Eigen::Matrix<double, Eigen::Dynamic, kParts + 1, Eigen::ColMajor, kMostStruts> parts(out_.sprung.size(), kParts + 1);
  StrutVector stiffness(out_.sprung.size());
  for (std::size_t j = 0; j < struts_.size(); ++j) {
    Observed filtered = Observed::Zero();
    for (std::size_t k = 0; k < taps_.size(); ++k) filtered += taps_[k] * struts_[j].observed[k];
    parts.row(j) = filtered.transpose();
    stiffness[j] = struts_[j].model.stiffness_to_mass;
  }
  const StrutVector slow = out_.unsprung - out_.sprung - parts.col(kParts);
  StrutVector neighbours = forces_ * forces;
  for (const Part part : {kDamper, kSpring, kLaw}) neighbours += ratios_[part] * parts.col(part);
  const StrutVector unseen = ratios_[kSpring] * stiffness.cwiseProduct(slow);
  out_.sprung -= neighbours;
  const StrutVector by_others = neighbours - unseen.cwiseQuotient(stiffness);
  out_.unsprung -= by_others;
  if (out_.unfiltered.size() > 0) out_.unfiltered -= by_others;
  return &out_;
}

void Decoupler::follow(Strut& strut, double body_acceleration) const {
  const double mean_travel = -strut.laws.mean() / strut.model.stiffness_to_mass;
  const StrutMotion now{strut.travel.travel() + mean_travel, strut.travel.travelRate(), 0.0, 0.0, body_acceleration};
  followMemories(strut.model, strut.motion, now, period_, strut.memory);
  strut.motion = now;
  const double damper = strut.model.damping_to_mass * now.travel_rate;
  const double law = strut.model.force(now.travel, now.travel_rate, 0.0, strut.memory.data()) - damper -
                     strut.model.stiffness_to_mass * now.travel;
  strut.laws.add(law);
  strut.observed.push_back({damper, strut.model.stiffness_to_mass * strut.travel.travel(), law - strut.laws.mean(),
                            strut.travel.acceleration()});
}

void Decoupler::startNewSeries() {
  recent_.clear();
  for (Strut& strut : struts_) {
    strut.travel.startNewSeries();
    strut.observed.clear();
    strut.motion = {};
    strut.memory = {};
  }
}

}  // namespace suspension_health_monitor
