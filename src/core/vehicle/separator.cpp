#include "separator.h"

#include <algorithm>
#include <deque>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/fit/folded_motion.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/vehicle/sensor_noise.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/shared_noise.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

std::vector<Drive> flattened(const std::vector<VehicleDrive>& drives) {
  std::vector<Drive> all;
  for (const VehicleDrive& drive : drives) all.push_back(drive.struts.front());
  return all;
}

const std::vector<VehicleDrive>& checked(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                         const KnownModels& known) {
  if (drives.empty()) throw std::invalid_argument("no drive is given, must be one or more");
  requireNumStruts(names.size());
  requireNumKnownForces(drives.front().forces.size());
  for (const VehicleDrive& drive : drives) {
    if (drive.struts.size() != names.size())
      throw std::invalid_argument("a drive of " + std::to_string(drive.struts.size()) + " struts, must be " +
                                  std::to_string(names.size()));
    if (forceNames(drive) != forceNames(drives.front()))
      throw std::invalid_argument("a drive with the known forces [" + join(forceNames(drive)) + "], must be [" +
                                  join(forceNames(drives.front())) + "] as in the first");
  }
  if (!known.empty() && known.size() != names.size())
    throw std::invalid_argument("models of " + std::to_string(known.size()) + " struts, must be of " +
                                std::to_string(names.size()) + " or of none");
  return drives;
}

std::vector<std::vector<Drive>> byStrut(std::vector<StrutDrives> drives, StrutDrives noise) {
  std::vector<std::vector<Drive>> struts(noise.size());
  for (std::size_t i = 0; i < struts.size(); ++i) {
    for (StrutDrives& drive : drives) struts[i].push_back(std::move(drive[i]));
    struts[i].front().noise = std::move(noise[i].samples);
  }
  return struts;
}

}  // namespace

Separator::Separator(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                     const std::optional<double>& sample_period, const KnownModels& known)
    : drives_(checked(drives, names, known)),
      period_(sample_period ? *sample_period : medianPeriod(flattened(drives))),
      estimate_(coupleStruts(drives, period_)),
      coupling_(describe(estimate_, names, forceNames(drives.front()))),
      models_(estimate_.models()) {
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i]) models_[i] = *known[i];
  if (coupling_)
    noise_ = separateNoise(knownNoise(drives.front().noise, names.size()), period_, estimate_);
  else if (isUndersampled())
    coupling_.reason += kWheelsFolded;
}

std::vector<LinearStrut> Separator::modelStddevs() const {
  std::vector<LinearStrut> stddevs;
  for (Eigen::Index i = 0; i < estimate_.own_stddevs.rows(); ++i)
    stddevs.push_back({estimate_.own_stddevs(i, 0), estimate_.own_stddevs(i, 1)});
  return stddevs;
}

bool Separator::sharesNoise() const { return sharesSensors(drives_.front().noise); }

std::vector<std::optional<ModelFit>> Separator::fitModels(const std::vector<std::size_t>& struts) {
  const std::vector<std::vector<Drive>> separated = separate();
  std::vector<std::optional<ModelFit>> fits;
  for (const std::size_t i : struts) {
    const std::deque<DriveRecord> records = makeRecords(separated[i], period_, models_[i]);
    fits.emplace_back(fitOutputError(pointersTo(records), {}, models_[i]));
    if (fits.back()) models_[i] = fits.back()->model;
  }
  return fits;
}

std::vector<std::vector<Drive>> Separator::separate() const { return byStrut(separateAll(estimate_.coupling), noise_); }

// What shared noise does to one strut is told from all others, so that none of it has to be kept out before: then as
// much of the neighbours is as can be, and no law that one of them lacks is carried over.
std::vector<std::vector<Drive>> Separator::separateForSearch() const {
  if (!sharesNoise()) return separate();
  CouplingEstimate estimate = estimate_;
  StrutMatrix& rest = estimate.coupling.rest;
  rest = rest.diagonal().minCoeff() * StrutMatrix::Identity(rest.rows(), rest.cols());
  std::vector<StrutDrives> drives = separateAll(estimate.coupling);
  StrutDrives noise = separateNoise(drives_.front().noise, period_, estimate);
  takeSharedNoise(drives, noise, period_, models_);
  return byStrut(std::move(drives), std::move(noise));
}

bool Separator::isUndersampled() const {
  return std::any_of(drives_.begin(), drives_.end(), [&](const VehicleDrive& drive) {
    return std::any_of(drive.struts.begin(), drive.struts.end(), [&](const Drive& strut) {
      const DriveRecord record(strut, period_);
      return shareAtSamplingLimit({&record}) > kMostFolded;
    });
  });
}

std::vector<StrutDrives> Separator::separateAll(const Coupling& coupling) const {
  std::vector<StrutDrives> separated;
  for (const VehicleDrive& drive : drives_) separated.push_back(separateStruts(drive, period_, coupling, models_));
  return separated;
}

}  // namespace suspension_health_monitor
