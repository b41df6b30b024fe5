#include "suspension_health_monitor/vehicle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "suspension_health_monitor/internal/fit/folded_motion.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"
#include "suspension_health_monitor/internal/vehicle/sensor_noise.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
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

int horizonFor(const StrutModel& model, double period) {
  const double horizon = proposeHorizon(model.damping_to_mass, model.stiffness_to_mass).horizon;
  return horizonSamples(horizon, period, IntegrationRule::kBandLimited);
}

/// @return by strut what the noise of the sensors becomes as the drives are separated.
StrutDrives separatedNoise(const VehicleDrive& drive, double period, const CouplingEstimate& estimate) {
  VehicleDrive noise(makeNoiseDrive(knownNoise(drive.noise, drive.struts.size()), period));
  for (const KnownForceRecord& force : drive.forces)
    noise.forces.push_back({force.name, std::vector<double>(noise.struts.front().samples.size(), 0.0)});
  return separateStruts(noise, period, estimate.coupling, estimate.models());
}

/// Struts with what is known of them, to be separated again as more is known.
class Separator {
 public:
  Separator(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
            const std::optional<double>& sample_period, const KnownModels& known = {})
      : drives_(checked(drives, names, known)),
        period_(sample_period ? *sample_period : medianPeriod(flattened(drives))),
        estimate_(coupleStruts(drives, period_)),
        coupling_(describe(estimate_, names, forceNames(drives.front()))),
        models_(estimate_.models()) {
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i]) models_[i] = *known[i];
    if (coupling_)
      noise_ = separatedNoise(drives.front(), period_, estimate_);
    else if (isUndersampled())
      coupling_.reason += kWheelsFolded;
  }

  const VehicleCoupling& coupling() const { return coupling_; }
  const std::vector<StrutModel>& models() const { return models_; }
  double period() const { return period_; }

  std::vector<LinearStrut> modelStddevs() const {
    std::vector<LinearStrut> stddevs;
    for (Eigen::Index i = 0; i < estimate_.own_stddevs.rows(); ++i)
      stddevs.push_back({estimate_.own_stddevs(i, 0), estimate_.own_stddevs(i, 1)});
    return stddevs;
  }

  void setModel(std::size_t strut, const StrutModel& model) { models_[strut] = model; }

  std::vector<std::vector<Drive>> separate() const {
    std::vector<std::vector<Drive>> struts(models_.size());
    for (const VehicleDrive& drive : drives_) {
      StrutDrives separated = separateStruts(drive, period_, estimate_.coupling, models_);
      for (std::size_t i = 0; i < struts.size(); ++i) struts[i].push_back(std::move(separated[i]));
    }
    for (std::size_t i = 0; i < struts.size(); ++i) struts[i].front().noise = noise_[i].samples;
    return struts;
  }

 private:
  bool isUndersampled() const {
    return std::any_of(drives_.begin(), drives_.end(), [&](const VehicleDrive& drive) {
      return std::any_of(drive.struts.begin(), drive.struts.end(), [&](const Drive& strut) {
        const DriveRecord record(strut, period_);
        return shareAtSamplingLimit({&record}) > kUndersampled;
      });
    });
  }

  const std::vector<VehicleDrive>& drives_;
  double period_;
  CouplingEstimate estimate_;
  VehicleCoupling coupling_;
  std::vector<StrutModel> models_;
  StrutDrives noise_;  // empty without a coupling
};

bool names(const Diagnosis& strut) {
  return strut && (strut.verdict == Verdict::kEffectFound || strut.verdict == Verdict::kSuspect);
}

// @return mean square that what was found explains [(m/s^2)^2].
double explainedPower(const Diagnosis& strut) {
  return strut.explained_share * strut.structured_share * strut.base.held_out_rmse * strut.base.held_out_rmse;
}

bool isAt(const AntiRollBarFound& bar, std::size_t strut) { return bar.first == strut || bar.second == strut; }

Verdict worstOf(const VehicleDiagnosis& found) {
  for (const Verdict verdict : {Verdict::kEffectFound, Verdict::kSuspect, Verdict::kUnexplained})
    for (std::size_t i = 0; i < found.struts.size(); ++i)
      if (found.verdictOn(i) == verdict) return verdict;
  return Verdict::kNothingMissing;
}

}  // namespace

SeparatedVehicle separateVehicle(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                 const std::optional<double>& sample_period, const KnownModels& models) {
  const Separator separator(drives, names, sample_period, models);
  SeparatedVehicle separated{separator.coupling(), {}, separator.models(), separator.modelStddevs()};
  if (separated.coupling) separated.struts = separator.separate();
  return separated;
}

std::vector<std::string> VehicleDiagnosis::selected(std::size_t strut) const {
  std::vector<std::string> names;
  for (const AntiRollBarFound& bar : coupling.bars)
    if (isAt(bar, strut)) names.emplace_back(kAntiRollBar);
  names.insert(names.end(), struts[strut].selected.begin(), struts[strut].selected.end());
  return names;
}

Verdict VehicleDiagnosis::verdictOn(std::size_t strut) const {
  const bool has_bar = std::any_of(coupling.bars.begin(), coupling.bars.end(),
                                   [&](const AntiRollBarFound& bar) { return isAt(bar, strut); });
  const Verdict own = struts[strut].verdict;
  return has_bar && own == Verdict::kNothingMissing ? Verdict::kEffectFound : own;
}

VehicleIdentification identifyVehicle(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                      const IdentifyOptions& options,
                                      const std::function<void(std::size_t strut, const MonitorReport&)>& report) {
  const Separator separator(drives, names, options.sample_period);
  VehicleIdentification result{separator.coupling(), {}};
  if (!result) return result;
  const auto separated = separator.separate();
  const std::vector<LinearStrut> stddevs = separator.modelStddevs();
  for (std::size_t i = 0; i < separated.size(); ++i) {
    IdentifyOptions strut = options;
    strut.sample_period = separator.period();
    if (report) strut.report = [&report, i](const MonitorReport& each) { report(i, each); };
    if (!options.horizon_samples) strut.horizon_samples = horizonFor(separator.models()[i], separator.period());
    IdentifyResult& identified = result.struts.emplace_back(identify(separated[i], strut));
    const auto [damping, stiffness] = stddevs[i];
    for (IdentifiedStrut* estimate : {&identified.ls, &identified.la, &identified.iv}) {
      estimate->damping_to_mass_stddev = std::hypot(estimate->damping_to_mass_stddev, damping);
      estimate->stiffness_to_mass_stddev = std::hypot(estimate->stiffness_to_mass_stddev, stiffness);
    }
  }
  return result;
}

VehicleDiagnosis diagnoseVehicle(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& strut_names,
                                 const DiagnoseOptions& options, const KnownModels& models) {
  Separator separator(drives, strut_names, options.sample_period, models);
  VehicleDiagnosis result;
  result.coupling = separator.coupling();
  if (!result) {
    result.summary = "The drives " + result.coupling.reason + ".";
    return result;
  }
  const std::size_t n = strut_names.size();
  result.struts.resize(n);
  result.drives.resize(n);
  std::vector<bool> settled(n, false);
  double done = 0.0;
  for (auto open = n; open > 0; --open) {
    auto separated = separator.separate();
    const double step = (1.0 - done) / (static_cast<double>(open) + 1.0);  // what another round takes is not known
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < n; ++i) {
      if (settled[i]) continue;
      DiagnoseOptions strut = options;
      strut.sample_period = separator.period();
      strut.model = models.empty() ? std::nullopt : models[i];
      if (options.progress) strut.progress = [&](double share) { options.progress(done + share * step); };
      result.struts[i] = diagnose(separated[i], strut);
      result.drives[i] = std::move(separated[i]);
      done += step;
      const Diagnosis& found = result.struts[i];
      if (found) separator.setModel(i, found.base.model);
      if (names(found) && (!best || explainedPower(found) > explainedPower(result.struts[*best]))) best = i;
    }
    if (!best) break;
    // What the others seem to lack may be this effect: they are judged anew without it.
    settled[*best] = true;
    separator.setModel(*best, result.struts[*best].model());
  }
  result.verdict = worstOf(result);
  result.summary = summaryOf(result, strut_names);
  if (options.progress) options.progress(1.0);
  return result;
}

}  // namespace suspension_health_monitor
