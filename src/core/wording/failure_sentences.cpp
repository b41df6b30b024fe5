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

/// The range of a quantity, and where the tenth of the samples at either end begins.
struct Ends {
  explicit Ends(const std::vector<ResidualBin>& bins)
      : lowest(bins.front().from),
        from(quantile(bins, kSmall)),
        to(quantile(bins, 1.0 - kSmall)),
        highest(bins.back().to) {}

  bool isZero(double value) const { return std::abs(value) < kNearZero * (to - from); }

  double lowest, from, to, highest;
};

/// How one quantity's regions are called.
struct Places {
  const char *quantity, *top, *bottom, *above, *below, *middle;
};
constexpr Places kTravelPlaces{"travel",         "In deep compression", "Far extended",
                               "In compression", "In extension",        "At mid travel"};
constexpr Places kRatePlaces{"travel rate", "Compressing fast", "Extending fast",
                             "Compressing", "Extending",        "Moving slowly"};

const char* placeOf(const FailureRegion& region, const Ends& ends, const Places& places) {
  if (region.from >= ends.to) return places.top;
  if (region.to <= ends.from) return places.bottom;
  if (ends.isZero(region.from) || region.from > 0.0) return places.above;
  if (ends.isZero(region.to) || region.to < 0.0) return places.below;
  return places.middle;
}

class FailureSentences {
 public:
  FailureSentences(const ResidualViews& views, double noise_floor)
      : travel_ends_(views.travel),
        rate_ends_(views.travel_rate),
        travel_(std::max(std::abs(travel_ends_.from), std::abs(travel_ends_.to)), "m"),
        rate_(ReadableUnit::plain(std::max(std::abs(rate_ends_.from), std::abs(rate_ends_.to)), "m/s")),
        acceleration_(ReadableUnit::plain(views.rms, "m/s^2")),
        time_(ReadableUnit::plain(views.time.back().to, "s")),
        frequency_(ReadableUnit::plain(views.spectrum ? views.spectrum->frequency.back() : 1.0, "Hz")),
        several_drives_(views.time.back().drive > 0),
        noise_floor_(noise_floor),
        coherence_threshold_(views.spectrum ? views.spectrum->coherence_threshold : 1.0) {}

  void describe(FailureRegion& region) const {
    switch (region.view) {
      case FailureView::kOffset: return offset(region);
      case FailureView::kTime: return region.drift == FailureRegion::Drift::kNone ? time(region) : drift(region);
      case FailureView::kTravel: return along(kTravelPlaces, travel_, travel_ends_, region);
      case FailureView::kTravelRate: return along(kRatePlaces, rate_, rate_ends_, region);
      case FailureView::kSurface: return surface(region);
      case FailureView::kDirection: return direction(region);
      case FailureView::kFrequency: return frequency(region);
      case FailureView::kEverywhere: return everywhere(region);
      case FailureView::kNone: return nothing(region);
    }
  }

 private:
  void along(const Places& places, const ReadableUnit& unit, const Ends& ends, FailureRegion& region) const {
    const std::string name = places.quantity;
    if (region.to >= ends.highest)
      region.region = name + " above " + unit(region.from);
    else if (region.from <= ends.lowest)
      region.region = name + " below " + unit(region.to);
    else
      region.region = name + " " + unit.number(region.from) + " to " + unit(region.to);
    const std::string what = region.mean == 0.0 ? "the model is worst, though not to one side" : push(region.mean);
    region.sentence = std::string(placeOf(region, ends, places)) + " (" + region.region + ", " + percent(region.share) +
                      " of the drive) " + what + ": " + errors(region) + ".";
  }

  void time(FailureRegion& region) const {
    region.region = time_.number(region.from) + " to " + time_(region.to) + inDrive(region);
    region.sentence = "From " + region.region + " the model is worst: " + errors(region) + ".";
  }

  void surface(FailureRegion& region) const {
    region.region = "travel " + travel_.number(region.from) + " to " + travel_(region.to) + " at " +
                    rate_.number(region.rate_from) + " to " + rate_(region.rate_to);
    region.sentence = std::string("When it ") + (region.rate_from >= 0.0 ? "compresses" : "extends") + " there (" +
                      region.region + ", " + percent(region.share) + " of the drive) " + push(region.mean) +
                      ", which neither travel nor rate alone shows.";
  }

  void direction(FailureRegion& region) const {
    region.region = "direction of motion";
    region.sentence = "At the same travel the strut pushes the body up " + acceleration_(std::abs(region.mean)) +
                      (region.mean > 0.0 ? " harder" : " less") +
                      " while it compresses than while it extends, beyond the model's damping: " +
                      (region.mean > 0.0 ? "friction, a part with memory, or more damping than the model has."
                                         : "damping that is not linear, or less of it than the model has.");
  }

  void frequency(FailureRegion& region) const {
    region.region = frequency_.number(region.from) + " to " + frequency_(region.to);
    const char* follows = "it does not follow the wheel in proportion, as friction, stops or loose parts do not";
    if (region.coherence > coherence_threshold_) follows = "a part of it follows the wheel in proportion";
    if (region.coherence > std::max(kMajority, coherence_threshold_))
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
    region.region = name + " from " + time_.number(region.from) + " to " + time_(region.to) + inDrive(region);
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
    return several_drives_ ? " of drive " + std::to_string(region.drive + 1) : "";
  }

  std::string errors(const FailureRegion& region) const {
    if (!(region.rmse_elsewhere > 0.0)) return "rmse " + acceleration_(region.rmse);
    return "rmse " + acceleration_.number(region.rmse) + " against " + acceleration_(region.rmse_elsewhere) +
           " elsewhere";
  }

  std::string push(double mean) const {
    return "the strut pushes the body up " + acceleration_(std::abs(mean)) + (mean > 0.0 ? " harder" : " less") +
           " than the model";
  }

  Ends travel_ends_, rate_ends_;
  ReadableUnit travel_, rate_, acceleration_, time_, frequency_;
  bool several_drives_;
  double noise_floor_, coherence_threshold_;
};

}  // namespace

void describeFailures(const ResidualViews& views, double noise_floor, std::vector<FailureRegion>& regions) {
  const FailureSentences sentences(views, noise_floor);
  for (FailureRegion& region : regions) sentences.describe(region);
}

}  // namespace suspension_health_monitor
