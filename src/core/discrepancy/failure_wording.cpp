#include "failure_wording.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

double largestEdge(const std::vector<ResidualBin>& bins) {
  return std::max(std::abs(bins.front().from), std::abs(bins.back().to));
}

/// Where the bins have passed a share of the samples.
double quantile(const std::vector<ResidualBin>& bins, double share) {
  double all = 0.0, passed = 0.0;
  for (const ResidualBin& bin : bins) all += static_cast<double>(bin.count);
  for (const ResidualBin& bin : bins) {
    passed += static_cast<double>(bin.count);
    if (passed >= share * all) return bin.to;
  }
  return bins.back().to;
}

std::string percent(double share) {
  const double value = 100.0 * share;
  return ReadableUnit(1.0, "").number(value < 10.0 ? std::round(10.0 * value) / 10.0 : std::round(value)).substr(0, 4);
}

std::string percentText(double share) {
  std::string text = percent(share);
  while (text.find('.') != std::string::npos && (text.back() == '0' || text.back() == '.')) {
    const bool point = text.back() == '.';
    text.pop_back();
    if (point) break;
  }
  return text + " %";
}

}  // namespace

FailureWording::FailureWording(const ResidualViews& views)
    : travel_(0.5 * largestEdge(views.travel), "m"),
      rate_(ReadableUnit::plain(largestEdge(views.travel_rate), "m/s")),
      acceleration_(ReadableUnit::plain(views.rms, "m/s^2")),
      time_(ReadableUnit::plain(views.time.back().to, "s")),
      frequency_(ReadableUnit::plain(views.spectrum ? views.spectrum->frequency.back() : 1.0, "Hz")),
      travel_from_(quantile(views.travel, 0.1)),
      travel_to_(quantile(views.travel, 0.9)),
      rate_from_(quantile(views.travel_rate, 0.1)),
      rate_to_(quantile(views.travel_rate, 0.9)),
      travel_end_(views.travel.front().from),
      rate_end_(views.travel_rate.front().from),
      travel_top_(views.travel.back().to),
      rate_top_(views.travel_rate.back().to),
      several_drives_(views.time.back().record > 0) {}

std::string FailureWording::errors(const FailureRegion& region) const {
  std::string text = "rmse " + acceleration_.number(region.rmse);
  if (region.rmse_elsewhere > 0.0) text += " against " + acceleration_.number(region.rmse_elsewhere) + " elsewhere";
  return text;
}

std::string FailureWording::push(double mean) const {
  return "the strut pushes the body up " + acceleration_(std::abs(mean)) + (mean > 0.0 ? " harder" : " less") +
         " than the model";
}

std::string FailureWording::inDrive(std::size_t record) const {
  return several_drives_ ? " of drive " + std::to_string(record + 1) : "";
}

void FailureWording::travel(FailureRegion& region) const {
  std::string where = "At mid travel";
  region.region = "travel " + travel_.number(region.from) + " to " + travel_(region.to);
  if (region.to >= travel_top_) region.region = "travel above " + travel_(region.from);
  if (region.from <= travel_end_) region.region = "travel below " + travel_(region.to);
  if (region.from >= travel_to_) where = "In deep compression";
  else if (region.to <= travel_from_) where = "Far extended";
  else if (region.to >= travel_top_ && region.from >= 0.0) where = "In compression";
  else if (region.from <= travel_end_ && region.to <= 0.0) where = "In extension";
  const std::string what = region.mean == 0.0 ? "the model is worst, though not to one side" : push(region.mean);
  region.sentence =
      where + " (" + region.region + ", " + percentText(region.share) + " of the drive) " + what + ": " + errors(region) + ".";
}

void FailureWording::travelRate(FailureRegion& region) const {
  std::string where = "Moving slowly";
  region.region = "travel rate " + rate_.number(region.from) + " to " + rate_(region.to);
  if (region.to >= rate_top_) region.region = "travel rate above " + rate_(region.from);
  if (region.from <= rate_end_) region.region = "travel rate below " + rate_(region.to);
  if (region.from >= rate_to_) where = "Compressing fast";
  else if (region.to <= rate_from_) where = "Extending fast";
  else if (region.from >= 0.0) where = "Compressing";
  else if (region.to <= 0.0) where = "Extending";
  const std::string what = region.mean == 0.0 ? "the model is worst, though not to one side" : push(region.mean);
  region.sentence =
      where + " (" + region.region + ", " + percentText(region.share) + " of the drive) " + what + ": " + errors(region) + ".";
}

void FailureWording::time(std::size_t record, FailureRegion& region) const {
  region.region = time_.number(region.from) + " to " + time_(region.to) + inDrive(record);
  region.sentence = "From " + region.region + " the model is worst: " + errors(region) + ".";
}

void FailureWording::surface(double rate_from, double rate_to, FailureRegion& region) const {
  region.region = "travel " + travel_.number(region.from) + " to " + travel_(region.to) + " at " +
                  rate_.number(rate_from) + " to " + rate_(rate_to);
  region.sentence = std::string("When it ") + (rate_from >= 0.0 ? "compresses" : "extends") + " there (" + region.region +
                    ", " + percentText(region.share) + " of the drive) " + push(region.mean) +
                    ", which neither travel nor rate alone shows.";
}

void FailureWording::direction(FailureRegion& region) const {
  region.region = "direction of motion";
  region.sentence = "At the same travel the strut pushes the body up " + acceleration_(std::abs(region.mean)) +
                    (region.mean > 0.0 ? " harder" : " less") +
                    " while it compresses than while it extends, beyond the model's damping: " +
                    (region.mean > 0.0 ? "friction, a part with memory, or damping that is not linear."
                                       : "damping that is not linear, or a part with memory.");
}

void FailureWording::frequency(double structure_share, double coherence, double coherence_threshold,
                               FailureRegion& region) const {
  region.region = frequency_.number(region.from) + " to " + frequency_(region.to);
  region.sentence = "Between " + region.region + " lie " + percentText(structure_share) +
                    " of what is not noise (rmse " + acceleration_(region.rmse) + "); " +
                    (coherence > std::max(0.5, coherence_threshold)
                         ? "it follows the wheel in proportion, so the model's own numbers are off there."
                     : coherence > coherence_threshold
                         ? "a part of it follows the wheel in proportion."
                         : "it does not follow the wheel in proportion.");
}

void FailureWording::offset(FailureRegion& region) const {
  region.region = "everywhere";
  region.sentence = "Everywhere the body's sensor reads " + acceleration_(std::abs(region.mean)) +
                    (region.mean > 0.0 ? " more" : " less") +
                    " than the wheel's says: an offset or a tilt of a sensor, not the strut.";
}

void FailureWording::drift(const char* name, double first_percent, double last_percent, std::size_t record,
                           FailureRegion& region) const {
  const auto of = [](double change) {
    return percentText(std::abs(change) / 100.0) + (change > 0.0 ? " more" : " less");
  };
  region.region = std::string(name) + " from " + time_.number(region.from) + " to " + time_(region.to) + inDrive(record);
  region.sentence = "The " + std::string(name) + " seems to change during the drive" + inDrive(record) +
                    ": in its first third " + of(first_percent) + " than the model has, in its last third " +
                    of(last_percent) + ".";
}

void FailureWording::everywhere(double noise_floor, FailureRegion& region) const {
  region.region = "everywhere";
  region.sentence = "The model leaves more than noise (rmse " + acceleration_(region.rmse) + ", noise alone " +
                    acceleration_(noise_floor) + "), but no region stands out.";
}

void FailureWording::nothing(double noise_floor, FailureRegion& region) const {
  region.region = "nowhere";
  region.sentence = "What the model leaves is noise: rmse " + acceleration_(region.rmse) +
                    ", noise alone would leave about " + acceleration_(noise_floor) + ".";
}

}  // namespace suspension_health_monitor
