#include "suspension_health_monitor/vehicle.h"

#include <algorithm>

#include "options_by_strut.h"
#include "separator.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_identification.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

MonitorSettings settingsOf(const IdentifyOptions& options, double period) {
  MonitorOptions monitor;
  monitor.sample_period = period;
  monitor.memory = options.memory;
  if (options.horizon_samples) monitor.integration_horizon = *options.horizon_samples * period;
  return monitor;
}

bool isAt(const AntiRollBarFound& bar, std::size_t strut) { return bar.first == strut || bar.second == strut; }

}  // namespace

SeparatedVehicle separateVehicle(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
                                 const std::optional<double>& sample_period, const KnownModels& models) {
  if (isOneStrut(names)) return {{}, {drivesOfOne(drives)}, {}};
  const Separator separator(drives, names, sample_period, models);
  SeparatedVehicle separated{separator.coupling(), {}, separator.models()};
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
  const double period = periodOf(drives, names, samplePeriodOf(options));
  std::vector<MonitorSettings> settings;
  for (const IdentifyOptions& strut : by_strut) settings.push_back(settingsOf(strut, period));
  VehicleMonitor monitor(settings, report, static_cast<int>(drives.front().forces.size()));
  for (const VehicleDrive& drive : drives)
    for (std::size_t k = 0; k < drive.struts.front().samples.size(); ++k) {
      monitor.addSample(sampleOf(drive, k));
      monitor.fitBodyIfDue();
    }
  monitor.fitBody();
  return identified(monitor, names, namesOf(drives.front().forces));
}

}  // namespace suspension_health_monitor
