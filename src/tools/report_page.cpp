#include "report_page.h"

#include <algorithm>
#include <array>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "recorded_drives.h"
#include "results.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {

NLOHMANN_JSON_SERIALIZE_ENUM(ForceVariable, {{ForceVariable::kTravel, "travel"},
                                             {ForceVariable::kTravelRate, "travel_rate"},
                                             {ForceVariable::kTime, "time"}})

namespace {

/// All that the page of a search is made of.
struct ReportContent {
  const Diagnosis& found;
  const DiagnoseOptions& options;  ///< of the search, with sample_period
  const PageSource& source;
  const Comparison& before;  ///< the model as it is, fitted to all samples
  const Comparison* after;   ///< with the effects found; none if there are none
};

constexpr std::size_t kMostValues = 1'250'000;  // in the page: 2 bytes each, 4/3 of that in base64
constexpr double kPeriodsInView = 8.0;          // natural periods that are shown first

std::string base64(const std::vector<std::uint8_t>& bytes) {
  namespace it = boost::archive::iterators;
  using Encoder = it::base64_from_binary<it::transform_width<std::vector<std::uint8_t>::const_iterator, 6, 8>>;
  std::string text(Encoder(bytes.begin()), Encoder(bytes.end()));
  return text.append((3 - bytes.size() % 3) % 3, '=');
}

/// Values as little-endian 16-bit multiples of a step.
json packed(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const double step = largest > 0.0 ? largest / 32767.0 : 1.0;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * values.size());
  for (const double value : values) {
    const auto number = static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(value / step)));
    bytes.push_back(static_cast<std::uint8_t>(number & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(number >> 8));
  }
  return {{"step", step}, {"packed", base64(bytes)}};
}

/// The smallest and the largest of every `range` values.
std::vector<double> thinned(const std::vector<double>& values, std::size_t range) {
  std::vector<double> result;
  for (std::size_t first = 0; first < values.size(); first += range) {
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), first + range));
    const auto [low, high] = std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(first), end);
    result.push_back(*std::min(low, high));  // in the order of time
    result.push_back(*std::max(low, high));
  }
  return result;
}

/// How many samples share two values, so that all drives fit into the page; 1: all are kept.
std::size_t thinning(const ReportContent& content) {
  std::size_t samples = 0;
  for (const ComparedSegment& segment : content.before.segments) samples += segment.size();
  const std::size_t models = content.after == nullptr ? 1 : 2;
  if (samples * (1 + models) <= kMostValues) return 1;
  return std::max<std::size_t>(3, 2 * samples * (1 + 2 * models) / kMostValues + 1);
}

/// One segment. Unthinned, the page itself takes the residual off the measurement to get the prediction.
json stretchJson(const ComparedSegment& before, const ComparedSegment* after, std::size_t range) {
  json values = json::object();
  const auto add = [&](const char* name, const std::vector<double>& numbers) {
    values[name] = packed(range > 1 ? thinned(numbers, range) : numbers);
  };
  add("measured", before.measured);
  add("residual_before", before.residuals());
  if (after != nullptr) add("residual_after", after->residuals());
  if (range > 1) add("before", before.predicted);
  if (range > 1 && after != nullptr) add("after", after->predicted);
  const double period = range > 1 ? 0.5 * static_cast<double>(range) * before.period : before.period;
  return {{"start", before.start}, {"period", period}, {"values", values}};
}

/// Middle of the span with the largest mean square residual of a segment, and that mean square.
std::pair<double, double> worstSpan(const ComparedSegment& segment, double span) {
  const auto width = std::min(segment.size(), static_cast<std::size_t>(std::max(1.0, span / segment.period)));
  double sum = 0.0;
  std::pair<double, double> worst{segment.start, -1.0};
  for (std::size_t k = 0; k < segment.size(); ++k) {
    sum += segment.residual(k) * segment.residual(k);
    if (k >= width) sum -= segment.residual(k - width) * segment.residual(k - width);
    if (k + 1 >= width && sum > worst.second) worst = {segment.time(k) - 0.5 * span, sum};
  }
  return worst;
}

/// The drives over time: measured z'' and the residuals before and after, packed as 16-bit numbers, with the stretches
/// that were held out and a window that is worth looking at first.
json drivesJson(const ReportContent& content) {
  const double stiffness = content.found.base.model.stiffness_to_mass;
  const double span = kPeriodsInView * 2.0 * M_PI / std::sqrt(stiffness);
  const std::size_t range = thinning(content);
  json drives = json::array();
  for (std::size_t r = 0; r < content.source.drive_names.size(); ++r) {
    std::pair<double, double> worst{0.0, -1.0};
    double duration = 0.0;
    json stretches = json::array();
    for (std::size_t i = 0; i < content.before.segments.size(); ++i) {
      const ComparedSegment& segment = content.before.segments[i];
      if (segment.drive != r || segment.size() < 2) continue;
      stretches.push_back(stretchJson(segment, content.after ? &content.after->segments.at(i) : nullptr, range));
      const std::pair<double, double> here = worstSpan(segment, span);
      if (here.second > worst.second) worst = here;
      duration = segment.time(segment.size() - 1);
    }
    if (stretches.empty()) continue;
    drives.push_back(
        {{"name", content.source.drive_names[r]},
         {"duration", duration},
         {"view_span", span},
         {"view_centre", worst.first},
         {"stretches", stretches},
         {"held_out", content.before.held_out.empty() ? json::array() : json(content.before.held_out[r])}});
  }
  return drives;
}

/// A model's numbers by name.
json valuesOf(const StrutModel& model, const std::vector<double>& stddevs) {
  json values;
  auto stddev = stddevs.begin();
  for (const ModelNumber& number : numbersOf(model)) {
    values[number.name] = {{"value", number.value}};
    if (stddev != stddevs.end()) values[number.name]["stddev"] = *stddev++;
  }
  return values;
}

/// The numbers of the model that was found, each before and after with its standard deviation.
json parametersJson(const ReportContent& content) {
  json values{{"before", valuesOf(content.before.model, content.before.stddev)}};
  if (const auto& fit = content.found.final_fit) values["after"] = valuesOf(fit->model, fit->stddev);
  json rows = jsonOf(numbersOf(content.found.model()));
  for (json& row : rows)
    for (const auto& [when, numbers] : values.items())
      if (const auto its = numbers.find(row["name"].get<std::string>()); its != numbers.end()) row[when] = *its;
  return rows;
}

constexpr int kLawPoints = 240;

/// The law over the range that was seen.  @pre force.lawAt() may be called.
json curveOf(const PartialResidual& force) {
  json at = json::array(), law = json::array();
  if (force.curve.size() > 1)
    for (int i = 0; i <= kLawPoints; ++i) {
      const double first = force.curve.front().at, last = force.curve.back().at;
      at.push_back(first + (last - first) * i / kLawPoints);
      law.push_back(force.lawAt(at.back()));
    }
  return {{"at", at}, {"law", law}};
}

json forceJson(const PartialResidual& force) {
  json result{{"effect", force.effect.effect.name}, {"law", force.effect.effect.law}, {"variables", force.variables}};
  if (force.variables.size() == 2)
    result.update({{"edges", json::array({force.grid.first_edges, force.grid.second_edges})},
                   {"cells", jsonOf(force.grid.cells)}});
  else if (force.hasMemory())
    result["branches"] = json::array({{{"name", "compressing"}, {"bins", jsonOf(force.curve)}},
                                      {{"name", "extending"}, {"bins", jsonOf(force.back)}}});
  else
    result.update(
        {{"branches", json::array({{{"name", ""}, {"bins", jsonOf(force.curve)}}})}, {"curve", curveOf(force)}});
  return result;
}

/// The force of every effect that was found, as it was seen and by its law.
json forcesJson(const ReportContent& content) {
  json forces = json::array();
  if (content.after == nullptr) return forces;
  const std::vector<std::string>& added = content.found.selected;
  for (const PartialResidual& force : content.after->forces)
    if (std::find(added.begin(), added.end(), force.effect.effect.name) != added.end())
      forces.push_back(forceJson(force));
  return forces;
}

/// What the page tells of every candidate, by name.
json effectsJson(const EffectLibrary& library) {
  json effects;
  for (const EffectLibrary::Description& effect : library.describe()) effects[effect.name] = jsonOf(effect);
  return effects;
}

/// The curves as --json has them, with the forces that a model has at their nodes.
json curvesJson(const json& strut, const StrutModel& model) {
  const std::array<Memory, kMostEffects> rest{};
  json damper = strut.at("damper_curve"), spring = strut.at("spring_curve");
  damper["law"] = spring["law"] = json::array();
  for (const double v : damper["velocity"]) damper["law"].push_back(model.force(0.0, v, 0.0, rest.data()));
  for (const double d : spring["travel"]) spring["law"].push_back(model.force(d, 0.0, 0.0, rest.data()));
  return {{"damper", damper}, {"spring", spring}};
}

json findingsOf(const ReportContent& content) {
  double duration = 0.0;
  const double period = *content.options.sample_period;
  for (const ComparedSegment& segment : content.before.segments)
    duration += static_cast<double>(segment.size()) * period;
  json findings{{"search", toJson(content.found)},
                {"source", sourceOf(content.source.drive_names, duration, period)},
                {"effects", effectsJson(content.options.candidates)},
                {"parameters", parametersJson(content)},
                {"drives", drivesJson(content)},
                {"before", shortened(toJson(content.before))},
                {"forces", shortened(forcesJson(content))},
                {"bags", content.source.drive_names},
                {"model_file", toYaml(content.found.model())},
                {"data", shortened(content.source.data)},
                {"origin", content.source.origin}};
  findings["origin"]["from"] = toSeconds(content.found.from);
  findings["origin"]["to"] = toSeconds(content.found.to);
  if (content.after != nullptr) findings["after"] = shortened(toJson(*content.after));
  return findings;
}

}  // namespace

ReportPage::ReportPage(const std::string& folder, const AskedVehicle& vehicle) : vehicle_(vehicle) {
  if (vehicle.only) {
    struts_.try_emplace(*vehicle.only, folder);
    return;
  }
  page_.emplace(folder);
  for (std::size_t i = 0; i < vehicle.names.size(); ++i)
    struts_.try_emplace(i, (std::filesystem::path(folder) / vehicle.names[i]).string());
}

void ReportPage::writeStrut(std::size_t place, const VehicleDiagnosis& all, const DiagnoseOptions& options, json& whole,
                            const PageSource& source) {
  const Diagnosis& found = all.struts[place];
  const std::vector<Drive>& drives = all.drives[place];
  CompareOptions comparing;
  comparing.sample_period = options.sample_period;
  comparing.model = found.base.model;
  Comparison before = compare(drives, comparing);
  if (!before) {  // nothing fits without what was found: clocks that differ
    comparing.fit = false;
    before = compare(drives, comparing);
  }
  requireEnough(before.shortcoming, before.reason);
  std::optional<Comparison> after;
  if (found.final_fit) {
    comparing.model = found.final_fit->model;
    comparing.fit = false;
    after = compare(drives, comparing);
  }
  json findings = findingsOf({found, options, source, before, after && *after ? &*after : nullptr});
  const json& its = vehicle_.resultsOf(place, whole);
  findings["change"] = its.value("change", "");
  findings["travel"] = shortened(its.at("travel"));
  findings["curves"] = shortened(curvesJson(its, found.model()));
  if (!vehicle_.isStrutAlone())
    findings["vehicle"] = {{"strut", vehicle_.names[place]},
                           {"file", vehicle_.file},
                           {"anti_roll_bars", whole["anti_roll_bars"]},
                           {"has_page", page_.has_value()}};
  struts_.at(place).write(searchTemplate(), findings);
}

void ReportPage::write(const VehicleDiagnosis& found, const DiagnoseOptions& options, json whole,
                       const PageSource& source) {
  if (vehicle_.only) return writeStrut(*vehicle_.only, found, options, whole, source);
  double samples = 0.0;
  for (const Drive& drive : found.drives.front()) samples += static_cast<double>(drive.samples.size());
  const double period = *options.sample_period;
  json places = json::array();
  for (std::size_t i = 0; i < vehicle_.names.size(); ++i) {
    if (found.struts[i]) writeStrut(i, found, options, whole, source);
    places.push_back({{"name", vehicle_.names[i]}});
    if (const auto& position = vehicle_.layout.struts[i].position) places.back()["position"] = *position;
  }
  whole.update({{"source", sourceOf(source.drive_names, samples * period, period)},
                {"places", places},
                {"data", source.data},
                {"effects", effectsJson(options.candidates)},
                {"origin", source.origin}});
  page_->write(vehicleTemplate(), shortened(std::move(whole)));
}

}  // namespace suspension_health_monitor
