#include "suspension_health_monitor/discrepancy/where_it_fails.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "failure_wording.h"

namespace suspension_health_monitor {
namespace {

using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

constexpr double kByChance = 0.001;       // probability that a view names anything without cause
constexpr double kNegligible = 0.25;      // of the noise floor: smaller mean forces are not named
constexpr double kStructured = 0.25;      // of a mean square; below it, what is left counts as noise
constexpr double kContrast = 1.3;         // of rmse in a region to rmse elsewhere
constexpr double kWorthATrend = 0.04;     // change of a parameter over a drive, of its value
constexpr double kBeyondMargins = 0.5;    // of a cell's force: more than travel and rate alone explain
constexpr std::size_t kFewestInBin = 30;
constexpr std::size_t kMostOfAView = 2;

double square(double x) { return x * x; }

/// Normal quantile that chance passes in none of `tests` two-sided tests, but for kByChance.
double limitFor(double tests) {
  const boost::math::normal_distribution<double, InDouble> normal;
  return boost::math::quantile(boost::math::complement(normal, 0.5 * kByChance / tests));
}

/// A run of adjacent bins, summed up.
struct Run {
  std::size_t first = 0, last = 0;  // last is one past the end
  double count = 0.0, sum = 0.0, squares = 0.0;

  void add(const ResidualBin& bin) {
    const auto n = static_cast<double>(bin.count);
    count += n;
    sum += n * bin.mean;
    squares += n * square(bin.rms);
  }
  double mean() const { return sum / count; }
};

class FailureFinder {
 public:
  FailureFinder(const ResidualViews& views, const ExpectedNoise& noise)
      : views_(views), noise_(noise), wording_(views), total_(static_cast<double>(views.num_samples)) {}

  std::vector<FailureRegion> find();

 private:
  bool hasMean(const ResidualBin& bin, double limit) const {
    return bin.count >= kFewestInBin && std::abs(bin.mean) > limit * bin.standard_error &&
           std::abs(bin.mean) > kNegligible * noise_.floor;
  }
  bool isLoud(double mean_square, double count, double limit) const {
    const double chance = 1.0 + limit * std::sqrt(2.0 / std::max(1.0, count * views_.independent_share));
    return mean_square > square(noise_.floor) * chance / (1.0 - kStructured);
  }
  template <class Bin>
  std::vector<Run> runsOfMeans(const std::vector<Bin>& bins) const;
  template <class Bin>
  std::vector<Run> loudRuns(const std::vector<Bin>& bins) const;
  FailureRegion regionOf(FailureView view, const Run& run, double from, double to) const;

  void findOffset();
  void findInTime();
  void findDrift(std::size_t first, std::size_t last);
  void findAlong(FailureView view, const std::vector<ResidualBin>& bins);
  void findOnSurface();
  void findDirection();
  void findFrequency();

  const ResidualViews& views_;
  const ExpectedNoise& noise_;
  FailureWording wording_;
  double total_;
  std::vector<FailureRegion> found_;
};

template <class Bin>
std::vector<Run> FailureFinder::runsOfMeans(const std::vector<Bin>& bins) const {
  const double limit = limitFor(static_cast<double>(bins.size()));
  std::vector<Run> runs;
  int last_sign = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const int sign = !hasMean(bins[i], limit) ? 0 : bins[i].mean > 0.0 ? 1 : -1;
    if (sign != 0 && sign != last_sign) runs.push_back({i, i, 0.0, 0.0, 0.0});
    if (sign != 0) {
      runs.back().add(bins[i]);
      runs.back().last = i + 1;
    }
    last_sign = sign;
  }
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return a.count * square(a.mean()) > b.count * square(b.mean()); });
  if (runs.size() > kMostOfAView) runs.resize(kMostOfAView);
  return runs;
}

template <class Bin>
std::vector<Run> FailureFinder::loudRuns(const std::vector<Bin>& bins) const {
  const double limit = limitFor(static_cast<double>(bins.size()));
  const double whole = square(views_.rms) * total_;
  std::vector<Run> runs;
  bool going_on = false;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    Run alone;
    alone.add(bins[i]);
    const double elsewhere = (whole - alone.squares) / std::max(1.0, total_ - alone.count);
    const bool loud = bins[i].count >= kFewestInBin && isLoud(square(bins[i].rms), alone.count, limit) &&
                      square(bins[i].rms) > square(kContrast) * elsewhere;
    if (loud && !going_on) runs.push_back({i, i, 0.0, 0.0, 0.0});
    if (loud) {
      runs.back().add(bins[i]);
      runs.back().last = i + 1;
    }
    going_on = loud;
  }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.squares > b.squares; });
  if (runs.size() > kMostOfAView) runs.resize(kMostOfAView);
  return runs;
}

FailureRegion FailureFinder::regionOf(FailureView view, const Run& run, double from, double to) const {
  FailureRegion region;
  region.view = view;
  region.rmse = std::sqrt(run.squares / run.count);
  const double others = total_ - run.count;
  const double left = square(views_.rms) * total_ - run.squares;
  if (others > 0.0) region.rmse_elsewhere = std::sqrt(std::max(0.0, left) / others);
  region.share = run.count / total_;
  region.from = from;
  region.to = to;
  return region;
}

void FailureFinder::findOffset() {
  if (std::abs(views_.offset) <= limitFor(1.0) * views_.offset_standard_error ||
      std::abs(views_.offset) <= kNegligible * noise_.floor)
    return;
  FailureRegion region;
  region.view = FailureView::kOffset;
  region.mean = views_.offset;
  region.rmse = std::hypot(views_.offset, views_.rms);
  wording_.offset(region);
  found_.push_back(region);
}

void FailureFinder::findInTime() {
  const std::vector<TimeBin>& bins = views_.time;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= bins.size(); ++i)
    if (i == bins.size() || bins[i].record != bins[first].record) {
      findDrift(first, i);
      first = i;
    }
  for (const Run& run : loudRuns(bins)) {
    const std::size_t record = bins[run.first].record;
    if (bins[run.last - 1].record != record) continue;  // a run over two drives is no stretch of time
    FailureRegion region = regionOf(FailureView::kTime, run, bins[run.first].from, bins[run.last - 1].to);
    wording_.time(record, region);
    found_.push_back(region);
  }
}

/// Inverse-variance weighted mean of a parameter's error.
struct Weighted {
  double weight = 0.0, sum = 0.0;

  void add(double value, double stddev) {
    if (!(stddev > 0.0)) return;
    weight += 1.0 / square(stddev);
    sum += value / square(stddev);
  }
  double mean() const { return sum / weight; }
};

void FailureFinder::findDrift(std::size_t first, std::size_t last) {
  const std::size_t third = (last - first) / 3;
  if (third == 0) return;
  double largest = limitFor(2.0);
  FailureRegion found;
  const auto test = [&](const char* name, double whole, double TimeBin::*error, double TimeBin::*stddev) {
    Weighted begin, end;
    Run run;
    for (std::size_t i = 0; i < third; ++i) {
      begin.add(views_.time[first + i].*error, views_.time[first + i].*stddev);
      end.add(views_.time[last - 1 - i].*error, views_.time[last - 1 - i].*stddev);
    }
    for (std::size_t i = first; i < last; ++i) run.add(views_.time[i]);
    if (!(begin.weight > 0.0 && end.weight > 0.0)) return;
    const double change = end.mean() - begin.mean();
    const double t = std::abs(change) / std::sqrt(1.0 / begin.weight + 1.0 / end.weight);
    if (t <= largest || std::abs(change) <= kWorthATrend * whole) return;
    largest = t;
    found = regionOf(FailureView::kTime, run, views_.time[first].from, views_.time[last - 1].to);
    wording_.drift(name, 100.0 * begin.mean() / whole, 100.0 * end.mean() / whole, views_.time[first].record, found);
  };
  test("damping", noise_.damping_to_mass, &TimeBin::damping_error, &TimeBin::damping_error_stddev);
  test("stiffness", noise_.stiffness_to_mass, &TimeBin::stiffness_error, &TimeBin::stiffness_error_stddev);
  if (!found.sentence.empty()) found_.push_back(found);
}

void FailureFinder::findAlong(FailureView view, const std::vector<ResidualBin>& bins) {
  const auto take = [&](const Run& run, double mean) {
    FailureRegion region = regionOf(view, run, bins[run.first].from, bins[run.last - 1].to);
    region.mean = mean;
    if (view == FailureView::kTravel)
      wording_.travel(region);
    else
      wording_.travelRate(region);
    found_.push_back(region);
  };
  const std::vector<Run> runs = runsOfMeans(bins);
  for (const Run& run : runs) take(run, run.mean());
  if (!runs.empty()) return;
  for (const Run& run : loudRuns(bins)) take(run, 0.0);
}

void FailureFinder::findOnSurface() {
  const ForceSurface& surface = views_.surface;
  const double limit = limitFor(static_cast<double>(surface.mean.size()));
  const Eigen::ArrayXXd counts = surface.count.cast<double>().array();
  const Eigen::ArrayXXd sums = counts * surface.mean.array();
  double largest = 0.0;
  Eigen::Index row = 0, column = 0;
  for (Eigen::Index i = 0; i < sums.rows(); ++i)
    for (Eigen::Index j = 0; j < sums.cols(); ++j) {
      if (surface.count(i, j) < static_cast<int>(kFewestInBin)) continue;
      const double by_travel = sums.row(i).sum() / counts.row(i).sum();
      const double by_rate = sums.col(j).sum() / counts.col(j).sum();
      const double mean = surface.mean(i, j);
      const double beyond = mean - by_travel - by_rate;
      if (std::abs(beyond) <= limit * surface.standard_error(i, j) || beyond * mean <= 0.0 ||
          std::abs(beyond) <= std::max(kNegligible * noise_.floor, kBeyondMargins * std::abs(mean)))
        continue;
      if (counts(i, j) * square(beyond) <= largest) continue;
      largest = counts(i, j) * square(beyond);
      row = i;
      column = j;
    }
  if (largest == 0.0) return;
  FailureRegion region;
  region.view = FailureView::kSurface;
  region.mean = surface.mean(row, column);
  region.share = counts(row, column) / total_;
  region.rmse = surface.rms(row, column);
  region.from = surface.travel_edges[static_cast<std::size_t>(row)];
  region.to = surface.travel_edges[static_cast<std::size_t>(row) + 1];
  wording_.surface(surface.rate_edges[static_cast<std::size_t>(column)],
                   surface.rate_edges[static_cast<std::size_t>(column) + 1], region);
  found_.push_back(region);
}

void FailureFinder::findDirection() {
  const DirectionLoop& loop = views_.direction;
  if (std::abs(loop.gap) <= limitFor(1.0) * loop.gap_standard_error ||
      std::abs(loop.gap) <= kNegligible * noise_.floor)
    return;
  FailureRegion region;
  region.view = FailureView::kDirection;
  region.mean = loop.gap;
  region.rmse = views_.rms;
  wording_.direction(region);
  found_.push_back(region);
}

void FailureFinder::findFrequency() {
  if (!views_.spectrum) return;
  const ResidualSpectrum& spectrum = *views_.spectrum;
  const std::size_t count = spectrum.frequency.size();
  const double width = spectrum.frequency.front();
  const double limit = 1.0 + limitFor(static_cast<double>(count)) / std::sqrt(spectrum.num_averages);
  double whole = 0.0, best = 0.0, excess = 0.0;
  std::size_t from = 0, best_from = 0, best_to = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double above = (spectrum.residual[i] - spectrum.noise[i]) * width;
    if (spectrum.residual[i] <= spectrum.noise[i] * limit / (1.0 - kStructured)) {
      excess = 0.0;
      from = i + 1;
      continue;
    }
    whole += above;
    excess += above;
    if (excess <= best) continue;
    best = excess;
    best_from = from;
    best_to = i + 1;
  }
  if (best <= square(kNegligible * noise_.floor) || best_to == best_from) return;
  double power = 0.0, coherent = 0.0;
  for (std::size_t i = best_from; i < best_to; ++i) {
    power += spectrum.residual[i];
    coherent += spectrum.residual[i] * spectrum.coherence[i];
  }
  FailureRegion region;
  region.view = FailureView::kFrequency;
  region.rmse = std::sqrt(power * width);
  region.from = spectrum.frequency[best_from] - 0.5 * width;
  region.to = spectrum.frequency[best_to - 1] + 0.5 * width;
  wording_.frequency(best / whole, coherent / power, spectrum.coherence_threshold, region);
  found_.push_back(region);
}

std::vector<FailureRegion> FailureFinder::find() {
  findOffset();
  findInTime();
  findAlong(FailureView::kTravel, views_.travel);
  findAlong(FailureView::kTravelRate, views_.travel_rate);
  findOnSurface();
  findDirection();
  findFrequency();
  std::stable_sort(found_.begin(), found_.end(),
                   [](const FailureRegion& a, const FailureRegion& b) { return a.rmse > b.rmse; });
  if (!found_.empty()) return found_;
  FailureRegion region;
  region.rmse = views_.rms;
  const bool noise = !isLoud(square(views_.rms), total_, limitFor(1.0));
  region.view = noise ? FailureView::kNone : FailureView::kEverywhere;
  if (noise)
    wording_.nothing(noise_.floor, region);
  else
    wording_.everywhere(noise_.floor, region);
  return {region};
}

}  // namespace

std::vector<FailureRegion> whereItFails(const ResidualViews& views, const ExpectedNoise& noise) {
  return FailureFinder(views, noise).find();
}

}  // namespace suspension_health_monitor
