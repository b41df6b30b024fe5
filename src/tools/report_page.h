#pragma once

#include <string>
#include <vector>

#include "html_page.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/diagnose.h"

namespace suspension_health_monitor {

/// All that the page of a search is made of.
struct ReportContent {
  const Diagnosis& found;
  const EffectLibrary& library;          ///< the candidates of the search
  double period;                         ///< of the samples [s]
  std::vector<std::string> drive_names;  ///< one per drive
  const Comparison& before;              ///< the model as it is, fitted to all samples
  const Comparison* after = nullptr;     ///< with the effects found; none if there are none
};

/// The page of a search: the verdict, the error step by step, measured against predicted over time, the residual from
/// all sides, the force that was missing, every candidate, and how to use the model. Recordings beyond an hour or so
/// are thinned to the extremes of short ranges, so that the page stays below 5 MB.
class ReportPage {
 public:
  /// As HtmlPage.
  explicit ReportPage(const std::string& folder) : page_(folder) {}

  /// As HtmlPage::write().
  void write(const ReportContent& content);

 private:
  HtmlPage page_;
};

}  // namespace suspension_health_monitor
