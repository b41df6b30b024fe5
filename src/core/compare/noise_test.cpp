#include "noise_test.h"

#include <algorithm>

#include "suspension_health_monitor/internal/fit/noise_floor.h"

namespace suspension_health_monitor {
namespace {

constexpr double kNegligible = 0.25;  // of the noise floor: smaller mean forces are not named
constexpr std::size_t kMostRanges = 2;

/// Ranges of adjacent bins with the same mark; mark 0 is none.
std::vector<BinRange> rangesOf(const std::vector<ResidualBin>& bins, const std::vector<int>& marks) {
  std::vector<BinRange> ranges;
  int before = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (marks[i] != 0 && marks[i] != before) ranges.push_back({i, i, 0.0, 0.0, 0.0});
    if (marks[i] != 0) {
      ranges.back().add(bins[i]);
      ranges.back().last = i + 1;
    }
    before = marks[i];
  }
  return ranges;
}

}  // namespace

NoiseTest::NoiseTest(const ResidualViews& views, double noise_floor) : views_(views), noise_floor_(noise_floor) {}

bool NoiseTest::isForce(double mean, double standard_error, double limit) const {
  return std::abs(mean) > std::max(limit * standard_error, kNegligible * noise_floor_);
}

bool NoiseTest::exceedsNoise(double mean_square, double count, double limit) const {
  const double chance = 1.0 + limit * std::sqrt(2.0 / std::max(1.0, count * views_.independent_share));
  return mean_square > square(noise_floor_) * chance / (1.0 - kStructured);
}

double NoiseTest::rmsElsewhere(const BinRange& range) const {
  const double left = square(views_.rms) * numSamples() - range.squares;
  return numSamples() > range.count ? std::sqrt(std::max(0.0, left) / (numSamples() - range.count)) : 0.0;
}

std::vector<BinRange> NoiseTest::forces(const std::vector<ResidualBin>& bins) const {
  const double limit = limitFor(static_cast<double>(bins.size()));
  std::vector<int> signs;
  for (const ResidualBin& bin : bins) {
    const bool acts = bin.count >= std::size_t{kFewest} && isForce(bin.mean, bin.standard_error, limit);
    signs.push_back(!acts ? 0 : bin.mean > 0.0 ? 1 : -1);
  }
  std::vector<BinRange> ranges = rangesOf(bins, signs);
  std::sort(ranges.begin(), ranges.end(), [](const BinRange& a, const BinRange& b) {
    return a.count * square(a.mean()) > b.count * square(b.mean());
  });
  if (ranges.size() > kMostRanges) ranges.resize(kMostRanges);
  // Where a fit makes up for a force elsewhere, the model is wrong, too, but this is not where it fails.
  if (ranges.size() == kMostRanges && ranges.back().rms() < rmsElsewhere(ranges.back())) ranges.pop_back();
  return ranges;
}

std::vector<BinRange> NoiseTest::noisy(const std::vector<ResidualBin>& bins, double contrast) const {
  const double limit = limitFor(static_cast<double>(bins.size()));
  std::vector<int> marks;
  for (const ResidualBin& bin : bins) {
    BinRange alone;
    alone.add(bin);
    marks.push_back(bin.count >= std::size_t{kFewest} && exceedsNoise(square(bin.rms), alone.count, limit) &&
                    bin.rms > contrast * rmsElsewhere(alone));
  }
  std::vector<BinRange> ranges = rangesOf(bins, marks);
  std::sort(ranges.begin(), ranges.end(), [](const BinRange& a, const BinRange& b) { return a.squares > b.squares; });
  if (ranges.size() > kMostRanges) ranges.resize(kMostRanges);
  return ranges;
}

}  // namespace suspension_health_monitor
