#pragma once

#include <string>
#include <vector>

#include "../ros/whole_file.h"
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

/// FOLDER/report.html: one page for people that needs no other file and no network. It appears whole or not at all.
/// It shows the verdict, the error step by step, measured against predicted over time, the residual from all sides, the
/// force that was missing, every candidate, and how to use the model. Recordings beyond an hour or so are thinned to
/// the extremes of short ranges, so that the page stays below 5 MB. What the page is made of lies in report_page/; the
/// numbers travel in it as JSON.
class ReportPage {
 public:
  /// @param folder  made if it is not there, and taken away again if nothing is written.
  /// @throws std::runtime_error  naming the file or folder, if it cannot be written.
  explicit ReportPage(const std::string& folder);

  /// @throws std::runtime_error  naming the file, if it cannot be written.
  void write(const ReportContent& content);

 private:
  class Folder {
   public:
    explicit Folder(const std::string& path);
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

   private:
    std::string path_;
    bool made_;
  };

  Folder folder_;  // before the file, so that it is empty by the time that it is taken away
  TextFile file_;
};

}  // namespace suspension_health_monitor
