#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {

/// Struts with what is known of them, to be separated again as more is known.
struct Separator {
  /// @param drives  must outlive this object.
  Separator(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
            const std::optional<double>& sample_period, const KnownModels& known)
      : period(periodOf(drives, names, sample_period)), drives_(drives) {
    if (!known.empty() && known.size() != names.size())
      throw std::invalid_argument("models of " + std::to_string(known.size()) + " struts, must be of " +
                                  std::to_string(names.size()) + " or of none");
    learnRows(names);
    if (!coupling) {
      if (isUndersampled()) coupling.reason += kWheelsFolded;
      return;
    }
    models = rows_.models();
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i]) models[i] = *known[i];
    const SensorNoise& noise = drives.front().noise;
    noise_ = separateNoise(noise.empty() ? noiseOfOwnSensors(names.size()) : noise, period, rows_);
  }

  const double period;  ///< T [s]
  VehicleCoupling coupling;
  std::vector<StrutModel> models;  ///< by strut, that they are separated with

  /// @return true if one IMU tells of the tops of several struts.
  bool sharesNoise() const { return mostStrutsOfASensor(drives_.front().noise) > 1; }

  /// Fits the models of the struts that are meant to the drives as an estimator sees them, and takes them from then on.
  /// @return what was fitted, by strut; nothing where that failed, and of struts that are not meant.
  std::vector<std::optional<ModelFit>> fitModels(const std::function<bool(std::size_t strut)>& is_meant) {
    const std::vector<std::vector<Drive>> separated = separate(false);
    std::vector<std::optional<ModelFit>> fits(models.size());
    for (std::size_t i = 0; i < fits.size(); ++i) {
      if (!is_meant(i)) continue;
      const std::deque<DriveRecord> records = makeRecords(separated[i], period, models[i]);
      fits[i] = fitOutputError(pointersTo(records), {}, models[i]);
      if (fits[i]) models[i] = fits[i]->model;
    }
    return fits;
  }

  /// @param for_search  without what the models as they are now tell of the noise of shared sensors. Their errors are
  /// in there instead, of which an estimator's standard deviations would know nothing. The shared noise in one
  /// strut is estimated from all others.
  /// @return by strut and drive.
  std::vector<std::vector<Drive>> separate(bool for_search) const {
    const auto separated = [&](const VehicleDrive& drive) { return separateStruts(drive, period, rows_, models); };
    std::vector<StrutDrives> drives = mapped(drives_, separated);
    StrutDrives noise = noise_;
    if (for_search && sharesNoise()) takeSharedNoise(drives, noise, period, models);
    std::vector<std::vector<Drive>> struts(noise.size());
    for (std::size_t i = 0; i < struts.size(); ++i) {
      for (StrutDrives& drive : drives) struts[i].push_back(std::move(drive[i]));
      struts[i].front().noise = std::move(noise[i].samples);
    }
    return struts;
  }

 private:
  // A grid made the samples out of the readings, so that each strut seems to have two accelerometers of its own.
  void learnRows(const std::vector<std::string>& names) {
    VehicleChannels vehicle = VehicleChannels::ofAccelerometers(names.size(), drives_.front().forces.size());
    VehicleBlocks blocks(vehicle, period);
    for (const VehicleDrive& drive : drives_) {
      if (&drive != &drives_.front()) blocks.restart();
      for (std::size_t k = 0; k < drive.struts.front().samples.size(); ++k) blocks.push(sampleOf(drive, k));
    }
    const std::optional<BodyRows> rows = blocks.rowsOverTheDrive();
    const StrutPlaces& places = drives_.front().places;
    if (places.size() == names.size() &&
        static_cast<std::size_t>(mostStrutsOfASensor(drives_.front().noise)) == names.size())
      for (std::size_t i = 0; i < places.size(); ++i) {
        vehicle.struts[i].sprung.reset();
        vehicle.struts[i].position.emplace(places[i][0], places[i][1], 0.0);
      }
    const VehicleMistake mistake = blocks.claims(vehicle).find();
    if (!rows || !rows->areKnown() || mistake.isContradiction()) {
      coupling.reason = whyNotCoupled(mistake, names);
      return;
    }
    std::optional<BodyFitResult> body;
    if (names.size() > 1) body = fitRigidBody(*rows, places, blocks.rowsOfHalves());
    rows_ = body ? body->combined(*rows) : *rows;
    coupling = describe(rows_, body, namesOf(drives_.front().forces));
  }

  bool isUndersampled() const {
    return std::any_of(drives_.begin(), drives_.end(), [&](const VehicleDrive& drive) {
      return std::any_of(drive.struts.begin(), drive.struts.end(), [&](const Drive& strut) {
        const DriveRecord record(strut, period);
        return shareAtSamplingLimit({&record}) > kMostFolded;
      });
    });
  }

  const std::vector<VehicleDrive>& drives_;
  BodyRows rows_;
  StrutDrives noise_;  // empty without a coupling
};

}  // namespace suspension_health_monitor
