#include "suspension_health_monitor/internal/health/inspection.h"

#include <algorithm>
#include <complex>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"

namespace suspension_health_monitor {
namespace {

constexpr double kPlateAmplitude = 0.003;  // [m]: 6 mm from top to bottom
constexpr double kPlateHighest = 25.0;     // [Hz]
constexpr int kPlateFrequencies = 250;     // 0.1 Hz apart: a twentieth of the width of a wheel hop that is well damped

// Chance that a vehicle whose numbers are all at their limits fails.
constexpr double kFalseFail = 0.01;

// Share of the model's error that the struts of an axle do not have in common. On recorded multibody vehicles the
// ratios of b1 and b0 of an axle were off by up to 0.21 of what errors of their own would make, by 0.1 as root mean
// square.
constexpr double kOwnShare = 0.2;

const double kTwoSided95 = normalQuantile(0.025);

// The most that a drive is made longer for, times.
constexpr double kMostLonger = 16.0;

// A number with normal errors.
struct Uncertain {
  double value, stddev, model_stddev;  // stddev falls as data grow, that of the model does not

  ValueRange range(double sigmas, double longer) const {
    const double reach = sigmas * std::hypot(stddev / std::sqrt(longer), model_stddev);
    return {std::max(0.0, value - reach), value + reach};
  }
};

Uncertain dampingOf(const StrutEstimate& its) {
  return {its.damping_to_mass, its.damping_to_mass_stddev, its.damping_model_stddev};
}

Uncertain stiffnessOf(const StrutEstimate& its) {
  return {its.stiffness_to_mass, its.stiffness_to_mass_stddev, its.stiffness_model_stddev};
}

// How the model's errors of b1 and b0 go together is not known: at worst they add up.
Uncertain dampingRatioOf(const StrutEstimate& its) {
  const double per_damping = 0.5 / std::sqrt(its.stiffness_to_mass), ratio = its.dampingRatio();
  const double per_stiffness = 0.5 * ratio / its.stiffness_to_mass;
  const double by_damping = per_damping * its.damping_to_mass_stddev;
  const double by_stiffness = per_stiffness * its.stiffness_to_mass_stddev;
  const double variance = square(by_damping) + square(by_stiffness) - 2.0 * its.correlation * by_damping * by_stiffness;
  return {ratio, std::sqrt(variance),
          per_damping * its.damping_model_stddev + std::abs(per_stiffness) * its.stiffness_model_stddev};
}

ValueRange frequencyOf(const StrutEstimate& its) {
  const ValueRange stiffness = stiffnessOf(its).range(kTwoSided95, 1.0);
  return {std::sqrt(stiffness.low) / (2.0 * M_PI), std::sqrt(stiffness.high) / (2.0 * M_PI)};
}

// @return why nothing is known of a strut, in words.
std::string doubtOf(const InspectedStrut& strut) {
  if (!strut.doubt.empty() || strut.estimate.stiffness_to_mass > 0.0) return strut.doubt;
  return "its stiffness is not above 0";
}

bool isImbalance(const InspectedNumber& number) { return number.struts.size() == 2; }

// The worst and the best of all cars in the intervals; damping may be best in between.
ValueRange adhesionRange(const ValueRange& damping, const ValueRange& stiffness, const WheelRanges& wheel) {
  constexpr int kSteps = 4;
  const auto at = [](const ValueRange& range, int step) {
    return range.low + (range.high - range.low) * step / kSteps;
  };
  ValueRange range{1.0, 0.0};
  for (int damper = 0; damper <= kSteps; ++damper)
    for (const int spring : {0, kSteps})
      for (const int mass : {0, kSteps})
        for (int tyre = 0; tyre <= kSteps; ++tyre) {
          const double adhesion = leastAdhesion({at(damping, damper), at(stiffness, spring)},
                                                at(wheel.mass_ratio, mass), at(wheel.tyre_to_mass, tyre));
          range = {std::min(range.low, adhesion), std::max(range.high, adhesion)};
        }
  return range;
}

using Struts = std::vector<InspectedStrut>;

// Pairs of left and right.
std::vector<StrutPair> axlesOf(const Struts& struts) {
  StrutPlaces places;
  for (const InspectedStrut& strut : struts)
    if (strut.place) places.push_back(*strut.place);
  std::vector<StrutPair> pairs;
  if (places.size() == struts.size()) {
    pairs = pairsOf(places);
    for (auto& [left, right] : pairs)
      if (places[left][1] < places[right][1]) std::swap(left, right);
    return pairs;
  }
  const std::vector<std::string> names = namesOf(struts);
  const auto place = [&](std::size_t corner) {
    return std::find(names.begin(), names.end(), kCornerNames[corner]) - names.begin();
  };
  for (const std::size_t left : {0, 2}) {
    const StrutPair pair(place(left), place(left + 1));
    if (std::max(pair.first, pair.second) < struts.size()) pairs.push_back(pair);
  }
  return pairs;
}

// What is asked, not judged yet.
std::vector<InspectedNumber> openNumbers(const Struts& struts, const InspectionLimits& limits) {
  std::vector<InspectedNumber> numbers;
  const auto add = [&](InspectedQuantity quantity, const std::vector<std::size_t>& of, double limit) {
    InspectedNumber& number = numbers.emplace_back();
    number.quantity = quantity;
    number.struts = of;
    number.limit = limit;
    for (const std::size_t i : of)
      if (number.doubt.empty()) number.doubt = doubtOf(struts[i]);
  };
  for (std::size_t i = 0; i < struts.size(); ++i) {
    add(InspectedQuantity::kDampingRatio, {i}, limits.damping_ratio);
    if (struts[i].wheel) add(InspectedQuantity::kAdhesion, {i}, limits.adhesion);
  }
  for (const auto& [left, right] : axlesOf(struts)) {
    add(InspectedQuantity::kDampingImbalance, {left, right}, limits.imbalance);
    add(InspectedQuantity::kStiffnessImbalance, {left, right}, limits.imbalance);
  }
  return numbers;
}

// What an imbalance compares, of one strut.
Uncertain partOf(const InspectedNumber& number, const InspectedStrut& strut) {
  return number.quantity == InspectedQuantity::kDampingImbalance ? dampingOf(strut.estimate)
                                                                 : stiffnessOf(strut.estimate);
}

// Of any number but an adhesion. The model is the same on both sides of an axle: most of its error is in both struts
// alike and leaves their ratio as it is.
Uncertain measuredOf(const InspectedNumber& number, const Struts& struts) {
  const std::size_t left = number.struts.front(), right = number.struts.back();
  if (!isImbalance(number)) return dampingRatioOf(struts[left].estimate);
  const Uncertain weaker = partOf(number, struts[*number.weaker]);
  const Uncertain stronger = partOf(number, struts[*number.weaker == left ? right : left]);
  const double ratio = weaker.value / stronger.value;
  const auto both = [&](double Uncertain::*error) {
    return std::hypot(weaker.*error, ratio * stronger.*error) / stronger.value;
  };
  return {1.0 - ratio, both(&Uncertain::stddev), kOwnShare * both(&Uncertain::model_stddev)};
}

// @param certain  standard deviations that a failure needs.
void judge(InspectedNumber& number, const Struts& struts, double certain) {
  const std::size_t left = number.struts.front(), right = number.struts.back();
  const bool is_imbalance = isImbalance(number), is_adhesion = number.quantity == InspectedQuantity::kAdhesion;
  if (is_imbalance)
    number.weaker = partOf(number, struts[left]).value < partOf(number, struts[right]).value ? left : right;
  // As many standard deviations either way, from so many times the data.
  const auto interval = [&](double sigmas, double longer) {
    if (!is_adhesion) return measuredOf(number, struts).range(sigmas, longer);
    const StrutEstimate& its = struts[left].estimate;
    return adhesionRange(dampingOf(its).range(sigmas, longer), stiffnessOf(its).range(sigmas, longer),
                         *struts[left].wheel);
  };
  const auto verdict = [&](double longer) {
    const ValueRange likely = interval(kTwoSided95, longer), sure = interval(certain, longer);
    if (is_imbalance ? likely.high <= number.limit : likely.low >= number.limit) return InspectionVerdict::kPasses;
    if (is_imbalance ? sure.low > number.limit : sure.high < number.limit) return InspectionVerdict::kFails;
    return InspectionVerdict::kCannotTell;
  };
  const ValueRange typical = is_adhesion ? interval(0.0, 1.0) : ValueRange();
  number.value = is_adhesion ? (typical.low + typical.high) / 2.0 : measuredOf(number, struts).value;
  number.interval = interval(kTwoSided95, 1.0);
  number.verdict = verdict(1.0);
  for (double longer = 2.0; longer <= kMostLonger && !number.longer; longer *= 2.0)
    if (verdict(longer) != InspectionVerdict::kCannotTell) number.longer = longer;
}

}  // namespace

double adhesionAt(double frequency, const LinearStrut& strut, double mass_ratio, double tyre_to_mass) {
  const std::complex<double> s(0.0, 2.0 * M_PI * frequency);
  const std::complex<double> force = strut.damping_to_mass * s + strut.stiffness_to_mass;
  const std::complex<double> inertia = s * s * (force / (s * s + force) + mass_ratio);
  const double swing = std::abs(tyre_to_mass * inertia / (tyre_to_mass + inertia)) * kPlateAmplitude;
  return std::max(0.0, 1.0 - swing / ((1.0 + mass_ratio) * kStandardGravity));
}

double leastAdhesion(const LinearStrut& strut, double mass_ratio, double tyre_to_mass) {
  double least = 1.0;
  for (int i = 1; i <= kPlateFrequencies; ++i)
    least = std::min(least, adhesionAt(kPlateHighest * i / kPlateFrequencies, strut, mass_ratio, tyre_to_mass));
  return least;
}

Inspection inspect(const std::vector<InspectedStrut>& struts, const InspectionLimits& limits) {
  Inspection result;
  if (struts.empty()) return result;
  for (const InspectedStrut& strut : struts)
    result.frequencies.push_back(doubtOf(strut).empty() ? frequencyOf(strut.estimate) : ValueRange());
  result.numbers = openNumbers(struts, limits);
  const double certain = normalQuantile(kFalseFail / static_cast<double>(result.numbers.size()));
  for (InspectedNumber& number : result.numbers)
    if (number.doubt.empty()) judge(number, struts, certain);
  for (const auto worse : {InspectionVerdict::kPasses, InspectionVerdict::kCannotTell, InspectionVerdict::kFails})
    for (const InspectedNumber& number : result.numbers)
      if (number.verdict == worse) result.verdict = worse;
  return result;
}

std::string describe(const InspectedNumber& number, const std::vector<InspectedStrut>& struts, double seconds) {
  if (number.verdict == InspectionVerdict::kPasses) return "passes";
  if (number.verdict == InspectionVerdict::kFails)
    return number.weaker ? "fails: weaker is " + struts[*number.weaker].name : "fails";
  if (!number.doubt.empty()) return "cannot tell: " + number.doubt;
  if (number.longer) return formatted("cannot tell: drive %.0f s in all, or a rougher road", seconds * *number.longer);
  return "cannot tell: too near the limit for any drive on this road";
}

}  // namespace suspension_health_monitor
