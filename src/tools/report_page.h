#pragma once

#include <string>
#include <vector>

#include "html_page.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {

/// The vehicle of a strut that is not alone.
struct InVehicle {
  std::string strut;
  std::string file;               ///< of --vehicle
  std::vector<std::string> bars;  ///< struts that anti-roll bars tie it to
  bool has_page = true;           ///< of its own, in the folder above that of the strut's
};

/// What a page is made from.
struct PageSource {
  std::vector<std::string> drive_names;  ///< one per drive
  nlohmann::json origin;                 ///< as originOf()
  std::string change = {};               ///< how the strut is against the healthy one, in words; empty: not known
};

/// All that the page of a search is made of.
struct ReportContent {
  const Diagnosis& found;
  const EffectLibrary& library;  ///< the candidates of the search
  double period;                 ///< of the samples [s]
  const PageSource& source;
  const Comparison& before;            ///< the model as it is, fitted to all samples
  const Comparison* after = nullptr;   ///< with the effects found; none if there are none
  const InVehicle* vehicle = nullptr;  ///< none: the strut was searched by itself
};

/// The page of a search: the verdict, the error step by step, measured against predicted over time, the residual from
/// all sides, the force that was missing, every candidate, and how to use the model. Recordings beyond an hour or so
/// are thinned to the extremes of short ranges, so that the page stays below 5 MB.
class ReportPage {
 public:
  /// As HtmlPage.
  explicit ReportPage(const std::string& folder) : page_(folder) {}

  /// Compares what a search found with the drives, before and after, and writes the page.
  /// @param drives, options  of the search.  @param vehicle  nullptr: there is none.
  /// @throws InputError, TooLittleError  if even the model as it is cannot be compared.
  /// @throws std::runtime_error  as HtmlPage::write().
  void write(const Diagnosis& found, const std::vector<Drive>& drives, const DiagnoseOptions& options,
             const PageSource& source, const InVehicle* vehicle = nullptr);

 private:
  HtmlPage page_;
};

/// @return paths without their folders.
std::vector<std::string> fileNames(const std::vector<std::string>& paths);

}  // namespace suspension_health_monitor
