#include "suspension_health_monitor/internal/vehicle/neighbour_weights.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace suspension_health_monitor {
namespace {

// Share of a neighbour's force that its model may miss: so much of it must not reach others.
constexpr double kUnmodelled = 0.2;

}  // namespace

NeighbourWeights::NeighbourWeights(const Coupling& coupling)
    : combination_(coupling.ratios), leak_(coupling.ratios), estimate_(coupling.ratios), coupling_(coupling) {
  const Eigen::Index n = coupling.numStruts();
  for (Eigen::Index i = 0; i < n; ++i) {
    StrutMatrix unwanted = coupling.rest_power * StrutMatrix::Identity(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      if (j == i) continue;
      const double power = kUnmodelled * kUnmodelled * coupling.own_power[j];
      unwanted += power * coupling.ratios.col(j) * coupling.ratios.col(j).transpose();
    }
    const StrutVector direction = unwanted.ldlt().solve(coupling.ratios.col(i));
    combination_.row(i) = direction.transpose() / direction.dot(coupling.ratios.col(i));
  }
  leak_ = combination_ * coupling.ratios;
  leak_.diagonal().setZero();
  const StrutMatrix crossed = coupling.own_power.asDiagonal() * coupling.ratios.transpose();
  const StrutMatrix of_all = coupling.ratios * crossed + coupling.rest_power * StrutMatrix::Identity(n, n);
  estimate_ = of_all.ldlt().solve(crossed.transpose()).transpose();
}

StrutVector NeighbourWeights::ofStruts(const StrutVector& moving, const ForceVector& forces) const {
  StrutVector of_struts = moving;
  if (coupling_.forces.cols() > 0) of_struts -= coupling_.forces * forces;
  return of_struts;
}

StrutVector NeighbourWeights::neighbours(const StrutVector& moving, const ForceVector& forces,
                                         const StrutVector& modelled) const {
  return moving - combination_ * ofStruts(moving, forces) + leak_ * modelled;
}

StrutModel withoutMemories(StrutModel model) {
  auto& effects = model.effects;
  const auto has_memory = [](const ActiveEffect& active) { return static_cast<bool>(active.effect.memory_rate); };
  effects.erase(std::remove_if(effects.begin(), effects.end(), has_memory), effects.end());
  return model;
}

}  // namespace suspension_health_monitor
