#include "suspension_health_monitor/internal/vehicle/separation.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "suspension_health_monitor/internal/signal/continuity.h"
#include "suspension_health_monitor/internal/vehicle/decoupler.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

// Leads a drive, series by series.
template <class Begin, class Take>
void replay(const StrutDrives& drive, double period, const Begin& begin_series, const Take& take) {
  const auto& samples = drive.front().samples;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k == 0 || continuity(samples[k].stamp - samples[k - 1].stamp, fromSeconds(period)) != Continuity::kContinues)
      begin_series();
    take(sampleOf(drive, k));
  }
}

void requireSameStamps(const StrutDrives& drive) {
  for (const Drive& strut : drive) {
    const auto same = [](const CornerSample& a, const CornerSample& b) { return a.stamp == b.stamp; };
    const auto& first = drive.front().samples;
    if (!std::equal(first.begin(), first.end(), strut.samples.begin(), strut.samples.end(), same))
      throw std::invalid_argument("the struts of a drive must have samples of the same stamps");
  }
}

std::vector<std::vector<double>> rowsOf(const StrutMatrix& matrix) {
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(matrix.rows()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) rows[static_cast<std::size_t>(i)].push_back(matrix(i, j));
  return rows;
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

VehicleCoupling describe(const CouplingEstimate& estimate, const std::vector<std::string>& names) {
  VehicleCoupling coupling;
  coupling.ratios = rowsOf(estimate.coupling.ratios);
  coupling.stddevs = rowsOf(estimate.stddevs);
  coupling.condition = estimate.condition;
  const StrutMatrix& bars = estimate.coupling.bars;
  for (Eigen::Index i = 0; i < bars.rows(); ++i)
    for (Eigen::Index j = i + 1; j < bars.rows(); ++j)
      if (bars(i, j) != 0.0)
        coupling.bars.push_back({static_cast<std::size_t>(i), static_cast<std::size_t>(j), bars(i, j), bars(j, i)});
  coupling.reason = reasonOf(estimate, names);
  return coupling;
}

CouplingEstimate coupleStruts(const std::vector<StrutDrives>& drives, double period, const SensorNoise& noise) {
  const int n = static_cast<int>(drives.front().size());
  CouplingSurvey survey(n, 0, period, std::numeric_limits<double>::infinity(), noise);
  for (const StrutDrives& drive : drives) {
    requireSameStamps(drive);
    replay(
        drive, period, [&] { survey.startNewSeries(); }, [&](const VehicleSample& sample) { survey.add(sample); });
  }
  return survey.solve();
}

StrutDrives separateStruts(const StrutDrives& drive, double period, const Coupling& coupling,
                           const std::vector<StrutModel>& models) {
  Decoupler decoupler(period, coupling, models);
  StrutDrives separated(drive.size());
  replay(
      drive, period, [&] { decoupler.startNewSeries(); },
      [&](const VehicleSample& sample) {
        const VehicleSample* own = decoupler.push(sample);
        for (std::size_t i = 0; own != nullptr && i < separated.size(); ++i)
          separated[i].samples.push_back(own->ofStrut(i));
      });
  return separated;
}

}  // namespace suspension_health_monitor
