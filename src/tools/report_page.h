#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bag_options.h"
#include "html_page.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What a page is made from.
struct PageSource {
  std::vector<std::string> drive_names;  ///< one per drive
  json origin;                           ///< as originOf()
  json data;                             ///< as dataJson()
};

/// All that the page of a search is made of.
struct ReportContent {
  const Diagnosis& found;
  const DiagnoseOptions& options;  ///< of the search, with sample_period
  const PageSource& source;
  const Comparison& before;  ///< the model as it is, fitted to all samples
  const Comparison* after;   ///< with the effects found; none if there are none
};

/// The drives over time: measured z'' and the residuals before and after, packed as 16-bit numbers, with the stretches
/// that were held out and a window that is worth looking at first.
json drivesJson(const ReportContent& content);

/// The pages of a search: of every strut the verdict, the error step by step, measured against predicted over time, the
/// residual from all sides, the force that was missing, every candidate, and how to use the model. Recordings beyond an
/// hour or so are thinned to the extremes of short ranges, so that the page stays below 5 MB. Of one strut it is
/// DIR/report.html; of several DIR/NAME/report.html, and DIR/report.html has the vehicle from above, its verdict and
/// its coupling.
class ReportPage {
 public:
  /// As HtmlPage. @param vehicle  outlives this object.
  ReportPage(const std::string& folder, const AskedVehicle& vehicle);

  /// Compares what a search found with the drives, before and after, and writes the pages.
  /// @param options  of the search, with sample_period.
  /// @param whole  what was found as --json has it.
  /// @throws InputError, TooLittleError  if even the model as it is cannot be compared.
  /// @throws std::runtime_error  naming the file that cannot be written.
  void write(const VehicleDiagnosis& found, const DiagnoseOptions& options, json whole, const PageSource& source);

 private:
  void writeStrut(std::size_t place, const VehicleDiagnosis& all, const DiagnoseOptions& options, json& whole,
                  const PageSource& source);

  const AskedVehicle& vehicle_;
  std::optional<HtmlPage> page_;            // before those of the struts, whose folders are in its folder
  std::map<std::size_t, HtmlPage> struts_;  // by place
};

}  // namespace suspension_health_monitor
