#include "suspension_health_monitor/internal/vehicle/decoupler.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kMeanMemory = 10.0;  // [s]
constexpr double kLongest = 4.0;      // natural period [s]: softer is no suspension

// That of the slowest strut [samples], even.
int naturalPeriod(const std::vector<StrutModel>& models, double period) {
  double slowest = 0.0;
  for (const StrutModel& model : models) slowest = std::max(slowest, 2.0 * kPi / std::sqrt(model.stiffness_to_mass));
  return 2 * std::max(1, static_cast<int>(std::lround(std::min(slowest, kLongest) / (2.0 * period))));
}

}  // namespace

Decoupler::Decoupler(double period, const Coupling& coupling, const std::vector<StrutModel>& models,
                     const std::vector<double>& low_pass)
    : period_(period),
      weights_(coupling),
      bars_(coupling.bars),
      taps_(low_pass.empty() ? std::vector<double>{1.0} : low_pass),
      force_means_(static_cast<std::size_t>(coupling.forces.cols()), LimitedMean(std::exp(-period / kMeanMemory))) {
  const int natural_period = naturalPeriod(models, period);
  for (const StrutModel& model : models)
    struts_.push_back({model, TravelObserver(period, model.stiffness_to_mass, natural_period),
                       LimitedMean(std::exp(-period / kMeanMemory)), RunningMean(std::exp(-period / kMeanMemory)),
                       boost::circular_buffer<Eigen::Vector3d>(taps_.size())});
  recent_.set_capacity(static_cast<std::size_t>(TravelObserver::delayOf(natural_period)) + taps_.size() / 2 + 1);
}

const VehicleSample* Decoupler::push(const VehicleSample& sample) {
  recent_.push_back(sample);
  const StrutVector& wheels = taps_.size() > 1 ? sample.unfiltered : sample.unsprung;
  for (std::size_t j = 0; j < struts_.size(); ++j) {
    const auto place = static_cast<Eigen::Index>(j);
    struts_[j].gravity.add(sample.sprung[place]);
    struts_[j].travel.push(wheels[place] - sample.sprung[place]);
  }
  for (std::size_t k = 0; k < force_means_.size(); ++k)
    force_means_[k].add(sample.forces[static_cast<Eigen::Index>(k)]);
  if (!struts_.front().travel.full()) return nullptr;
  const std::size_t observed = recent_.size() + taps_.size() / 2 - recent_.capacity();
  const StrutVector& body = recent_[observed].sprung;
  for (std::size_t j = 0; j < struts_.size(); ++j)
    follow(struts_[j], body[static_cast<Eigen::Index>(j)] - struts_[j].gravity.mean());
  if (!struts_.front().told.full()) return nullptr;

  out_ = recent_.front();
  ForceVector forces = out_.forces;
  for (std::size_t k = 0; k < force_means_.size(); ++k) forces[static_cast<Eigen::Index>(k)] -= force_means_[k].mean();
  StrutVector moving = out_.sprung, modelled(out_.sprung.size()), stiffness = modelled, travel = modelled,
              slow = modelled;
  for (std::size_t j = 0; j < struts_.size(); ++j) {
    const auto place = static_cast<Eigen::Index>(j);
    const Eigen::Vector3d told = filtered(struts_[j]);
    moving[place] -= struts_[j].gravity.mean();
    modelled[place] = told[0];
    travel[place] = told[1];
    slow[place] = out_.unsprung[place] - out_.sprung[place] - told[2];
    stiffness[place] = struts_[j].model.stiffness_to_mass;
  }
  // At its own strut, too, what a bar does is not the strut's.
  const StrutVector by_bars = ofBars(travel), slow_by_bars = ofBars(slow);
  const StrutVector neighbours = weights_.neighbours(moving, forces, modelled + by_bars) + by_bars;
  const StrutVector unseen = weights_.leaked(stiffness.cwiseProduct(slow) + slow_by_bars) + slow_by_bars;
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
  const double force = strut.model.force(now.travel, now.travel_rate, 0.0, strut.memory.data());
  strut.laws.add(force - strut.model.damping_to_mass * now.travel_rate - strut.model.stiffness_to_mass * now.travel);
  strut.told.push_back({force, strut.travel.travel(), strut.travel.acceleration()});
}

Eigen::Vector3d Decoupler::filtered(const Strut& strut) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < taps_.size(); ++k) sum += taps_[k] * strut.told[k];
  return sum;
}

// @return sum over m of bar_im (x_i - x_m).
StrutVector Decoupler::ofBars(const StrutVector& travels) const {
  return bars_.rowwise().sum().cwiseProduct(travels) - bars_ * travels;
}

void Decoupler::startNewSeries() {
  recent_.clear();
  for (Strut& strut : struts_) {
    strut.travel.startNewSeries();
    strut.told.clear();
    strut.motion = {};
    strut.memory = {};
  }
}

}  // namespace suspension_health_monitor
