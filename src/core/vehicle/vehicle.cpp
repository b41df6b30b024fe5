#include "suspension_health_monitor/vehicle.h"

#include <algorithm>
#include <cmath>

#include "options_by_strut.h"
#include "separator.h"
#include "suspension_health_monitor/internal/identification/horizon_selection.h"

namespace suspension_health_monitor {
namespace {

int horizonFor(const StrutModel& model, double period) {
  const double horizon = proposeHorizon(model.damping_to_mass, model.stiffness_to_mass).horizon;
  return horizonSamples(horizon, period);
}

bool isAt(const AntiRollBarFound& bar, std::size_t strut) { return bar.first == strut || bar.second == strut; }

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
                                      const std::vector<IdentifyOptions>& options,
                                      const std::function<void(std::size_t strut, const MonitorReport&)>& report) {
  const std::vector<IdentifyOptions> by_strut = optionsByStrut(options, names.size());
  const Separator separator(drives, names, samplePeriodOf(options));
  VehicleIdentification result{separator.coupling(), {}};
  if (!result) return result;
  const auto separated = separator.separate();
  const std::vector<LinearStrut> stddevs = separator.modelStddevs();
  for (std::size_t i = 0; i < separated.size(); ++i) {
    IdentifyOptions strut = by_strut[i];
    strut.sample_period = separator.period();
    if (report) strut.report = [&report, i](const MonitorReport& each) { report(i, each); };
    if (!strut.horizon_samples) strut.horizon_samples = horizonFor(separator.models()[i], separator.period());
    IdentifyResult& identified = result.struts.emplace_back(identify(separated[i], strut));
    const auto [damping, stiffness] = stddevs[i];
    for (IdentifiedStrut* estimate : {&identified.ls, &identified.la, &identified.estimate, &identified.now}) {
      estimate->damping_to_mass_stddev = std::hypot(estimate->damping_to_mass_stddev, damping);
      estimate->stiffness_to_mass_stddev = std::hypot(estimate->stiffness_to_mass_stddev, stiffness);
    }
  }
  return result;
}

}  // namespace suspension_health_monitor
