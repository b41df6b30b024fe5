#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPeriod = 0.01;
constexpr double kNoise = 0.05;
const LinearStrut kCar{6.0, 63.3};

/// A motion with several frequencies, and a residual (and missing force) that is noise and force(t, d, v).
template <class Force>
ComparedSegment segmentWith(const Force& force, double noise = kNoise, unsigned seed = 1, std::size_t count = 12000) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  ComparedSegment segment;
  segment.period = kPeriod;
  double low = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = segment.time(k);
    const double d = 0.010 * std::sin(5.1 * t) + 0.008 * std::sin(7.7 * t + 1.0) + 0.004 * std::sin(13.3 * t);
    const double v =
        0.010 * 5.1 * std::cos(5.1 * t) + 0.008 * 7.7 * std::cos(7.7 * t + 1.0) + 0.004 * 13.3 * std::cos(13.3 * t);
    const double missing = force(t, d, v) + noise * normal(generator);
    segment.travel.push_back(d);
    segment.travel_rate.push_back(v);
    low = 0.7 * low + normal(generator);
    segment.wheel.push_back(low);
    segment.predicted.push_back(63.3 * d + 6.0 * v);
    segment.measured.push_back(segment.predicted.back() + missing);
    segment.missing_force.push_back(missing);
    segment.added_force.push_back(0.0);
  }
  return segment;
}

const auto kNothing = [](double, double, double) { return 0.0; };

ResidualViews viewsOf(const ComparedSegment& segment, const LinearStrut& strut = kCar) {
  const auto views = viewResidual({segment}, strut, {kNoise});
  EXPECT_TRUE(views);
  return views.value_or(ResidualViews{});
}

std::vector<FailureRegion> failuresIn(const ComparedSegment& segment) {
  const ResidualViews views = viewsOf(segment);
  std::vector<FailureRegion> where = findFailures(views, kCar, kNoise);
  describeFailures(views, kNoise, where);
  return where;
}

TEST(ResidualViews, EverySampleIsInOneBinOfEveryView) {
  const ResidualViews views = viewsOf(segmentWith(kNothing));
  const auto sum = [](const auto& bins) {
    std::size_t count = 0;
    for (const auto& bin : bins) count += bin.count;
    return count;
  };
  EXPECT_EQ(sum(views.time), 12000u);
  EXPECT_EQ(sum(views.travel), 12000u);
  EXPECT_EQ(sum(views.travel_rate), 12000u);
  EXPECT_EQ(sum(views.direction.compressing) + sum(views.direction.extending), 12000u);
  EXPECT_EQ(views.surface.count.sum(), 12000);
}

TEST(ResidualViews, AStepForceIsTheMeanOfItsBins) {
  // 0.3 m/s^2 more above 10 mm: the mean over the whole drive is taken off.
  const auto force = [](double, double d, double) { return d > 0.010 ? 0.3 : 0.0; };
  const ResidualViews views = viewsOf(segmentWith(force));
  for (const ResidualBin& bin : views.travel) {
    if (bin.from < 0.010 && bin.to > 0.010) continue;
    EXPECT_NEAR(bin.mean + views.offset, bin.from >= 0.010 ? 0.3 : 0.0, 5.0 * bin.standard_error) << bin.from;
  }
  EXPECT_GT(views.surface.explained_share, 0.7);
}

TEST(ResidualViews, AForceOfDirectionOpensTheLoopByTwice) {
  const ResidualViews views = viewsOf(segmentWith([](double, double, double v) { return v > 0.0 ? 0.04 : -0.04; }));
  EXPECT_NEAR(views.direction.gap, 0.08, 4.0 * views.direction.gap_standard_error);
  double range = 0.0;
  for (const ResidualBin& bin : views.direction.compressing) range += bin.to - bin.from;
  EXPECT_NEAR(views.direction.area, 0.08 * range, 0.25 * 0.08 * range);
  const ResidualViews opposite = viewsOf(segmentWith([](double, double, double v) { return v > 0.0 ? -0.04 : 0.04; }));
  EXPECT_NEAR(opposite.direction.gap, -0.08, 4.0 * opposite.direction.gap_standard_error);
  const ResidualViews spring = viewsOf(segmentWith([](double, double d, double) { return 4.0 * d; }));
  EXPECT_NEAR(spring.direction.gap, 0.0, 4.0 * spring.direction.gap_standard_error);
}

TEST(ResidualViews, LocalErrorsOfTheParametersFollowADrift) {
  const ResidualViews views = viewsOf(segmentWith([](double t, double, double v) { return 0.02 * (t - 60.0) * v; }));
  ASSERT_GE(views.time.size(), 10u);
  for (const TimeBin& bin : views.time) {
    EXPECT_NEAR(bin.damping_error, 0.02 * (0.5 * (bin.from + bin.to) - 60.0), 4.0 * bin.damping_error_stddev);
    EXPECT_NEAR(bin.stiffness_error, 0.0, 4.0 * bin.stiffness_error_stddev);
    EXPECT_LT(bin.damping_error_stddev, 0.3);
  }
}

TEST(ResidualViews, TheSpectrumHoldsTheMeanSquare) {
  const ComparedSegment segment =
      segmentWith([](double t, double, double) { return 0.2 * std::sin(2.0 * M_PI * 11.0 * t); });
  const ResidualViews views = viewsOf(segment);
  ASSERT_TRUE(views.spectrum);
  const ResidualSpectrum& spectrum = *views.spectrum;
  const double width = spectrum.frequency[0];
  const double power = width * std::accumulate(spectrum.residual.begin(), spectrum.residual.end(), 0.0);
  EXPECT_NEAR(power, kNoise * kNoise + 0.5 * 0.2 * 0.2, 0.03 * power);
  const auto peak = std::max_element(spectrum.residual.begin(), spectrum.residual.end()) - spectrum.residual.begin();
  EXPECT_NEAR(spectrum.frequency[static_cast<std::size_t>(peak)], 11.0, width);
  EXPECT_NEAR(spectrum.frequency.back(), 0.5 / kPeriod, 1e-9);
  const double noise = width * std::accumulate(spectrum.noise.begin(), spectrum.noise.end(), 0.0);
  EXPECT_NEAR(noise, kNoise * kNoise, 0.05 * kNoise * kNoise);
}

TEST(ResidualViews, CoherenceTellsWhatFollowsTheWheel) {
  ComparedSegment segment = segmentWith(kNothing);
  const auto above = [](const ResidualSpectrum& spectrum) {
    double count = 0.0;
    for (const double value : spectrum.coherence) count += value > spectrum.coherence_threshold ? 1.0 : 0.0;
    return count / static_cast<double>(spectrum.coherence.size());
  };
  EXPECT_NEAR(above(*viewsOf(segment).spectrum), 0.05, 0.035);
  for (std::size_t k = 0; k < segment.size(); ++k) segment.measured[k] += 0.1 * segment.wheel[k];
  EXPECT_GT(above(*viewsOf(segment).spectrum), 0.95);
}

TEST(ResidualViews, WhiteNoiseStaysWithinBothBands) {
  // A slow strut lets next to nothing of the noise on w'' through: the bands are those of white noise.
  const LinearStrut slow{0.6, 0.633};
  constexpr int kSeeds = 20;
  int within = 0;
  double white = 0.0, cross = 0.0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const ResidualViews views = viewsOf(segmentWith(kNothing, kNoise, seed, 6000), slow);
    ASSERT_EQ(views.whiteness.value.size(), 500u);
    white += views.whiteness.share_outside / kSeeds;
    cross += views.cross_correlation.share_outside / kSeeds;
    within += (views.whiteness.within ? 1 : 0) + (views.cross_correlation.within ? 1 : 0);
  }
  EXPECT_NEAR(white, 0.05, 0.015);  // 10 000 lags: standard error 0.0022; a little stays of the noise on w''
  EXPECT_NEAR(cross, 0.05, 0.015);
  EXPECT_GE(within, 2 * kSeeds - 2);
}

TEST(ResidualViews, CorrelationHasTheSignAndTheLagOfItsCause) {
  constexpr std::size_t kDelay = 5;
  ComparedSegment segment = segmentWith(kNothing);
  std::vector<double> echo = segment.measured;
  for (std::size_t k = kDelay; k < segment.size(); ++k) echo[k] -= 0.05 * segment.wheel[k - kDelay];
  segment.measured = echo;
  const ResidualCorrelation cross = viewsOf(segment).cross_correlation;
  EXPECT_FALSE(cross.within);
  const auto lowest = std::min_element(cross.value.begin(), cross.value.end()) - cross.value.begin();
  EXPECT_NEAR(cross.lag[static_cast<std::size_t>(lowest)], kDelay * kPeriod, 1e-9);
}

TEST(ResidualViews, SamplesPerIndependentOneGrowWithTheMemoryOfTheNoise) {
  ComparedSegment segment = segmentWith(kNothing, 0.0);
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  double state = 0.0;  // first order, rho = 0.8: (1 + rho) / (1 - rho) = 9
  for (double& y : segment.measured) y += state = 0.8 * state + normal(generator);
  EXPECT_NEAR(1.0 / viewsOf(segment).independent_share, 9.0, 1.5);
}

TEST(ResidualViews, NoSegmentIsNothing) { EXPECT_FALSE(viewResidual({}, kCar, {kNoise})); }

TEST(FindFailures, NoiseNamesNothingInAnyView) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const std::vector<FailureRegion> where = failuresIn(segmentWith(kNothing, kNoise, seed));
    ASSERT_EQ(where.size(), 1u) << seed << where[0].sentence;
    EXPECT_EQ(where[0].view, FailureView::kNone) << where[0].sentence;
    EXPECT_NEAR(where[0].rmse, kNoise, 0.05 * kNoise);
  }
}

TEST(FindFailures, AnOffsetIsASensors) {
  ComparedSegment segment = segmentWith(kNothing);
  for (double& y : segment.measured) y -= 0.2;
  const std::vector<FailureRegion> where = failuresIn(segment);
  ASSERT_EQ(where.size(), 1u);
  EXPECT_EQ(where[0].view, FailureView::kOffset);
  EXPECT_NEAR(where[0].mean, -0.2, 0.005);
  EXPECT_NE(where[0].sentence.find("0.2 m/s^2 less"), std::string::npos) << where[0].sentence;
}

TEST(FindFailures, ANoisyMinuteIsNamedByItsTime) {
  ComparedSegment segment = segmentWith(kNothing);
  const ComparedSegment other = segmentWith(kNothing, kNoise, 99);
  for (std::size_t k = 6000; k < 8000; ++k) segment.measured[k] += 2.0 * (other.measured[k] - other.predicted[k]);
  const std::vector<FailureRegion> where = failuresIn(segment);
  EXPECT_EQ(where[0].view, FailureView::kTime);
  EXPECT_NEAR(where[0].from, 60.0, 5.01);
  EXPECT_NEAR(where[0].to, 80.0, 5.01);
  EXPECT_GT(where[0].rmse, 1.9 * where[0].rmse_elsewhere);
}

TEST(FindFailures, ATremorIsNamedByItsFrequency) {
  const auto where =
      failuresIn(segmentWith([](double t, double, double) { return 0.1 * std::sin(2.0 * M_PI * 11.0 * t); }));
  const auto found = std::find_if(where.begin(), where.end(),
                                  [](const FailureRegion& region) { return region.view == FailureView::kFrequency; });
  ASSERT_NE(found, where.end());
  EXPECT_LT(found->from, 11.0);
  EXPECT_GT(found->to, 11.0);
  EXPECT_LT(found->to - found->from, 1.0);
}

}  // namespace
}  // namespace suspension_health_monitor
