#include "suspension_health_monitor/internal/vehicle/decoupler.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kWashout = 1.0 / 50.0;  // of the natural frequency
constexpr double kMeanMemory = 10.0;     // [s]

constexpr std::array<double, kMostEffects> kNoMemories{};

}  // namespace

Decoupler::Strut::Strut(double period, double forgetting_factor)
    : travel(period), body(forgetting_factor), relative(forgetting_factor) {}

Decoupler::Decoupler(int num_struts, double period)
    : weights_(num_struts),
      struts_(static_cast<std::size_t>(num_struts), Strut(period, std::exp(-period / kMeanMemory))) {}

void Decoupler::setModel(int j, const StrutModel& model) {
  Strut& strut = struts_[static_cast<std::size_t>(j)];
  strut.model = withoutMemories(model);
  strut.travel.setWashout(kWashout * std::sqrt(std::max(0.0, model.stiffness_to_mass)));
}

const VehicleSample* Decoupler::push(const VehicleSample& sample) {
  recent_[size_++ % recent_.size()] = sample;
  StrutVector moving(sample.sprung.size()), modelled(sample.sprung.size());
  const VehicleSample& then = recent_[size_ > kDelay ? (size_ - 1 - kDelay) % recent_.size() : 0];
  for (std::size_t j = 0; j < struts_.size(); ++j) {
    const auto place = static_cast<Eigen::Index>(j);
    Strut& strut = struts_[j];
    const double relative = sample.unsprung[place] - sample.sprung[place];
    strut.body.add(sample.sprung[place]);
    strut.relative.add(relative);
    strut.travel.push(relative - strut.relative.mean());
    moving[place] = then.sprung[place] - strut.body.mean();
    modelled[place] = strut.model.force(strut.travel.travel(), strut.travel.travelRate(), 0.0, kNoMemories.data());
  }
  if (!struts_.front().travel.full()) return nullptr;
  const StrutVector neighbours = weights_.neighbours(moving, then.forces, modelled);
  out_ = then;
  out_.sprung -= neighbours;
  out_.unsprung -= neighbours;
  return &out_;
}

void Decoupler::startNewSeries() {
  size_ = 0;
  for (Strut& strut : struts_) strut.travel.startNewSeries();
}

}  // namespace suspension_health_monitor
