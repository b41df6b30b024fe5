#pragma once

#include <map>
#include <string>
#include <vector>

#include "recorded_vehicle.h"
#include "report_page.h"

namespace suspension_health_monitor {

/// The pages of a search in a vehicle: DIR/report.html with the vehicle from above, its verdict and its coupling, and
/// DIR/NAME/report.html of every strut, each as ReportPage. With --strut that strut's own is DIR/report.html, the only
/// one.
class VehiclePage {
 public:
  /// As HtmlPage. @param vehicle  outlives this object.
  VehiclePage(const std::string& folder, const AskedVehicle& vehicle);

  /// @param options  of the search, with sample_period.
  /// @param changes  by strut how it is against the healthy one, in words; empty: not known.
  /// @throws std::runtime_error  naming the file that cannot be written.
  void write(const VehicleDiagnosis& found, const DiagnoseOptions& options, const std::vector<std::string>& changes,
             const PageSource& source);

 private:
  void writeStrut(std::size_t place, const VehicleDiagnosis& found, const DiagnoseOptions& options,
                  const std::string& change, PageSource source);

  const AskedVehicle& vehicle_;
  std::optional<HtmlPage> page_;              // before those of the struts, whose folders are in its folder
  std::map<std::size_t, ReportPage> struts_;  // by place
};

}  // namespace suspension_health_monitor
