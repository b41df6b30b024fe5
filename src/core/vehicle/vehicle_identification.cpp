#include "suspension_health_monitor/internal/vehicle/vehicle_identification.h"

#include "suspension_health_monitor/internal/monitor/drive_identification.h"
#include "suspension_health_monitor/internal/vehicle/separation.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {

VehicleCoupling couplingOf(const VehicleMonitor& monitor, const std::vector<std::string>& names,
                           const std::vector<std::string>& forces) {
  if (monitor.isCoupled() && monitor.rows() == nullptr) {  // a strut alone
    VehicleCoupling alone;
    alone.ratios = {{1.0}};
    alone.stddevs = {{0.0}};
    return alone;
  }
  const BodyRows* rows = monitor.rows();
  return describe(rows, monitor.body(), rows == nullptr ? whyNotCoupled(monitor.mistake(), names) : "", forces);
}

std::string describeMistake(const VehicleMonitor& monitor, const std::vector<std::string>& names) {
  const std::string mistake = describe(monitor.mistake(), names);
  return mistake.empty() ? "" : "the drives do not fit the vehicle file: " + mistake;
}

VehicleIdentification identified(VehicleMonitor& monitor, const std::vector<std::string>& names,
                                 const std::vector<std::string>& forces) {
  VehicleIdentification result{couplingOf(monitor, names, forces), {}};
  for (std::size_t i = 0; result && i < names.size(); ++i)
    result.struts.push_back(identified(*monitor.strut(i), monitor.overTheDrive(i), monitor.strut(i)->rejected()));
  if (const std::string mistake = describeMistake(monitor, names); !mistake.empty())
    for (IdentifyResult& strut : result.struts) strut.warnings.push_back(mistake);
  return result;
}

}  // namespace suspension_health_monitor
