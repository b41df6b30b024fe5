#include "health_page.h"

#include <cmath>
#include <limits>

#include "health_results.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();  // null in JSON: no line there

json listOf(const std::vector<HealthMoment>& moments) {
  json list = json::array();
  for (const HealthMoment& moment : moments) {
    list.push_back(toJson(moment));
    list.back()["after"] = toSeconds(moment.elapsed);
  }
  return list;
}

std::string sourceOf(const HealthContent& content) {
  std::vector<std::string> names;
  for (const HealthContent::Recording& recording : content.recordings) names.push_back(recording.name);
  const double period = content.monitor.period();
  return join(names) + formatted(": %.4g s at %.4g Hz, horizon %.4g s", toSeconds(content.log.elapsed()), 1.0 / period,
                                 content.monitor.horizonSamples() * period);
}

}  // namespace

void HealthCourse::add(const HealthMoment& moment, const Baseline& healthy) {
  if (count_++ % stride_ != 0) return;
  points_.push_back({toSeconds(moment.elapsed), moment.la, healthy});
  if (points_.size() < 2 * kMostPoints) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize(points_.size() / 2);
  stride_ *= 2;
}

json HealthCourse::toJson() const {
  json time = json::array();
  std::array<json, 6> series;
  series.fill(json::array());
  for (const Point& point : points_) {
    time.push_back(std::round(1e3 * point.time) / 1e3);
    const bool valid = point.la.valid();
    const std::array values{
        valid ? point.la.damping_to_mass : kNothing,          valid ? point.la.damping_to_mass_stddev : kNothing,
        point.healthy.damping_to_mass.value_or(kNothing),     valid ? point.la.stiffness_to_mass : kNothing,
        valid ? point.la.stiffness_to_mass_stddev : kNothing, point.healthy.stiffness_to_mass.value_or(kNothing)};
    for (std::size_t i = 0; i < values.size(); ++i) series[i].push_back(values[i]);
  }
  for (json& each : series) each = shortened(std::move(each));
  return {{"time", time},
          {"damping", {{"value", series[0]}, {"stddev", series[1]}, {"healthy", series[2]}}},
          {"stiffness", {{"value", series[3]}, {"stddev", series[4]}, {"healthy", series[5]}}}};
}

json findingsOf(const HealthContent& content) {
  const MonitorSettings& settings = content.monitor.options();
  json recordings = json::array();
  for (const HealthContent::Recording& recording : content.recordings)
    recordings.push_back({{"name", recording.name}, {"from", toSeconds(recording.from)}});
  return {{"source", sourceOf(content)},
          {"judged_by", content.reference},
          {"recordings", recordings},
          {"duration", toSeconds(content.log.elapsed())},
          {"seconds", secondsJson(content.log)},
          {"events", listOf(content.log.events())},
          {"end", toJson(content.log.latest())},
          {"early_warnings", listOf(content.log.earlyWarnings())},
          {"thresholds",
           {{"damping", {settings.damping_warn, settings.damping_error}},
            {"stiffness", {settings.stiffness_warn, settings.stiffness_error}}}},
          {"course", content.course.toJson()},
          {"estimates", estimatesJson(content.monitor)}};
}

}  // namespace suspension_health_monitor
