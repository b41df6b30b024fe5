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

void fill(const StrutDrives& drive, std::size_t k, VehicleSample& sample) {
  const auto n = static_cast<Eigen::Index>(drive.size());
  sample.stamp = drive.front().samples[k].stamp;
  sample.sprung.resize(n);
  sample.unsprung.resize(n);
  sample.forces.resize(0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CornerSample& strut = drive[static_cast<std::size_t>(i)].samples[k];
    sample.sprung[i] = strut.sprung_acceleration;
    sample.unsprung[i] = strut.unsprung_acceleration;
  }
}

}  // namespace

CouplingEstimate coupleStruts(const std::vector<StrutDrives>& drives, double period) {
  const int n = static_cast<int>(drives.front().size());
  CouplingSurvey survey(n, 0, period, std::numeric_limits<double>::infinity());
  VehicleSample sample;
  for (const StrutDrives& drive : drives) {
    requireSameStamps(drive);
    for (const Stretch& stretch : stretchesOf(drive.front(), period)) {
      survey.startNewSeries();
      for (std::size_t k = stretch.from; k < stretch.to; ++k) {
        fill(drive, k, sample);
        survey.add(sample);
      }
    }
  }
  return survey.solve();
}

StrutDrives separateStruts(const StrutDrives& drive, double period, const Coupling& coupling,
                           const std::vector<StrutModel>& models) {
  Decoupler decoupler(period, coupling, models);
  StrutDrives separated(drive.size());
  VehicleSample sample;
  for (const Stretch& stretch : stretchesOf(drive.front(), period)) {
    decoupler.startNewSeries();
    for (std::size_t k = stretch.from; k < stretch.to; ++k) {
      fill(drive, k, sample);
      const VehicleSample* own = decoupler.push(sample);
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
