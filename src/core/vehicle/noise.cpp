#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <random>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/strut_tops.h"
#include "suspension_health_monitor/internal/vehicle/tuning.h"

namespace suspension_health_monitor {
SensorNoise noiseOfOwnSensors(std::size_t num_struts) {
  SensorNoise noise;
  for (std::size_t i = 0; i < num_struts; ++i)
    for (const CornerSample wrong : {CornerSample{{}, 1.0, 0.0}, CornerSample{{}, 0.0, 1.0}}) {
      StrutDrives& response = noise.emplace_back(num_struts, Drive{{CornerSample{}}});
      response[i].samples.front() = wrong;
    }
  return noise;
}

SensorNoise noiseOfStrutTops(const VehicleChannels& channels, Stamp period, double gyro_noise) {
  SensorNoise noise;
  std::size_t num_streams = channels.body_imu ? *channels.body_imu + 6 : 0;
  for (const VehicleChannels::Strut& strut : channels.struts)
    num_streams = std::max({num_streams, strut.unsprung + 1, strut.sprung.value_or(0) + 1});
  for (const std::size_t force : channels.known_forces) num_streams = std::max(num_streams, force + 1);
  const StrutTops still(period, channels);
  const int fill = 2 * still.delay();
  // What follows one wrong reading of a stream.
  const auto add = [&](std::size_t stream, double deviation) {
    StrutDrives& response = noise.emplace_back(channels.struts.size());
    StrutTops tops = still;
    for (int k = 0; k <= 2 * fill; ++k) {
      GridInstant instant{k * period, std::vector<double>(num_streams, 0.0), std::vector<bool>(num_streams, true)};
      if (k == fill) instant.values[stream] = kDifferenceStep;
      const VehicleSample* sample = tops.push(instant);
      for (std::size_t i = 0; sample != nullptr && i < response.size(); ++i) {
        CornerSample& of_strut = response[i].samples.emplace_back(sample->ofStrut(i));
        of_strut.sprung_acceleration *= deviation / kDifferenceStep;
        of_strut.unsprung_acceleration *= deviation / kDifferenceStep;
      }
    }
  };
  for (const VehicleChannels::Strut& strut : channels.struts) {
    add(strut.unsprung, 1.0);
    if (strut.sprung) add(*strut.sprung, 1.0);
  }
  for (std::size_t axis = 0; channels.numTopsOfBody() > 0 && axis < 6; ++axis)
    add(*channels.body_imu + axis, axis < 3 ? 1.0 : gyro_noise);
  return noise;
}

std::ptrdiff_t mostStrutsOfASensor(const SensorNoise& noise) {
  const auto shows = [](const Drive& strut) {
    return std::any_of(strut.samples.begin(), strut.samples.end(), [](const CornerSample& sample) {
      return sample.sprung_acceleration != 0.0 || sample.unsprung_acceleration != 0.0;
    });
  };
  std::ptrdiff_t most = 0;
  for (const StrutDrives& response : noise)
    most = std::max(most, std::count_if(response.begin(), response.end(), shows));
  return most;
}

StrutDrives makeNoiseDrive(const SensorNoise& noise, double period) {
  StrutDrives drive(noise.front().size());
  for (Drive& strut : drive)
    for (std::size_t k = 0; k < kVehicleTuning.noise_drive; ++k)
      strut.samples.push_back({static_cast<int>(k) * fromSeconds(period), 0.0, 0.0});
  std::mt19937_64 engine;
  std::normal_distribution<double> normal;
  for (const StrutDrives& response : noise) {
    const std::size_t length = response.front().samples.size();
    std::vector<double> readings(kVehicleTuning.noise_drive + length - 1);
    for (double& reading : readings) reading = normal(engine);
    for (std::size_t i = 0; i < drive.size(); ++i)
      for (std::size_t k = 0; k < kVehicleTuning.noise_drive; ++k)
        for (std::size_t l = 0; l < length; ++l) {
          const CornerSample& after = response[i].samples[l];
          CornerSample& sample = drive[i].samples[k];
          sample.sprung_acceleration += readings[k + l] * after.sprung_acceleration;
          sample.unsprung_acceleration += readings[k + l] * after.unsprung_acceleration;
        }
  }
  return drive;
}

namespace {

/// What a strut's free run leaves, sample by sample of a drive.
struct Remainder {
  Eigen::VectorXd values;          ///< 0 where nothing is known
  std::vector<Eigen::Index> room;  ///< known ones to either side and this one; 0: not known itself
};

std::optional<Remainder> remainderBy(const StrutModel& model, const Drive& drive, double period) {
  const std::deque<DriveRecord> records = makeRecords({drive}, period, model);
  const auto initial = estimateInitialStates(pointersTo(records), model);
  if (!initial) return std::nullopt;
  Remainder remainder{Eigen::VectorXd::Zero(drive.samples.size()), std::vector<Eigen::Index>(drive.samples.size(), 0)};
  std::vector<double> predicted;
  std::size_t at = 0, s = 0;
  for (const DriveSegment* segment : segmentsOf(pointersTo(records))) {
    if (!runFree(model, *segment, (*initial)[s++], predicted)) return std::nullopt;
    while (drive.samples[at].stamp != segment->stamps.front()) ++at;
    for (std::size_t k = 0; k < segment->size(); ++k, ++at) {
      remainder.values[at] = segment->sprung[k] - predicted[k];
      remainder.room[at] = 1 + std::min(k, segment->size() - 1 - k);
    }
  }
  return remainder;
}

/// Of all struts of a drive; empty if a model runs away.
std::vector<Remainder> remaindersOf(const StrutDrives& drive, double period, const std::vector<StrutModel>& models) {
  std::vector<Remainder> all;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    std::optional<Remainder> remainder = remainderBy(models[i], drive[i], period);
    if (!remainder) return {};
    all.push_back(std::move(*remainder));
  }
  return all;
}

/// E[a(k) b(k + lag)] by a, b and lag, from -most to most.
using Covariances = std::vector<std::vector<Eigen::VectorXd>>;

Covariances covariancesOf(const std::vector<Remainder>& noise, Eigen::Index most) {
  const Eigen::Index size = noise.front().values.size(), inner = size - 2 * most;
  Covariances covariances(noise.size(), std::vector<Eigen::VectorXd>(noise.size(), Eigen::VectorXd(2 * most + 1)));
  for (std::size_t a = 0; a < noise.size(); ++a)
    for (std::size_t b = 0; b < noise.size(); ++b)
      for (Eigen::Index lag = 0; lag <= 2 * most; ++lag)
        covariances[a][b][lag] =
            noise[a].values.segment(most, inner).dot(noise[b].values.segment(lag, inner)) / static_cast<double>(size);
  return covariances;
}

/// h of one strut: a column for each of the others, rows l = -reach .. reach.
using Weights = Eigen::MatrixXd;

Weights weightsOf(std::size_t strut, const Covariances& covariances, Eigen::Index reach) {
  std::vector<std::size_t> others;
  for (std::size_t j = 0; j < covariances.size(); ++j)
    if (j != strut) others.push_back(j);
  const Eigen::Index middle = 2 * reach, lags = 2 * reach + 1, unknowns = lags * others.size();  // middle: lag 0
  Eigen::MatrixXd moments(unknowns, unknowns);
  Eigen::VectorXd target(unknowns);
  for (Eigen::Index a = 0; a < unknowns; ++a) {
    const std::size_t of_a = others[a / lags];
    target[a] = covariances[of_a][strut][middle + reach - a % lags];
    for (Eigen::Index b = 0; b < unknowns; ++b)
      moments(a, b) = covariances[of_a][others[b / lags]][middle + b % lags - a % lags];
  }
  moments.diagonal().array() += kVehicleTuning.model_variance;
  const Eigen::VectorXd solution = solveSymmetric(moments, target);
  return Eigen::Map<const Weights>(solution.data(), lags, others.size());
}

/// @return the samples of which all is known that the others tell of their noise, without it.
Drive without(const Weights& weights, std::size_t strut, const Drive& drive, const std::vector<Remainder>& remainder) {
  const Eigen::Index reach = weights.rows() / 2;
  Drive cleaned;
  cleaned.low_pass.taps = drive.low_pass.taps;
  for (std::size_t k = 0; k < drive.samples.size(); ++k) {
    double predicted = 0.0;
    bool is_known = true;
    Eigen::Index column = 0;
    for (std::size_t j = 0; j < remainder.size() && is_known; ++j) {
      if (j == strut) continue;
      is_known = remainder[j].room[k] > reach;
      if (is_known) predicted += weights.col(column++).dot(remainder[j].values.segment(k - reach, weights.rows()));
    }
    if (!is_known) continue;
    cleaned.samples.push_back(drive.samples[k]);
    cleaned.samples.back().sprung_acceleration -= predicted;
    if (!drive.low_pass.unfiltered.empty()) cleaned.low_pass.unfiltered.push_back(drive.low_pass.unfiltered[k]);
  }
  return cleaned;
}

}  // namespace

void takeSharedNoise(std::vector<StrutDrives>& drives, StrutDrives& noise, double period,
                     const std::vector<StrutModel>& models) {
  std::vector<StrutModel> linear;
  for (const StrutModel& model : models) linear.push_back({model.damping_to_mass, model.stiffness_to_mass, {}, {}});
  const std::vector<Remainder> of_noise = remaindersOf(noise, period, linear);
  const auto of_drives = mapped(drives, [&](const StrutDrives& drive) { return remaindersOf(drive, period, models); });
  const auto runs_away = [](const std::vector<Remainder>& remainder) { return remainder.empty(); };
  if (runs_away(of_noise) || std::any_of(of_drives.begin(), of_drives.end(), runs_away)) return;
  const Eigen::Index reach = std::lround(kVehicleTuning.noise_reach / period);
  const Covariances covariances = covariancesOf(of_noise, 2 * reach);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const Weights weights = weightsOf(i, covariances, reach);
    for (std::size_t d = 0; d < drives.size(); ++d) drives[d][i] = without(weights, i, drives[d][i], of_drives[d]);
    noise[i] = without(weights, i, noise[i], of_noise);
  }
}

}  // namespace suspension_health_monitor
