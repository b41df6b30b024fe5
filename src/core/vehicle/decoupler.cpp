#include "suspension_health_monitor/internal/vehicle/decoupler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "suspension_health_monitor/internal/pi.h"

namespace suspension_health_monitor {
namespace {

constexpr double kMeanMemory = 10.0;  // [s]
constexpr double kLongest = 4.0;      // natural period [s]: softer is no suspension
constexpr std::array<double, kMostEffects> kNoMemories{};

// That of the slowest strut [samples], even.
int naturalPeriod(const std::vector<StrutModel>& models, double period) {
  double slowest = 0.0;
  for (const StrutModel& model : models) slowest = std::max(slowest, 2.0 * kPi / std::sqrt(model.stiffness_to_mass));
  return 2 * std::max(1, static_cast<int>(std::lround(std::min(slowest, kLongest) / (2.0 * period))));
}

}  // namespace

Decoupler::Decoupler(double period, const Coupling& coupling, const std::vector<StrutModel>& models)
    : weights_(coupling), bars_(coupling.bars), gravity_(models.size(), LimitedMean(std::exp(-period / kMeanMemory))) {
  const int natural_period = naturalPeriod(models, period);
  for (const StrutModel& model : models) {
    models_.push_back(withoutMemories(model));
    travels_.emplace_back(period, model.stiffness_to_mass, natural_period);
  }
  recent_.set_capacity(static_cast<std::size_t>(TravelObserver::delayOf(natural_period)) + 1);
}

const VehicleSample* Decoupler::push(const VehicleSample& sample) {
  recent_.push_back(sample);
  for (std::size_t j = 0; j < models_.size(); ++j) {
    const auto place = static_cast<Eigen::Index>(j);
    gravity_[j].add(sample.sprung[place]);
    travels_[j].push(sample.unsprung[place] - sample.sprung[place]);
  }
  if (!travels_.front().full()) return nullptr;
  out_ = recent_.front();
  StrutVector moving = out_.sprung, modelled(out_.sprung.size()), stiffness = modelled, travel = modelled,
              slow = modelled;
  for (std::size_t j = 0; j < models_.size(); ++j) {
    const auto place = static_cast<Eigen::Index>(j);
    moving[place] -= gravity_[j].mean();
    travel[place] = travels_[j].travel();
    slow[place] = out_.unsprung[place] - out_.sprung[place] - travels_[j].acceleration();
    stiffness[place] = models_[j].stiffness_to_mass;
    modelled[place] = models_[j].force(travel[place], travels_[j].travelRate(), 0.0, kNoMemories.data());
  }
  // At its own strut, too, what a bar does is not the strut's.
  const StrutVector by_bars = ofBars(travel), slow_by_bars = ofBars(slow);
  const StrutVector neighbours = weights_.neighbours(moving, out_.forces, modelled + by_bars) + by_bars;
  const StrutVector unseen = weights_.leaked(stiffness.cwiseProduct(slow) + slow_by_bars) + slow_by_bars;
  out_.sprung -= neighbours;
  out_.unsprung -= neighbours - unseen.cwiseQuotient(stiffness);
  return &out_;
}

// @return sum over m of bar_im (x_i - x_m).
StrutVector Decoupler::ofBars(const StrutVector& travels) const {
  return bars_.rowwise().sum().cwiseProduct(travels) - bars_ * travels;
}

void Decoupler::startNewSeries() {
  recent_.clear();
  for (TravelObserver& travel : travels_) travel.startNewSeries();
}

}  // namespace suspension_health_monitor
