#pragma once

#include <boost/program_options.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "csv_tables.h"
#include "html_page.h"
#include "suspension_health_monitor/internal/digest.h"
#include "suspension_health_monitor/internal/monitor/health_log.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

/// Damping and stiffness over time with their healthy values, for figures: evenly thinned, so that neither memory nor
/// the page grows with the drive.
class HealthCourse {
 public:
  /// @param healthy  what the strut is judged by then.
  void add(const HealthMoment& moment, const Baseline& healthy);

  nlohmann::json toJson() const;

 private:
  static constexpr std::size_t kMostPoints = 4000;  // more than twice a screen's pixels

  /// One parameter; NaN: not known.
  struct Parameter {
    double value, stddev, healthy;
  };

  struct Point {
    double time;  // elapsed [s]
    Parameter damping, stiffness;
  };

  Digest<Point> points_{kMostPoints};
};

/// All that the page of `suspension_bag health --report` is made of.
struct HealthContent {
  /// A bag, and the time elapsed when it begins.
  struct Recording {
    std::string name;
    Stamp from;
  };

  const HealthLog& log;
  const HealthCourse& course;
  const SuspensionMonitor& monitor;
  std::vector<Recording> recordings;
  std::string reference;  ///< what the strut was judged by, in words
  std::string strut;      ///< its name in the vehicle; empty: it is alone
};

/// The files of `suspension_bag health`, and what they are made of while the monitor runs.
class HealthFiles {
 public:
  /// Begins the files that the options ask for.
  /// @param vehicle  outlives this object.
  /// @throws std::runtime_error  naming the file that cannot be written.
  HealthFiles(const boost::program_options::variables_map& values, const AskedVehicle& vehicle);

  /// As HealthLog calls its sink.
  /// @param healthy  what the strut is judged by then.
  void add(std::size_t strut, const HealthMoment& moment, const Baseline& healthy);

  const HealthCourse& course(std::size_t strut) const { return courses_[strut]; }

  /// @param result  for --json.  @param contents, origin  for the page: a strut each, and as originOf().
  /// @throws std::runtime_error  naming the file that cannot be written.
  void commit(const nlohmann::json& result, const std::vector<HealthContent>& contents, const nlohmann::json& origin);

 private:
  std::optional<TextFile> json_, csv_;
  std::optional<HtmlPage> page_;
  CsvTable table_;
  std::vector<HealthCourse> courses_;
};

}  // namespace suspension_health_monitor
