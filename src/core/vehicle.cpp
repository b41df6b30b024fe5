#include "suspension_health_monitor/vehicle.h"

#include <algorithm>
#include <stdexcept>

#include "separator.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/drive_identification.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

/// @param options  by strut, or one that is meant for all, or none: the defaults.
/// @return by strut.
/// @throws std::invalid_argument  if they are of another number of struts.
template <class Options>
std::vector<Options> optionsByStrut(const std::vector<Options>& options, std::size_t num_struts) {
  if (options.size() <= 1) return std::vector<Options>(num_struts, options.empty() ? Options() : options.front());
  if (options.size() != num_struts)
    throw std::invalid_argument("options of " + std::to_string(options.size()) + " struts, must be of " +
                                std::to_string(num_struts) + ", or one for all");
  return options;
}

bool isAt(const AntiRollBarFound& bar, std::size_t strut) { return bar.first == strut || bar.second == strut; }

/// @return that of the vehicle, if it is given.
template <class Options>
std::optional<double> samplePeriodOf(const std::vector<Options>& options) {
  return options.empty() ? std::nullopt : options.front().sample_period;
}

/// @return true for a strut alone, which has no name and nothing that it is to be separated from.
bool isOneStrut(const std::vector<std::string>& names) { return names.size() == 1 && names.front().empty(); }

/// @throws std::invalid_argument  if a drive has another number of struts.
std::vector<Drive> drivesOfOne(const std::vector<VehicleDrive>& drives) {
  return mapped(drives, [](const VehicleDrive& drive) {
    if (drive.struts.size() != 1) throw std::invalid_argument("a drive of more than one strut, must be of one");
    return drive.struts.front();
  });
}

MonitorSettings settingsOf(const IdentifyOptions& options, double period) {
  MonitorOptions monitor;
  monitor.sample_period = period;
  monitor.memory = options.memory;
  if (options.horizon_samples) monitor.integration_horizon = *options.horizon_samples * period;
  return monitor;
}

bool names(const Diagnosis& strut) {
  return strut && (strut.verdict == Verdict::kEffectFound || strut.verdict == Verdict::kSuspect);
}

// @return mean square that what was found explains [(m/s^2)^2].
double explainedPower(const Diagnosis& strut) {
  return strut.explained_share * strut.structured_share * strut.base.held_out_rmse * strut.base.held_out_rmse;
}

Verdict worstOf(const VehicleDiagnosis& found) {
  for (const Verdict verdict : {Verdict::kEffectFound, Verdict::kSuspect, Verdict::kUnexplained})
    for (std::size_t i = 0; i < found.struts.size(); ++i)
      if (found.verdictOn(i) == verdict) return verdict;
  return Verdict::kNothingMissing;
}

/// The search in all struts: what one lacks is named where it explains most, and the others are judged anew without it.
class VehicleSearch {
 public:
  VehicleSearch(Separator separator, std::vector<DiagnoseOptions> options, const KnownModels& models)
      : separator_(std::move(separator)), options_(std::move(options)), models_(models) {
    // Residuals tell the noise that struts share only if the models fit these drives: the given ones are fitted first.
    if (!models_.empty() && separator_.sharesNoise())
      separator_.fitModels([&](std::size_t strut) { return models_[strut].has_value(); });
    result_.coupling = separator_.coupling;
    result_.struts.resize(size());
    result_.drives.resize(size());
  }

  VehicleDiagnosis run(const std::vector<std::string>& strut_names) {
    settleOpen();
    if (settled_.size() > 1) reconsider();
    dropMarginal();
    fitFound();
    result_.verdict = worstOf(result_);
    result_.summary = summaryOf(result_, strut_names);
    if (progress()) progress()(1.0);
    return result_;
  }

 private:
  std::size_t size() const { return separator_.models.size(); }
  const std::function<void(double)>& progress() const { return options_.front().progress; }

  // As long as a law was not known, a part of its force was taken for noise that struts share. So what was found is
  // fitted once more, to drives out of which no such noise was taken.
  void fitFound() {
    if (!separator_.sharesNoise()) return;
    const auto fits = separator_.fitModels([&](std::size_t strut) { return names(result_.struts[strut]); });
    for (std::size_t i = 0; i < size(); ++i) {
      Diagnosis& strut = result_.struts[i];
      if (!fits[i]) continue;
      const bool is_complete = strut.model().is_complete;
      strut.final_fit = {fits[i]->model, fits[i]->stddev, true};
      strut.final_fit->model.is_complete = is_complete;
    }
  }

  void judge(std::size_t strut, std::vector<Drive> drives, double step, int most_effects) {
    DiagnoseOptions options = options_[strut];
    options.most_effects = most_effects;
    options.sample_period = separator_.period;
    options.model = models_.empty() ? std::nullopt : models_[strut];
    if (progress()) options.progress = [&](double share) { progress()(done_ + share * step); };
    Diagnosis& found = result_.struts[strut];
    found = diagnose(drives, options);
    result_.drives[strut] = std::move(drives);
    if (found) separator_.models[strut] = found.base.model;
    done_ += step;
  }

  void settleOpen() {
    while (settled_.size() < size()) {
      auto separated = separator_.separate(true);
      // What another round takes is not known.
      const double step = (1.0 - done_) / (static_cast<double>(size() - settled_.size()) + 1.0);
      std::optional<std::size_t> best;
      for (std::size_t i = 0; i < size(); ++i) {
        if (std::find(settled_.begin(), settled_.end(), i) != settled_.end()) continue;
        judge(i, std::move(separated[i]), step, options_[i].most_effects);
        const Diagnosis& found = result_.struts[i];
        if (names(found) && (!best || explainedPower(found) > explainedPower(result_.struts[*best]))) best = i;
      }
      if (!best) return;
      // What the others seem to lack may be this effect: they are judged anew without it.
      settled_.push_back(*best);
      separator_.models[*best] = result_.struts[*best].model();
    }
  }

  // What was named first may have been that of a strut which was named later.
  void reconsider() {
    const std::vector<std::size_t> before = std::exchange(settled_, {});
    const double step = (1.0 - done_) / (static_cast<double>(before.size()) + 1.0);
    for (const std::size_t strut : before) {
      judge(strut, std::move(separator_.separate(true)[strut]), step, options_[strut].most_effects);
      if (!names(result_.struts[strut])) continue;
      settled_.push_back(strut);
      separator_.models[strut] = result_.struts[strut].model();
    }
    if (settled_.size() < before.size()) settleOpen();
  }

  // A smaller share of what the strongest effect does is what the errors of the ratios carry over from it.
  void dropMarginal() {
    double most = 0.0;
    for (const std::size_t strut : settled_) most = std::max(most, explainedPower(result_.struts[strut]));
    for (const std::size_t strut : settled_)
      if (explainedPower(result_.struts[strut]) < kWorthHaving * most) judge(strut, result_.drives[strut], 0.0, 0);
  }

  Separator separator_;
  std::vector<DiagnoseOptions> options_;  // by strut
  const KnownModels& models_;
  VehicleDiagnosis result_;
  std::vector<std::size_t> settled_;  // struts that lack something, in the order in which it was found
  double done_ = 0.0;                 // of the progress
};

}  // namespace

SeparatedVehicle separateVehicle(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                 const std::optional<double>& sample_period, const KnownModels& models) {
  if (isOneStrut(names)) return {{}, {drivesOfOne(drives)}, {}};
  const Separator separator(drives, names, sample_period, models);
  SeparatedVehicle separated{separator.coupling, {}, separator.models};
  if (separated.coupling) separated.struts = separator.separate(false);
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
                                      const std::vector<IdentifyOptions>& options,
                                      const std::function<void(std::size_t strut, const MonitorReport&)>& report) {
  const std::vector<IdentifyOptions> by_strut = optionsByStrut(options, names.size());
  const double period = periodOf(drives, names, samplePeriodOf(options));
  const auto settings = mapped(by_strut, [&](const IdentifyOptions& strut) { return settingsOf(strut, period); });
  VehicleMonitor monitor(settings, report, static_cast<int>(drives.front().forces.size()));
  for (const VehicleDrive& drive : drives)
    for (std::size_t k = 0; k < drive.struts.front().samples.size(); ++k) {
      monitor.addSample(sampleOf(drive, k));
      monitor.fitBodyIfDue();
    }
  monitor.fitBody();
  return identified(monitor, names, namesOf(drives.front().forces));
}

VehicleDiagnosis diagnoseVehicle(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& strut_names,
                                 const std::vector<DiagnoseOptions>& options, const KnownModels& models) {
  std::vector<DiagnoseOptions> by_strut = optionsByStrut(options, strut_names.size());
  if (isOneStrut(strut_names)) {
    if (!models.empty()) by_strut.front().model = models.front();
    VehicleDiagnosis one{{}, {}, {drivesOfOne(drives)}, {}, {}};
    one.struts = {diagnose(one.drives.front(), by_strut.front())};
    one.verdict = one.struts.front().verdict;
    one.summary = one.struts.front().summary;
    return one;
  }
  Separator separator(drives, strut_names, samplePeriodOf(options), models);
  if (separator.coupling) return VehicleSearch(std::move(separator), std::move(by_strut), models).run(strut_names);
  VehicleDiagnosis nothing;
  nothing.coupling = separator.coupling;
  nothing.summary = "The drives " + nothing.coupling.reason + ".";
  return nothing;
}

}  // namespace suspension_health_monitor
