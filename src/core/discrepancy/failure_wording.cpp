#include "failure_wording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suspension_health_monitor {
namespace {

constexpr double kFollows = 0.5;     // coherence
constexpr double kRounding = 0.005;  // of the samples, in the bins' edges
constexpr double kNearZero = 0.05;   // of the range of most samples

/// Where the bins have passed a share of the samples.
double quantile(const std::vector<ResidualBin>& bins, double share) {
  double all = 0.0, passed = 0.0;
  for (const ResidualBin& bin : bins) all += static_cast<double>(bin.count);
  for (const ResidualBin& bin : bins) {
    passed += static_cast<double>(bin.count);
    if (passed >= (share - kRounding) * all) return bin.to;
  }
  return bins.back().to;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f %%", share < 0.01 ? 1 : 0, 100.0 * share);
  return text;
}

}  // namespace

FailureWording::Ends::Ends(const std::vector<ResidualBin>& bins)
    : lowest(bins.front().from), from(quantile(bins, 0.1)), to(quantile(bins, 0.9)), highest(bins.back().to) {}

FailureWording::FailureWording(const ResidualViews& views)
    : travel_ends_(views.travel),
      rate_ends_(views.travel_rate),
      travel_(std::max(std::abs(travel_ends_.from), std::abs(travel_ends_.to)), "m"),
      rate_(ReadableUnit::plain(std::max(std::abs(rate_ends_.from), std::abs(rate_ends_.to)), "m/s")),
      acceleration_(ReadableUnit::plain(views.rms, "m/s^2")),
      time_(ReadableUnit::plain(views.time.back().to, "s")),
      frequency_(ReadableUnit::plain(views.spectrum ? views.spectrum->frequency.back() : 1.0, "Hz")),
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
  if (region.from >= travel_ends_.to)
    where = "In deep compression";
  else if (region.to <= travel_ends_.from)
    where = "Far extended";
  else if (isZero(region.from, travel_ends_) || region.from > 0.0)
    where = "In compression";
  else if (isZero(region.to, travel_ends_) || region.to < 0.0)
    where = "In extension";
  describe(where, "travel", travel_, travel_ends_, region);
}

void FailureWording::travelRate(FailureRegion& region) const {
  std::string where = "Moving slowly";
  if (region.from >= rate_ends_.to)
    where = "Compressing fast";
  else if (region.to <= rate_ends_.from)
    where = "Extending fast";
  else if (isZero(region.from, rate_ends_) || region.from > 0.0)
    where = "Compressing";
  else if (isZero(region.to, rate_ends_) || region.to < 0.0)
    where = "Extending";
  describe(where, "travel rate", rate_, rate_ends_, region);
}

bool FailureWording::isZero(double value, const Ends& ends) {
  return std::abs(value) < kNearZero * (ends.to - ends.from);
}

void FailureWording::describe(const std::string& where, const std::string& name, const ReadableUnit& unit,
                              const Ends& ends, FailureRegion& region) const {
  if (region.to >= ends.highest)
    region.region = name + " above " + unit(region.from);
  else if (region.from <= ends.lowest)
    region.region = name + " below " + unit(region.to);
  else
    region.region = name + " " + unit.number(region.from) + " to " + unit(region.to);
  const std::string what = region.mean == 0.0 ? "the model is worst, though not to one side" : push(region.mean);
  region.sentence = where + " (" + region.region + ", " + percent(region.share) + " of the drive) " + what + ": " +
                    errors(region) + ".";
}

void FailureWording::time(std::size_t record, FailureRegion& region) const {
  region.region = time_.number(region.from) + " to " + time_(region.to) + inDrive(record);
  region.sentence = "From " + region.region + " the model is worst: " + errors(region) + ".";
}

void FailureWording::surface(double rate_from, double rate_to, FailureRegion& region) const {
  region.region = "travel " + travel_.number(region.from) + " to " + travel_(region.to) + " at " +
                  rate_.number(rate_from) + " to " + rate_(rate_to);
  region.sentence = std::string("When it ") + (rate_from >= 0.0 ? "compresses" : "extends") + " there (" +
                    region.region + ", " + percent(region.share) + " of the drive) " + push(region.mean) +
                    ", which neither travel nor rate alone shows.";
}

void FailureWording::direction(FailureRegion& region) const {
  region.region = "direction of motion";
  region.sentence = "At the same travel the strut pushes the body up " + acceleration_(std::abs(region.mean)) +
                    (region.mean > 0.0 ? " harder" : " less") +
                    " while it compresses than while it extends, beyond the model's damping: " +
                    (region.mean > 0.0 ? "friction, a part with memory, or more damping than the model has."
                                       : "damping that is not linear, or less of it than the model has.");
}

void FailureWording::frequency(double coherence, double coherence_threshold, FailureRegion& region) const {
  region.region = frequency_.number(region.from) + " to " + frequency_(region.to);
  const char* follows = "it does not follow the wheel in proportion, as friction, stops or loose parts do not";
  if (coherence > coherence_threshold) follows = "a part of it follows the wheel in proportion";
  if (coherence > std::max(kFollows, coherence_threshold))
    follows = "it follows the wheel in proportion, so the model's own numbers are off";
  region.sentence = "Half of what is not noise lies between " + frequency_.number(region.from) + " and " +
                    frequency_(region.to) + " (rmse " + acceleration_(region.rmse) + "); " + follows + ".";
}

void FailureWording::offset(FailureRegion& region) const {
  region.region = "everywhere";
  region.sentence = "Everywhere the body's sensor reads " + acceleration_(std::abs(region.mean)) +
                    (region.mean > 0.0 ? " more" : " less") +
                    " than the wheel's says: an offset or a tilt of a sensor, not the strut.";
}

void FailureWording::drift(const char* name, double first_percent, double last_percent, std::size_t record,
                           FailureRegion& region) const {
  const auto of = [](double change) { return percent(std::abs(change) / 100.0) + (change > 0.0 ? " more" : " less"); };
  region.region =
      std::string(name) + " from " + time_.number(region.from) + " to " + time_(region.to) + inDrive(record);
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
