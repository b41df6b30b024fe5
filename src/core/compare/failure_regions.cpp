#include <algorithm>
#include <cmath>

#include "noise_test.h"
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kContrastInTime = 1.5;  // of rmse in a region to rmse elsewhere
constexpr double kContrast = 2.0;        // the same over travel or rate
constexpr double kWorthATrend = 0.08;    // change of a parameter over a drive, of its value
constexpr double kBeyondMargins = 0.5;   // of a cell's force: more than travel and rate alone explain
constexpr double kBand = 0.5;            // of what is not noise, in the band that is named

class FailureFinder {
 public:
  FailureFinder(const ResidualViews& views, const LinearStrut& strut, double noise_floor)
      : views_(views), strut_(strut), noise_floor_(noise_floor), test_(views, noise_floor) {}

  std::vector<FailureRegion> find();

 private:
  FailureRegion regionOf(FailureView view, const BinRange& range, double from, double to) const;
  void findOffset();
  void findInTime(std::size_t first, std::size_t last);  // bins of one drive
  bool findDrift(std::size_t first, std::size_t last);
  void findAlong(FailureView view, const std::vector<ResidualBin>& bins);
  void findOnSurface();
  void findDirection();
  void findFrequency();
  FailureRegion conclude() const;

  const ResidualViews& views_;
  const LinearStrut& strut_;
  double noise_floor_;
  NoiseTest test_;
  bool drifts_ = false;
  std::vector<FailureRegion> found_;
};

FailureRegion FailureFinder::regionOf(FailureView view, const BinRange& range, double from, double to) const {
  FailureRegion region;
  region.view = view;
  region.rmse = range.rms();
  region.rmse_elsewhere = test_.rmsElsewhere(range);
  region.share = range.count / test_.numSamples();
  region.from = from;
  region.to = to;
  return region;
}

void FailureFinder::findOffset() {
  if (!test_.isForce(views_.offset, views_.offset_standard_error, NoiseTest::limitFor(1.0))) return;
  FailureRegion region;
  region.view = FailureView::kOffset;
  region.mean = views_.offset;
  region.rmse = std::hypot(views_.offset, views_.rms);
  found_.push_back(region);
}

void FailureFinder::findInTime(std::size_t first, std::size_t last) {
  if (findDrift(first, last)) return;
  const std::vector<ResidualBin> bins(views_.time.begin() + static_cast<std::ptrdiff_t>(first),
                                      views_.time.begin() + static_cast<std::ptrdiff_t>(last));
  for (const BinRange& range : test_.noisy(bins, kContrastInTime)) {
    FailureRegion region = regionOf(FailureView::kTime, range, bins[range.first].from, bins[range.last - 1].to);
    region.drive = views_.time[first].drive;
    found_.push_back(region);
  }
}

/// Inverse-variance weighted mean of a parameter's error.
struct WeightedError {
  double weight = 0.0, sum = 0.0;

  void add(double value, double stddev) {
    if (!(stddev > 0.0)) return;
    weight += 1.0 / square(stddev);
    sum += value / square(stddev);
  }
  double mean() const { return sum / weight; }
};

bool FailureFinder::findDrift(std::size_t first, std::size_t last) {
  const std::size_t third = (last - first) / 3;
  double largest = NoiseTest::limitFor(2.0);
  FailureRegion found;
  const auto test = [&](FailureRegion::Drift drift, double whole, double TimeBin::*error, double TimeBin::*stddev) {
    WeightedError begin, end;
    BinRange range;
    for (std::size_t i = 0; i < third; ++i)
      for (const std::size_t bin : {first + i, last - 1 - i}) {
        (bin == first + i ? begin : end).add(views_.time[bin].*error, views_.time[bin].*stddev);
        range.add(views_.time[bin]);
      }
    if (!(begin.weight > 0.0 && end.weight > 0.0)) return;
    const double change = end.mean() - begin.mean();
    const double t = std::abs(change) / std::sqrt(1.0 / begin.weight + 1.0 / end.weight);
    if (t <= largest || std::abs(change) <= kWorthATrend * whole) return;
    largest = t;
    found = regionOf(FailureView::kTime, range, views_.time[first].from, views_.time[last - 1].to);
    found.drive = views_.time[first].drive;
    found.drift = drift;
    found.first_third = begin.mean() / whole;
    found.last_third = end.mean() / whole;
  };
  test(FailureRegion::Drift::kDamping, strut_.damping_to_mass, &TimeBin::damping_error, &TimeBin::damping_error_stddev);
  test(FailureRegion::Drift::kStiffness, strut_.stiffness_to_mass, &TimeBin::stiffness_error,
       &TimeBin::stiffness_error_stddev);
  if (found.drift == FailureRegion::Drift::kNone) return false;
  found_.push_back(found);
  drifts_ = true;
  return true;
}

void FailureFinder::findAlong(FailureView view, const std::vector<ResidualBin>& bins) {
  const auto take = [&](const BinRange& range, double mean) {
    FailureRegion region = regionOf(view, range, bins[range.first].from, bins[range.last - 1].to);
    region.mean = mean;
    found_.push_back(region);
  };
  const std::vector<BinRange> forces = test_.forces(bins);
  for (const BinRange& range : forces) take(range, range.mean());
  if (!forces.empty() || drifts_) return;  // large motion has larger errors, too, when a parameter moves
  for (const BinRange& range : test_.noisy(bins, kContrast)) take(range, 0.0);
}

void FailureFinder::findOnSurface() {
  const ForceSurface& surface = views_.surface;
  const double limit = NoiseTest::limitFor(static_cast<double>(surface.mean.size()));
  const Eigen::ArrayXXd counts = surface.count.cast<double>().array();
  const Eigen::ArrayXXd sums = counts * surface.mean.array();
  double largest = 0.0;
  Eigen::Index row = 0, column = 0;
  for (Eigen::Index i = 0; i < sums.rows(); ++i)
    for (Eigen::Index j = 0; j < sums.cols(); ++j) {
      if (surface.count(i, j) < NoiseTest::kFewest) continue;
      const double by_travel = sums.row(i).sum() / counts.row(i).sum();
      const double by_rate = sums.col(j).sum() / counts.col(j).sum();
      const double mean = surface.mean(i, j);
      const double beyond = mean - by_travel - by_rate;
      const double error = surface.standard_error(i, j);
      const bool named = test_.isForce(beyond, error, limit) && test_.isForce(mean, error, limit) &&
                         beyond * mean > kBeyondMargins * square(mean);
      if (!named || counts(i, j) * square(beyond) <= largest) continue;
      largest = counts(i, j) * square(beyond);
      row = i;
      column = j;
    }
  if (largest == 0.0) return;
  FailureRegion region;
  region.view = FailureView::kSurface;
  region.mean = surface.mean(row, column);
  region.share = counts(row, column) / test_.numSamples();
  region.rmse = surface.rms(row, column);
  region.from = surface.travel_edges[static_cast<std::size_t>(row)];
  region.to = surface.travel_edges[static_cast<std::size_t>(row) + 1];
  region.rate_from = surface.rate_edges[static_cast<std::size_t>(column)];
  region.rate_to = surface.rate_edges[static_cast<std::size_t>(column) + 1];
  found_.push_back(region);
}

void FailureFinder::findDirection() {
  const DirectionLoop& loop = views_.direction;
  if (!test_.isForce(loop.gap, loop.gap_standard_error, NoiseTest::limitFor(1.0))) return;
  FailureRegion region;
  region.view = FailureView::kDirection;
  region.mean = loop.gap;
  region.rmse = views_.rms;
  found_.push_back(region);
}

/// The narrowest band that holds a share of a density, as [first, last).
std::pair<std::size_t, std::size_t> narrowestBand(const std::vector<double>& density, double share) {
  double whole = 0.0;
  for (const double value : density) whole += value;
  std::pair<std::size_t, std::size_t> best{0, density.size()};
  double inside = 0.0;
  for (std::size_t first = 0, last = 0; last < density.size();) {
    inside += density[last++];
    while (inside - density[first] >= share * whole) inside -= density[first++];
    if (inside >= share * whole && last - first < best.second - best.first) best = {first, last};
  }
  return best;
}

void FailureFinder::findFrequency() {
  if (!views_.spectrum) return;
  const ResidualSpectrum& spectrum = *views_.spectrum;
  const double width = spectrum.frequency.front();
  const double limit = NoiseTest::limitFor(static_cast<double>(spectrum.frequency.size()));
  std::vector<double> above;  // the noise, where that is sure
  double excess = 0.0;
  for (std::size_t i = 0; i < spectrum.frequency.size(); ++i) {
    const double samples_worth = 2.0 * spectrum.num_averages / views_.independent_share;
    const bool loud =
        test_.exceedsNoise(spectrum.residual[i] / spectrum.noise[i] * square(noise_floor_), samples_worth, limit);
    above.push_back(loud ? spectrum.residual[i] - spectrum.noise[i] : 0.0);
    excess += above.back() * width;
  }
  if (!test_.isForce(std::sqrt(excess), 0.0, limit)) return;
  const auto [first, last] = narrowestBand(above, kBand);
  double power = 0.0, coherent = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    power += spectrum.residual[i];
    coherent += spectrum.residual[i] * spectrum.coherence[i];
  }
  FailureRegion region;
  region.view = FailureView::kFrequency;
  region.rmse = std::sqrt(power * width);
  region.from = spectrum.frequency[first] - 0.5 * width;
  region.to = spectrum.frequency[last - 1] + 0.5 * width;
  region.coherence = coherent / power;
  found_.push_back(region);
}

FailureRegion FailureFinder::conclude() const {
  FailureRegion region;
  region.rmse = views_.rms;
  const bool more = test_.exceedsNoise(square(views_.rms), test_.numSamples(), NoiseTest::limitFor(1.0));
  region.view = more ? FailureView::kEverywhere : FailureView::kNone;
  return region;
}

std::vector<FailureRegion> FailureFinder::find() {
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

}  // namespace

std::vector<FailureRegion> findFailures(const ResidualViews& views, const LinearStrut& strut, double noise_floor) {
  return FailureFinder(views, strut, noise_floor).find();
}

}  // namespace suspension_health_monitor
