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

LimitedMean slowMean(double period) { return LimitedMean(std::exp(-period / kMeanMemory)); }

// That of the slowest strut [samples], even.
int naturalPeriod(const std::vector<StrutModel>& models, double period) {
  double slowest = 0.0;
  for (const StrutModel& model : models) slowest = std::max(slowest, 2.0 * kPi / std::sqrt(model.stiffness_to_mass));
  return 2 * std::max(1, static_cast<int>(std::lround(std::min(slowest, kLongest) / (2.0 * period))));
}

}  // namespace

Decoupler::Decoupler(double period, const Coupling& coupling, const std::vector<StrutModel>& models)
    : weights_(coupling),
      bars_(coupling.bars),
      gravity_(models.size(), slowMean(period)),
      force_means_(static_cast<std::size_t>(coupling.forces.cols()), slowMean(period)) {
  const int natural_period = naturalPeriod(models, period);
  for (const StrutModel& model : models) {
    models_.push_back(withoutMemories(model));
    travels_.emplace_back(period, model.stiffness_to_mass, natural_period);
    slow_.emplace_back(period, natural_period);
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
  for (std::size_t k = 0; k < force_means_.size(); ++k)
    force_means_[k].add(sample.forces[static_cast<Eigen::Index>(k)]);
  observeSlowParts();
  if (!travels_.front().full()) return nullptr;
  out_ = recent_.front();
  StrutVector modelled(out_.sprung.size()), by_bars(out_.sprung.size());
  for (std::size_t j = 0; j < models_.size(); ++j) {
    const auto place = static_cast<Eigen::Index>(j);
    by_bars[place] = 0.0;
    for (std::size_t m = 0; m < models_.size(); ++m)
      by_bars[place] += bars_(place, static_cast<Eigen::Index>(m)) * (travels_[j].travel() - travels_[m].travel());
    modelled[place] =
        models_[j].force(travels_[j].travel(), travels_[j].travelRate(), 0.0, kNoMemories.data()) + slow_[j].value();
  }
  // At its own strut, too, what a bar does is not the strut's.
  const StrutVector neighbours = weights_.neighbours(moving(out_), movingForces(out_), modelled + by_bars) + by_bars;
  out_.sprung -= neighbours;
  out_.unsprung -= neighbours;
  return &out_;
}

// As late as the travel before it is freed of what is slow.
void Decoupler::observeSlowParts() {
  constexpr std::size_t kLate = BandlimitedInterpolator::kHalfWidth;
  if (recent_.size() <= kLate) return;
  const VehicleSample& sample = recent_[recent_.size() - 1 - kLate];
  const StrutVector own = weights_.ownOf(moving(sample), movingForces(sample));
  for (std::size_t j = 0; j < slow_.size(); ++j) slow_[j].push(own[static_cast<Eigen::Index>(j)]);
}

// Without gravity and offsets.
StrutVector Decoupler::moving(const VehicleSample& sample) const {
  StrutVector moving = sample.sprung;
  for (std::size_t j = 0; j < gravity_.size(); ++j) moving[static_cast<Eigen::Index>(j)] -= gravity_[j].mean();
  return moving;
}

ForceVector Decoupler::movingForces(const VehicleSample& sample) const {
  ForceVector moving = sample.forces;
  for (std::size_t k = 0; k < force_means_.size(); ++k) moving[static_cast<Eigen::Index>(k)] -= force_means_[k].mean();
  return moving;
}

void Decoupler::startNewSeries() {
  recent_.clear();
  for (TravelObserver& travel : travels_) travel.startNewSeries();
  for (SlowMean& slow : slow_) slow.reset();
}

}  // namespace suspension_health_monitor
