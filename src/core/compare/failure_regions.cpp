#include <algorithm>
#include <cmath>

#include "bin_range.h"
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/compare/tuning.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

class FailureFinder {
 public:
  FailureFinder(const ResidualViews& views, const LinearStrut& strut, double noise_floor)
      : views_(views), strut_(strut), noise_floor_(noise_floor) {}

  std::vector<FailureRegion> find() {
    findOffset();
    for (std::size_t first = 0, i = 1; i <= views_.time.size(); ++i)
      if (i == views_.time.size() || views_.time[i].drive != views_.time[first].drive) {
        findInTime(first, i);
        first = i;
      }
    findAlong(FailureView::kTravel, views_.travel);
    findAlong(FailureView::kTravelRate, views_.travel_rate);
    findOnSurface();
    findDirection();
    findFrequency();
    if (found_.empty()) return {conclude()};
    std::stable_sort(found_.begin(), found_.end(),
                     [](const FailureRegion& a, const FailureRegion& b) { return a.rmse > b.rmse; });
    return found_;
  }

 private:
  /// @return true if a mean is beyond chance, and more than a quarter of the noise floor.
  bool isForce(double mean, double standard_error, double limit) const {
    return std::abs(mean) > std::max(limit * standard_error, kCompareTuning.negligible * noise_floor_);
  }

  /// @return true if a mean square is more than noise: significantly, and by so much that what is
  /// left counts as structure (kStructured).
  bool exceedsNoise(double mean_square, double count, double limit) const {
    const double chance = 1.0 + limit * std::sqrt(2.0 / std::max(1.0, count * views_.independent_share));
    return mean_square > square(noise_floor_) * chance / (1.0 - kStructured);
  }

  /// @return rms of the samples that a range leaves out; 0 if there are none.
  double rmsElsewhere(const BinRange& range) const {
    const double elsewhere = square(views_.rms) * numSamples() - range.squares;
    return numSamples() > range.count ? std::sqrt(std::max(0.0, elsewhere) / (numSamples() - range.count)) : 0.0;
  }

  /// @return the two ranges that have most of something, the one with more first.
  template <class Measure>
  static std::vector<BinRange> strongest(std::vector<BinRange> ranges, const Measure& measure) {
    std::sort(ranges.begin(), ranges.end(),
              [&](const BinRange& a, const BinRange& b) { return measure(a) > measure(b); });
    ranges.erase(ranges.begin() + std::min(ranges.size(), kCompareTuning.most_ranges), ranges.end());
    return ranges;
  }

  /// @return the two ranges of bins with a force of one sign that hold most of it, the stronger first. The second only
  /// if the model is not better in it than elsewhere.
  std::vector<BinRange> forces(const std::vector<ResidualBin>& bins) const {
    const double limit = limitFor(static_cast<double>(bins.size()));
    std::vector<int> signs;
    for (const ResidualBin& bin : bins) {
      const bool acts = bin.count >= kCompareTuning.fewest_samples && isForce(bin.mean, bin.standard_error, limit);
      signs.push_back(!acts ? 0 : bin.mean > 0.0 ? 1 : -1);
    }
    std::vector<BinRange> ranges =
        strongest(rangesOf(bins, signs), [](const BinRange& range) { return range.count * square(range.mean()); });
    // Where a fit makes up for a force elsewhere, the model is wrong, too, but this is not where it fails.
    if (ranges.size() == kCompareTuning.most_ranges && ranges.back().rms() < rmsElsewhere(ranges.back()))
      ranges.pop_back();
    return ranges;
  }

  /// @return the two ranges of bins whose residual is more than noise, those that hold most of it, each with `contrast`
  /// times the rms of the samples elsewhere.
  std::vector<BinRange> noisy(const std::vector<ResidualBin>& bins, double contrast) const {
    const double limit = limitFor(static_cast<double>(bins.size()));
    std::vector<int> marks;
    for (const ResidualBin& bin : bins) {
      BinRange alone;
      alone.add(bin);
      marks.push_back(bin.count >= kCompareTuning.fewest_samples && exceedsNoise(square(bin.rms), alone.count, limit) &&
                      bin.rms > contrast * rmsElsewhere(alone));
    }
    return strongest(rangesOf(bins, marks), [](const BinRange& range) { return range.squares; });
  }

  double numSamples() const { return static_cast<double>(views_.num_samples); }

  FailureRegion regionOf(FailureView view, const BinRange& range) const {
    FailureRegion region;
    region.view = view;
    region.rmse = range.rms();
    region.rmse_elsewhere = rmsElsewhere(range);
    region.share = range.count / numSamples();
    region.from = range.from;
    region.to = range.to;
    return region;
  }

  FailureRegion& add(FailureView view, const BinRange& range) { return found_.emplace_back(regionOf(view, range)); }

  FailureRegion& add(FailureView view, double rmse) {
    FailureRegion& region = found_.emplace_back();
    region.view = view;
    region.rmse = rmse;
    return region;
  }

  void findOffset() {
    if (isForce(views_.offset, views_.offset_standard_error, limitFor(1.0)))
      add(FailureView::kOffset, std::hypot(views_.offset, views_.rms)).mean = views_.offset;
  }

  void findInTime(std::size_t first, std::size_t last) {
    if (findDrift(first, last)) return;
    const std::vector<ResidualBin> bins(views_.time.begin() + first, views_.time.begin() + last);
    for (const BinRange& range : noisy(bins, kCompareTuning.contrast_in_time))
      add(FailureView::kTime, range).drive = views_.time[first].drive;
  }

  bool findDrift(std::size_t first, std::size_t last) {
    const std::size_t third = (last - first) / 3;
    double largest = limitFor(2.0);
    FailureRegion found;
    const auto test = [&](FailureRegion::Drift drift, double whole, double TimeBin::*error, double TimeBin::*stddev) {
      double weights[2] = {}, means[2] = {};  // of the first and the last third, by inverse variance
      BinRange range;
      for (std::size_t i = 0; i < third; ++i)
        for (const std::size_t bin : {first + i, last - 1 - i}) {
          range.add(views_.time[bin]);
          const int part = bin == first + i ? 0 : 1;
          const double precision = 1.0 / square(views_.time[bin].*stddev);
          if (!(precision > 0.0 && std::isfinite(precision))) continue;
          weights[part] += precision;
          means[part] += precision / weights[part] * (views_.time[bin].*error - means[part]);
        }
      if (!(weights[0] > 0.0 && weights[1] > 0.0)) return;
      const double change = means[1] - means[0];
      const double t = std::abs(change) / std::sqrt(1.0 / weights[0] + 1.0 / weights[1]);
      if (t <= largest || std::abs(change) <= kCompareTuning.least_trend * whole) return;
      largest = t;
      range.from = views_.time[first].from;
      range.to = views_.time[last - 1].to;
      found = regionOf(FailureView::kTime, range);
      found.drive = views_.time[first].drive;
      found.drift = drift;
      found.first_third = means[0] / whole;
      found.last_third = means[1] / whole;
    };
    test(FailureRegion::Drift::kDamping, strut_.damping_to_mass, &TimeBin::damping_error,
         &TimeBin::damping_error_stddev);
    test(FailureRegion::Drift::kStiffness, strut_.stiffness_to_mass, &TimeBin::stiffness_error,
         &TimeBin::stiffness_error_stddev);
    if (found.drift == FailureRegion::Drift::kNone) return false;
    found_.push_back(found);
    drifts_ = true;
    return true;
  }

  void findAlong(FailureView view, const std::vector<ResidualBin>& bins) {
    const std::vector<BinRange> found = forces(bins);
    for (const BinRange& range : found) add(view, range).mean = range.mean();
    if (!found.empty() || drifts_) return;  // large motion has larger errors, too, when a parameter moves
    for (const BinRange& range : noisy(bins, kClearlyMore)) add(view, range);
  }

  void findOnSurface() {
    const ForceSurface& surface = views_.surface;
    const double limit = limitFor(static_cast<double>(surface.mean.size()));
    const Eigen::ArrayXXd counts = surface.count.cast<double>().array();
    const Eigen::ArrayXXd sums = counts * surface.mean.array();
    double largest = 0.0;
    FailureRegion region;
    for (Eigen::Index i = 0; i < sums.rows(); ++i)
      for (Eigen::Index j = 0; j < sums.cols(); ++j) {
        if (surface.count(i, j) < static_cast<int>(kCompareTuning.fewest_samples)) continue;
        const double by_travel = sums.row(i).sum() / counts.row(i).sum();
        const double by_rate = sums.col(j).sum() / counts.col(j).sum();
        const double mean = surface.mean(i, j);
        const double beyond = mean - by_travel - by_rate;
        const double error = surface.standard_error(i, j);
        const bool named =
            isForce(beyond, error, limit) && isForce(mean, error, limit) && beyond * mean > kMajority * square(mean);
        if (!named || counts(i, j) * square(beyond) <= largest) continue;
        largest = counts(i, j) * square(beyond);
        region.view = FailureView::kSurface;
        region.rmse = surface.rms(i, j);
        region.mean = mean;
        region.share = counts(i, j) / numSamples();
        region.from = surface.travel_edges[i];
        region.to = surface.travel_edges[i + 1];
        region.rate_from = surface.rate_edges[j];
        region.rate_to = surface.rate_edges[j + 1];
      }
    if (largest > 0.0) found_.push_back(region);
  }

  void findDirection() {
    const DirectionLoop& loop = views_.direction;
    if (isForce(loop.gap, loop.gap_standard_error, limitFor(1.0)))
      add(FailureView::kDirection, views_.rms).mean = loop.gap;
  }

  void findFrequency() {
    if (!views_.spectrum) return;
    const ResidualSpectrum& spectrum = *views_.spectrum;
    const double width = spectrum.frequency.front();
    const double limit = limitFor(static_cast<double>(spectrum.frequency.size()));
    std::vector<double> above;  // the noise, where that is sure
    double excess = 0.0;
    for (std::size_t i = 0; i < spectrum.frequency.size(); ++i) {
      const double samples_worth = 2.0 * spectrum.num_averages / views_.independent_share;
      const bool loud =
          exceedsNoise(spectrum.residual[i] / spectrum.noise[i] * square(noise_floor_), samples_worth, limit);
      above.push_back(loud ? spectrum.residual[i] - spectrum.noise[i] : 0.0);
      excess += above.back() * width;
    }
    if (!isForce(std::sqrt(excess), 0.0, limit)) return;
    const auto [first, last] = narrowestBand(above, kMajority);
    double power = 0.0, coherent = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      power += spectrum.residual[i];
      coherent += spectrum.residual[i] * spectrum.coherence[i];
    }
    FailureRegion& region = add(FailureView::kFrequency, std::sqrt(power * width));
    region.from = spectrum.frequency[first] - 0.5 * width;
    region.to = spectrum.frequency[last - 1] + 0.5 * width;
    region.coherence = coherent / power;
  }

  FailureRegion conclude() const {
    FailureRegion region;
    region.rmse = views_.rms;
    const bool more = exceedsNoise(square(views_.rms), numSamples(), limitFor(1.0));
    region.view = more ? FailureView::kEverywhere : FailureView::kNone;
    return region;
  }

  const ResidualViews& views_;
  const LinearStrut& strut_;
  double noise_floor_;
  bool drifts_ = false;
  std::vector<FailureRegion> found_;
};

}  // namespace

std::vector<FailureRegion> findFailures(const ResidualViews& views, const LinearStrut& strut, double noise_floor) {
  return FailureFinder(views, strut, noise_floor).find();
}

}  // namespace suspension_health_monitor
