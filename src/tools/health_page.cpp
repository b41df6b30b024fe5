#include "health_page.h"

#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <cstdio>
#include <limits>

#include "command.h"
#include "results.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;
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

/// What the scripts of the page expect of a strut.
json findingsOf(const HealthContent& content) {
  const MonitorSettings& settings = content.monitor.options();
  const double duration = toSeconds(content.log.elapsed());
  std::vector<std::string> names;
  json recordings = json::array();
  for (const HealthContent::Recording& recording : content.recordings) {
    names.push_back(recording.name);
    recordings.push_back({{"name", recording.name}, {"from", toSeconds(recording.from)}});
  }
  return {{"strut", content.strut},
          {"source", sourceOf(names, duration, content.monitor.period())},
          {"horizon", content.monitor.horizonSamples() * content.monitor.period()},
          {"judged_by", content.reference},
          {"recordings", recordings},
          {"duration", duration},
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

}  // namespace

void HealthCourse::add(const HealthMoment& moment, const Baseline& healthy) {
  const auto if_valid = [&](double number) { return moment.estimate.valid() ? number : kNothing; };
  points_.add({toSeconds(moment.elapsed),
               {if_valid(moment.estimate.damping_to_mass), if_valid(moment.estimate.damping_to_mass_stddev),
                healthy.damping_to_mass.value_or(kNothing)},
               {if_valid(moment.estimate.stiffness_to_mass), if_valid(moment.estimate.stiffness_to_mass_stddev),
                healthy.stiffness_to_mass.value_or(kNothing)}});
}

json HealthCourse::toJson() const {
  json time = json::array();
  for (const Point& point : points_.items()) time.push_back(std::round(1e3 * point.time) / 1e3);
  const auto courseOf = [&](Parameter Point::*parameter) {
    json value = json::array(), stddev = value, healthy = value;
    for (const Point& point : points_.items()) {
      value.push_back((point.*parameter).value);
      stddev.push_back((point.*parameter).stddev);
      healthy.push_back((point.*parameter).healthy);
    }
    return shortened({{"value", value}, {"stddev", stddev}, {"healthy", healthy}});
  };
  return {{"time", time}, {"damping", courseOf(&Point::damping)}, {"stiffness", courseOf(&Point::stiffness)}};
}

HealthFiles::HealthFiles(const po::variables_map& values, const AskedVehicle& vehicle)
    : json_(outputFile(values, "json")),
      csv_(outputFile(values, "csv")),
      table_(csv_ ? csv_->stream() : nullptr, vehicle, "level,message,b1,b0,b1_stddev,b0_stddev,offset"),
      courses_(vehicle.names.size()) {
  if (values.count(kReport) != 0) page_.emplace(values[kReport].as<std::string>());
}

void HealthFiles::add(std::size_t strut, const HealthMoment& moment, const Baseline& healthy) {
  const StrutEstimate& estimate = moment.estimate;
  if (table_.isOf(strut))
    std::fprintf(table_.beginLine(strut, moment.stamp), "%s,\"%s\",%.17g,%.17g,%.17g,%.17g,%.17g\n",
                 nameOf(moment.level), boost::replace_all_copy(moment.message, "\"", "\"\"").c_str(),
                 estimate.damping_to_mass, estimate.stiffness_to_mass, estimate.damping_to_mass_stddev,
                 estimate.stiffness_to_mass_stddev, moment.offset);
  if (page_) courses_[strut].add(moment, healthy);
}

void HealthFiles::commit(const json& result, const std::vector<HealthContent>& contents, const json& origin) {
  if (json_) json_->commit(result.dump(2) + '\n');
  if (csv_) csv_->commit();
  if (!page_) return;
  json struts = json::array();
  for (const HealthContent& content : contents) struts.push_back(findingsOf(content));
  page_->write(healthTemplate(), {{"struts", struts}, {"origin", origin}});
}

}  // namespace suspension_health_monitor
