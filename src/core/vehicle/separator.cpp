#include "separator.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/text.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_blocks.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

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
    : drives_(drives), period_(periodOf(drives, names, sample_period)) {
  if (!known.empty() && known.size() != names.size())
    throw std::invalid_argument("models of " + std::to_string(known.size()) + " struts, must be of " +
                                std::to_string(names.size()) + " or of none");
  learnRows(names);
  if (!coupling_) {
    if (isUndersampled()) coupling_.reason += kWheelsFolded;
    return;
  }
  models_ = rows_.models();
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i]) models_[i] = *known[i];
  noise_ = separateNoise(knownNoise(drives.front().noise, names.size()), period_, rows_);
}

// Samples are what a grid made of the readings: every strut has two accelerometers, as it seems.
void Separator::learnRows(const std::vector<std::string>& names) {
  VehicleBlocks blocks(VehicleChannels::ofAccelerometers(names.size(), drives_.front().forces.size()), BlockOptions{},
                       period_);
  for (const VehicleDrive& drive : drives_) {
    if (&drive != &drives_.front()) blocks.restart();
    for (std::size_t k = 0; k < drive.struts.front().samples.size(); ++k) blocks.push(sampleOf(drive, k));
  }
  const std::optional<BodyRows> rows = blocks.rowsOverTheDrive();
  const auto of_body_imu = static_cast<std::size_t>(mostStrutsOfASensor(drives_.front().noise));
  const VehicleMistake mistake =
      blocks.claims(of_body_imu == names.size() ? drives_.front().places : StrutPlaces{}).find();
  const bool are_known = rows && rows->areKnown() && !mistake.isContradiction();
  std::optional<BodyFitResult> body;
  if (are_known) {
    if (names.size() > 1) body = BodyFit::of(names.size(), drives_.front().places).fit(*rows, blocks.rowsOfHalves());
    rows_ = body ? body->combined(*rows) : *rows;
  }
  coupling_ = describe(are_known ? &rows_ : nullptr, body, are_known ? "" : whyNotCoupled(mistake, names),
                       namesOf(drives_.front().forces));
}

bool Separator::sharesNoise() const { return mostStrutsOfASensor(drives_.front().noise) > 1; }

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

std::vector<std::vector<Drive>> Separator::separate() const { return byStrut(separateAll(), noise_); }

// What shared noise does to one strut is told from all others.
std::vector<std::vector<Drive>> Separator::separateForSearch() const {
  std::vector<StrutDrives> drives = separateAll();
  StrutDrives noise = noise_;
  if (sharesNoise()) takeSharedNoise(drives, noise, period_, models_);
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

std::vector<StrutDrives> Separator::separateAll() const {
  std::vector<StrutDrives> separated;
  for (const VehicleDrive& drive : drives_) separated.push_back(separateStruts(drive, period_, rows_, models_));
  return separated;
}

}  // namespace suspension_health_monitor
