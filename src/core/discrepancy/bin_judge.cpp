#include "bin_judge.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>

namespace suspension_health_monitor {
namespace {

// Not in long double: its tables cannot be set up where that is no longer than double, under valgrind for one.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

constexpr double kByChance = 0.001;   // that a view names anything without cause
constexpr double kNegligible = 0.25;  // of the noise floor: smaller mean forces are not named
constexpr double kStructured = 0.25;  // of a mean square; below it, what is left counts as noise
constexpr std::size_t kFewestInBin = 30;
constexpr std::size_t kMostRuns = 2;

double square(double x) { return x * x; }

/// Runs of adjacent bins with the same mark; mark 0 is no run.
std::vector<BinRun> runsOf(const std::vector<ResidualBin>& bins, const std::vector<int>& marks) {
  std::vector<BinRun> runs;
  int before = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (marks[i] != 0 && marks[i] != before) runs.push_back({i, i, 0.0, 0.0, 0.0});
    if (marks[i] != 0) {
      runs.back().add(bins[i]);
      runs.back().last = i + 1;
    }
    before = marks[i];
  }
  return runs;
}

}  // namespace

BinJudge::BinJudge(const ResidualViews& views, const ExpectedNoise& noise) : views_(views), noise_(noise) {}

double BinJudge::limitFor(double tests) {
  const boost::math::normal_distribution<double, InDouble> normal;
  return boost::math::quantile(boost::math::complement(normal, 0.5 * kByChance / tests));
}

bool BinJudge::isForce(double mean, double standard_error, double limit) const {
  return std::abs(mean) > std::max(limit * standard_error, kNegligible * noise_.floor);
}

bool BinJudge::isLoud(double mean_square, double count, double limit) const {
  const double chance = 1.0 + limit * std::sqrt(2.0 / std::max(1.0, count * views_.independent_share));
  return mean_square > square(noise_.floor) * chance / (1.0 - kStructured);
}

double BinJudge::rmsElsewhere(const BinRun& run) const {
  const double left = square(views_.rms) * numSamples() - run.squares;
  return numSamples() > run.count ? std::sqrt(std::max(0.0, left) / (numSamples() - run.count)) : 0.0;
}

std::vector<BinRun> BinJudge::forces(const std::vector<ResidualBin>& bins) const {
  const double limit = limitFor(static_cast<double>(bins.size()));
  std::vector<int> signs;
  for (const ResidualBin& bin : bins) {
    const bool acts = bin.count >= kFewestInBin && isForce(bin.mean, bin.standard_error, limit);
    signs.push_back(!acts ? 0 : bin.mean > 0.0 ? 1 : -1);
  }
  std::vector<BinRun> runs = runsOf(bins, signs);
  std::sort(runs.begin(), runs.end(),
            [](const BinRun& a, const BinRun& b) { return a.count * square(a.mean()) > b.count * square(b.mean()); });
  if (runs.size() > kMostRuns) runs.resize(kMostRuns);
  // Where a fit makes up for a force elsewhere, the model is wrong, too, but this is not where it fails.
  if (runs.size() == kMostRuns && runs.back().rms() < rmsElsewhere(runs.back())) runs.pop_back();
  return runs;
}

std::vector<BinRun> BinJudge::loud(const std::vector<ResidualBin>& bins, double contrast) const {
  const double limit = limitFor(static_cast<double>(bins.size()));
  std::vector<int> marks;
  for (const ResidualBin& bin : bins) {
    BinRun alone;
    alone.add(bin);
    marks.push_back(bin.count >= kFewestInBin && isLoud(square(bin.rms), alone.count, limit) &&
                    bin.rms > contrast * rmsElsewhere(alone));
  }
  std::vector<BinRun> runs = runsOf(bins, marks);
  std::sort(runs.begin(), runs.end(), [](const BinRun& a, const BinRun& b) { return a.squares > b.squares; });
  if (runs.size() > kMostRuns) runs.resize(kMostRuns);
  return runs;
}

}  // namespace suspension_health_monitor
