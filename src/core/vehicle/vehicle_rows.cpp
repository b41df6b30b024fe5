// What VehicleBlocks says of all blocks at once.
#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"

namespace suspension_health_monitor {

std::optional<WindowEstimate> VehicleBlocks::overTheDrive(std::size_t strut) {
  if (!has_model_ || doubts_[strut] != TopDoubt::kNone) return std::nullopt;
  std::optional<WindowEstimate> result = estimators_[strut].overTheDrive();
  const auto& all = estimators_[strut].ofAllBlocks();
  if (!result || !all) return std::nullopt;
  // Noise of wheels that move alike draws every block the same way: more blocks do not help.
  result->alike = std::max(result->alike, all->alike);
  for (const int i : {kBlockDamping, kBlockStiffness})
    result->covariance(i, i) += std::pow(all->alike * result->theta[i], 2);
  return result;
}

void VehicleBlocks::addRow(std::size_t strut, const WindowEstimate& estimate, BodyRows& rows) const {
  const auto n = static_cast<Eigen::Index>(tops_.size()), i = static_cast<Eigen::Index>(strut);
  if (rows.size() == 0) {
    rows.is_by_body = std::none_of(tops_.tops.begin(), tops_.tops.end(), [](const auto& top) { return top.has_own; });
    rows.rate.resize(n, n);
    rows.travel.resize(n, n);
  }
  std::vector<int> places(static_cast<std::size_t>(2 * n));
  for (std::size_t j = 0; j < tops_.size(); ++j)
    for (const std::size_t p : {0, 1}) {
      const int at = static_cast<int>(p) + (j == strut ? 0 : columns_.firstNeighbour() + neighbourColumn(strut, j));
      places[p * tops_.size() + j] = at;
      (p == 0 ? rows.rate : rows.travel)(i, static_cast<Eigen::Index>(j)) = estimate.theta[at];
    }
  Eigen::MatrixXd covariance(2 * n, 2 * n);
  for (Eigen::Index a = 0; a < 2 * n; ++a)
    for (Eigen::Index b = 0; b < 2 * n; ++b)
      covariance(a, b) = estimate.covariance(places[static_cast<std::size_t>(a)], places[static_cast<std::size_t>(b)]);
  rows.covariance.push_back(covariance);
}

std::optional<BodyRows> VehicleBlocks::rows() const {
  BodyRows rows;
  for (std::size_t i = 0; i < tops_.size(); ++i) {
    const auto& estimate = estimators_[i].ofAllBlocks();
    if (!estimate || !has_model_) return std::nullopt;
    addRow(i, *estimate, rows);
  }
  return rows;
}

std::vector<BodyRows> VehicleBlocks::rowsOfHalves() {
  std::vector<BodyRows> halves(2);
  for (std::size_t i = 0; i < tops_.size(); ++i) {
    // The block between both shares readings with each.
    const int count = (estimators_[i].count() - 1) / 2;
    for (const std::size_t half : {0, 1}) {
      const auto estimate = estimators_[i].ofBlocks(half == 0 ? estimators_[i].count() - count : 0, count);
      if (!estimate || !has_model_) return {};
      addRow(i, *estimate, halves[half]);
    }
  }
  return halves;
}

}  // namespace suspension_health_monitor
