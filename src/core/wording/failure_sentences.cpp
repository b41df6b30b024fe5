#include <algorithm>
#include <cmath>
#include <string>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kEdge = 0.005;     // of the samples, in the bins' edges
constexpr double kNearZero = 0.05;  // of the range of most samples

/// Where the bins have passed a share of the samples.
double quantile(const std::vector<ResidualBin>& bins, double share) {
  double all = 0.0, passed = 0.0;
  for (const ResidualBin& bin : bins) all += static_cast<double>(bin.count);
  for (const ResidualBin& bin : bins) {
    passed += static_cast<double>(bin.count);
    if (passed >= (share - kEdge) * all) return bin.to;
  }
  return bins.back().to;
}

/// The range of travel or of travel rate, and where the tenth of the samples at either end begins.
struct Quantity {
  Quantity(const std::vector<ResidualBin>& bins, bool of_travel)
      : is_travel(of_travel),
        lowest(bins.front().from),
        from(quantile(bins, kSmall)),
        to(quantile(bins, 1.0 - kSmall)),
        highest(bins.back().to),
        unit(is_travel ? ReadableUnit(largest(), "m") : ReadableUnit::plain(largest(), "m/s")) {}

  double largest() const { return std::max(std::abs(from), std::abs(to)); }

  const char* placeOf(const FailureRegion& region) const {
    const auto is_zero = [&](double value) { return std::abs(value) < kNearZero * (to - from); };
    if (region.from >= to) return is_travel ? "In deep compression" : "Compressing fast";
    if (region.to <= from) return is_travel ? "Far extended" : "Extending fast";
    if (is_zero(region.from) || region.from > 0.0) return is_travel ? "In compression" : "Compressing";
    if (is_zero(region.to) || region.to < 0.0) return is_travel ? "In extension" : "Extending";
    return is_travel ? "At mid travel" : "Moving slowly";
  }

  bool is_travel;
  double lowest, from, to, highest;
  ReadableUnit unit;
};

/// @return e.g. "10 to 20 mm".
std::string rangeIn(const ReadableUnit& unit, double from, double to) { return unit.number(from) + " to " + unit(to); }

class FailureSentences {
 public:
  FailureSentences(const ResidualViews& views, double noise_floor) : views_(views), noise_floor_(noise_floor) {}

  void describe(FailureRegion& region) const {
    switch (region.view) {
      case FailureView::kOffset: return offset(region);
      case FailureView::kTime: return region.drift == FailureRegion::Drift::kNone ? time(region) : drift(region);
      case FailureView::kTravel: return along(travel_, region);
      case FailureView::kTravelRate: return along(rate_, region);
      case FailureView::kSurface: return surface(region);
      case FailureView::kDirection: return direction(region);
      case FailureView::kFrequency: return frequency(region);
      case FailureView::kEverywhere: return everywhere(region);
      case FailureView::kNone: return nothing(region);
    }
  }

 private:
  void along(const Quantity& quantity, FailureRegion& region) const {
    const ReadableUnit& unit = quantity.unit;
    std::string range = " " + rangeIn(unit, region.from, region.to);
    if (region.from <= quantity.lowest) range = " below " + unit(region.to);
    if (region.to >= quantity.highest) range = " above " + unit(region.from);
    region.region = (quantity.is_travel ? "travel" : "travel rate") + range;
    const std::string what = region.mean == 0.0 ? "the model is worst, though not to one side" : push(region.mean);
    region.sentence = std::string(quantity.placeOf(region)) + " (" + region.region + ", " + percent(region.share) +
                      " of the drive) " + what + ": " + errors(region) + ".";
  }

  void time(FailureRegion& region) const {
    region.region = rangeIn(time_, region.from, region.to) + inDrive(region);
    region.sentence = "From " + region.region + " the model is worst: " + errors(region) + ".";
  }

  void surface(FailureRegion& region) const {
    region.region = "travel " + rangeIn(travel_.unit, region.from, region.to) + " at " +
                    rangeIn(rate_.unit, region.rate_from, region.rate_to);
    region.sentence = std::string("When it ") + (region.rate_from >= 0.0 ? "compresses" : "extends") + " there (" +
                      region.region + ", " + percent(region.share) + " of the drive) " + push(region.mean) +
                      ", which neither travel nor rate alone shows.";
  }

  void direction(FailureRegion& region) const {
    region.region = "direction of motion";
    region.sentence = "At the same travel " + pushes(region.mean) +
                      " while it compresses than while it extends, beyond the model's damping: " +
                      (region.mean > 0.0 ? "friction, a part with memory, or more damping than the model has."
                                         : "damping that is not linear, or less of it than the model has.");
  }

  void frequency(FailureRegion& region) const {
    region.region = rangeIn(frequency_, region.from, region.to);
    const double threshold = views_.spectrum ? views_.spectrum->coherence_threshold : 1.0;
    const char* follows = "it does not follow the wheel in proportion, as friction, stops or loose parts do not";
    if (region.coherence > threshold) follows = "a part of it follows the wheel in proportion";
    if (region.coherence > std::max(kMajority, threshold))
      follows = "it follows the wheel in proportion, so the model's own numbers are off";
    region.sentence = "Half of what is not noise lies between " + frequency_.number(region.from) + " and " +
                      frequency_(region.to) + " (rmse " + acceleration_(region.rmse) + "); " + follows + ".";
  }

  void offset(FailureRegion& region) const {
    region.region = "everywhere";
    region.sentence = "Everywhere the body's sensor reads " + acceleration_(std::abs(region.mean)) +
                      (region.mean > 0.0 ? " more" : " less") +
                      " than the wheel's says: an offset or a tilt of a sensor, not the strut.";
  }

  void drift(FailureRegion& region) const {
    const std::string name = region.drift == FailureRegion::Drift::kDamping ? "damping" : "stiffness";
    const auto of = [](double change) { return percent(std::abs(change)) + (change > 0.0 ? " more" : " less"); };
    region.region = name + " from " + rangeIn(time_, region.from, region.to) + inDrive(region);
    region.sentence = "The " + name + " seems to change during the drive" + inDrive(region) + ": in its first third " +
                      of(region.first_third) + " than the model has, in its last third " + of(region.last_third) + ".";
  }

  void everywhere(FailureRegion& region) const {
    region.region = "everywhere";
    region.sentence = "The model leaves more than noise (rmse " + acceleration_(region.rmse) + ", noise alone " +
                      acceleration_(noise_floor_) + "), but no region stands out.";
  }

  void nothing(FailureRegion& region) const {
    region.region = "nowhere";
    region.sentence = "What the model leaves is noise: rmse " + acceleration_(region.rmse) +
                      ", noise alone would leave about " + acceleration_(noise_floor_) + ".";
  }

  std::string inDrive(const FailureRegion& region) const {
    return views_.time.back().drive > 0 ? " of drive " + std::to_string(region.drive + 1) : "";
  }

  std::string errors(const FailureRegion& region) const {
    if (!(region.rmse_elsewhere > 0.0)) return "rmse " + acceleration_(region.rmse);
    return "rmse " + acceleration_.number(region.rmse) + " against " + acceleration_(region.rmse_elsewhere) +
           " elsewhere";
  }

  std::string pushes(double mean) const {
    return "the strut pushes the body up " + acceleration_(std::abs(mean)) + (mean > 0.0 ? " harder" : " less");
  }

  std::string push(double mean) const { return pushes(mean) + " than the model"; }

  const ResidualViews& views_;
  double noise_floor_;
  Quantity travel_{views_.travel, true}, rate_{views_.travel_rate, false};
  ReadableUnit acceleration_ = ReadableUnit::plain(views_.rms, "m/s^2");
  ReadableUnit time_ = ReadableUnit::plain(views_.time.back().to, "s");
  ReadableUnit frequency_ = ReadableUnit::plain(views_.spectrum ? views_.spectrum->frequency.back() : 1.0, "Hz");
};

}  // namespace

void describeFailures(const ResidualViews& views, double noise_floor, std::vector<FailureRegion>& regions) {
  const FailureSentences sentences(views, noise_floor);
  for (FailureRegion& region : regions) sentences.describe(region);
}

}  // namespace suspension_health_monitor
