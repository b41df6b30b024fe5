#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "html_page.h"
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

  nlohmann::json toJson(Parameter Point::*parameter) const;

  std::vector<Point> points_;
  std::size_t count_ = 0, stride_ = 1;
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
};

/// @return what the scripts of the page expect.
nlohmann::json findingsOf(const HealthContent& content);

}  // namespace suspension_health_monitor
