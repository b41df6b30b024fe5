#include "suspension_health_monitor/internal/vehicle/separation.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "suspension_health_monitor/internal/signal/continuity.h"
#include "suspension_health_monitor/internal/vehicle/decoupler.h"

namespace suspension_health_monitor {
namespace {

/// Samples [from, to) of a drive without a gap.
struct Stretch {
  std::size_t from, to;
  std::size_t size() const { return to - from; }
};

std::vector<Stretch> stretchesOf(const Drive& drive, double period) {
  const auto& samples = drive.samples;
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const bool continues =
        k > 0 && continuity(samples[k].stamp - samples[k - 1].stamp, fromSeconds(period)) == Continuity::kContinues;
    if (!continues) stretches.push_back({k, k});
    stretches.back().to = k + 1;
  }
  return stretches;
}

void requireSameStamps(const StrutDrives& drive) {
  for (const Drive& strut : drive) {
    const auto same = [](const CornerSample& a, const CornerSample& b) { return a.stamp == b.stamp; };
    const auto& first = drive.front().samples;
    if (!std::equal(first.begin(), first.end(), strut.samples.begin(), strut.samples.end(), same))
      throw std::invalid_argument("the struts of a drive must have samples of the same stamps");
  }
}

}  // namespace

VehicleSample sampleOf(const StrutDrives& drive, std::size_t k) {
  const auto n = static_cast<Eigen::Index>(drive.size());
  VehicleSample sample{drive.front().samples[k].stamp, StrutVector(n), StrutVector(n), ForceVector(0)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const CornerSample& strut = drive[static_cast<std::size_t>(i)].samples[k];
    sample.sprung[i] = strut.sprung_acceleration;
    sample.unsprung[i] = strut.unsprung_acceleration;
  }
  return sample;
}

std::vector<std::vector<double>> rowsOf(const StrutMatrix& matrix) {
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(matrix.rows()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) rows[static_cast<std::size_t>(i)].push_back(matrix(i, j));
  return rows;
}

CouplingEstimate coupleStruts(const std::vector<StrutDrives>& drives, double period) {
  const int n = static_cast<int>(drives.front().size());
  CouplingSurvey survey(n, 0, period, std::numeric_limits<double>::infinity());
  for (const StrutDrives& drive : drives) {
    requireSameStamps(drive);
    for (const Stretch& stretch : stretchesOf(drive.front(), period)) {
      survey.startNewSeries();
      for (std::size_t k = stretch.from; k < stretch.to; ++k) survey.add(sampleOf(drive, k));
    }
  }
  return survey.solve();
}

StrutDrives separateStruts(const StrutDrives& drive, double period, const Coupling& coupling,
                           const std::vector<StrutModel>& models) {
  Decoupler decoupler(period, coupling, models);
  StrutDrives separated(drive.size());
  for (const Stretch& stretch : stretchesOf(drive.front(), period)) {
    decoupler.startNewSeries();
    for (std::size_t k = stretch.from; k < stretch.to; ++k) {
      const VehicleSample* own = decoupler.push(sampleOf(drive, k));
      if (own == nullptr) continue;
      for (std::size_t i = 0; i < drive.size(); ++i) {
        const auto place = static_cast<Eigen::Index>(i);
        separated[i].samples.push_back({own->stamp, own->sprung[place], own->unsprung[place]});
      }
    }
  }
  return separated;
}

}  // namespace suspension_health_monitor
