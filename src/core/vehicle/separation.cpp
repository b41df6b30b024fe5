#include "suspension_health_monitor/internal/vehicle/separation.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "suspension_health_monitor/internal/signal/continuity.h"
#include "suspension_health_monitor/internal/vehicle/decoupler.h"
#include "suspension_health_monitor/internal/vehicle/sensor_noise.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

// Leads a drive, series by series.
template <class Begin, class Take>
void replay(const VehicleDrive& drive, double period, const Begin& begin_series, const Take& take) {
  const auto& samples = drive.struts.front().samples;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k == 0 || continuity(samples[k].stamp - samples[k - 1].stamp, fromSeconds(period)) != Continuity::kContinues)
      begin_series();
    take(sampleOf(drive, k));
  }
}

void requireOneGrid(const VehicleDrive& drive) {
  const auto& first = drive.struts.front().samples;
  for (const Drive& strut : drive.struts) {
    const auto same = [](const CornerSample& a, const CornerSample& b) { return a.stamp == b.stamp; };
    if (!std::equal(first.begin(), first.end(), strut.samples.begin(), strut.samples.end(), same))
      throw std::invalid_argument("the struts of a drive must have samples of the same stamps");
    strut.low_pass.validate(first.size());
    if (strut.low_pass.taps != drive.struts.front().low_pass.taps)
      throw std::invalid_argument("the struts of a drive must have passed the same filter");
  }
  for (const KnownForceRecord& force : drive.forces)
    if (force.values.size() != first.size())
      throw std::invalid_argument("force " + force.name + " has " + std::to_string(force.values.size()) +
                                  " values, must have one for each of " + std::to_string(first.size()) + " samples");
}

std::vector<double> columnOf(const ForceMatrix& matrix, std::size_t column) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) values.push_back(matrix(i, static_cast<Eigen::Index>(column)));
  return values;
}

std::vector<std::vector<double>> rowsOf(const StrutMatrix& matrix) {
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(matrix.rows()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) rows[static_cast<std::size_t>(i)].push_back(matrix(i, j));
  return rows;
}

}  // namespace

VehicleSample sampleOf(const VehicleDrive& drive, std::size_t k) {
  const auto n = static_cast<Eigen::Index>(drive.struts.size());
  VehicleSample sample{drive.struts.front().samples[k].stamp, StrutVector(n), StrutVector(n),
                       ForceVector(static_cast<Eigen::Index>(drive.forces.size())),
                       StrutVector(drive.struts.front().low_pass.unfiltered.empty() ? 0 : n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const CornerSample& strut = drive.struts[static_cast<std::size_t>(i)].samples[k];
    sample.sprung[i] = strut.sprung_acceleration;
    sample.unsprung[i] = strut.unsprung_acceleration;
    if (sample.unfiltered.size() > 0)
      sample.unfiltered[i] = drive.struts[static_cast<std::size_t>(i)].low_pass.unfiltered[k];
  }
  for (Eigen::Index i = 0; i < sample.forces.size(); ++i)
    sample.forces[i] = drive.forces[static_cast<std::size_t>(i)].values[k];
  return sample;
}

void append(const VehicleSample& sample, VehicleDrive& drive) {
  for (std::size_t i = 0; i < drive.struts.size(); ++i) {
    drive.struts[i].samples.push_back(sample.ofStrut(i));
    if (sample.unfiltered.size() > 0)
      drive.struts[i].low_pass.unfiltered.push_back(sample.unfiltered[static_cast<Eigen::Index>(i)]);
  }
  for (std::size_t k = 0; k < drive.forces.size(); ++k)
    drive.forces[k].values.push_back(sample.forces[static_cast<Eigen::Index>(k)]);
}

std::vector<std::string> forceNames(const VehicleDrive& drive) {
  std::vector<std::string> names;
  for (const KnownForceRecord& force : drive.forces) names.push_back(force.name);
  return names;
}

VehicleCoupling describe(const CouplingEstimate& estimate, const std::vector<std::string>& names,
                         const std::vector<std::string>& forces) {
  VehicleCoupling coupling;
  coupling.ratios = rowsOf(estimate.coupling.ratios);
  coupling.stddevs = rowsOf(estimate.stddevs);
  coupling.condition = estimate.condition;
  const StrutMatrix& bars = estimate.coupling.bars;
  for (const auto& [i, j] : estimate.bars())
    coupling.bars.push_back({static_cast<std::size_t>(i), static_cast<std::size_t>(j), bars(i, j), bars(j, i)});
  for (std::size_t k = 0; k < forces.size(); ++k)
    coupling.forces.push_back({forces[k], columnOf(estimate.coupling.forces, k), columnOf(estimate.force_stddevs, k)});
  coupling.reason = reasonOf(estimate, names);
  return coupling;
}

CouplingEstimate coupleStruts(const std::vector<VehicleDrive>& drives, double period) {
  const VehicleDrive& first = drives.front();
  CouplingSurvey survey({static_cast<int>(first.struts.size()), static_cast<int>(first.forces.size())}, period,
                        std::numeric_limits<double>::infinity(), knownNoise(first.noise, first.struts.size()));
  for (const VehicleDrive& drive : drives) {
    requireOneGrid(drive);
    replay(
        drive, period, [&] { survey.startNewSeries(); }, [&](const VehicleSample& sample) { survey.add(sample); });
  }
  return survey.solve();
}

StrutDrives separateStruts(const VehicleDrive& drive, double period, const Coupling& coupling,
                           const std::vector<StrutModel>& models) {
  Decoupler decoupler(period, coupling, models, drive.struts.front().low_pass.taps);
  VehicleDrive separated{StrutDrives(drive.struts.size())};
  for (std::size_t i = 0; i < drive.struts.size(); ++i)
    separated.struts[i].low_pass.taps = drive.struts[i].low_pass.taps;
  replay(
      drive, period, [&] { decoupler.startNewSeries(); },
      [&](const VehicleSample& sample) {
        if (const VehicleSample* own = decoupler.push(sample)) append(*own, separated);
      });
  return separated.struts;
}

// Known forces have none.
StrutDrives separateNoise(const SensorNoise& noise, double period, const CouplingEstimate& estimate) {
  VehicleDrive drive(makeNoiseDrive(noise, period));
  const std::vector<double> still(drive.struts.front().samples.size(), 0.0);
  drive.forces.assign(static_cast<std::size_t>(estimate.coupling.forces.cols()), {"", still});
  return separateStruts(drive, period, estimate.coupling, estimate.models());
}

}  // namespace suspension_health_monitor
