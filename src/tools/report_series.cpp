#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "report_page.h"

namespace suspension_health_monitor {
namespace {

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

}  // namespace

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

}  // namespace suspension_health_monitor
