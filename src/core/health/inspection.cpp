#include "suspension_health_monitor/internal/health/inspection.h"

#include <algorithm>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/health/corner_comparison.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"

namespace suspension_health_monitor {
namespace {

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
          const double adhesion = leastAdhesion(
              {at(damping, damper), at(stiffness, spring), at(wheel.mass_ratio, mass), at(wheel.tyre_to_mass, tyre)});
          range = {std::min(range.low, adhesion), std::max(range.high, adhesion)};
        }
  return range;
}

class Inspector {
 public:
  Inspector(const std::vector<InspectedStrut>& struts, const InspectionLimits& limits) : struts_(struts) {
    for (std::size_t i = 0; i < struts.size(); ++i) {
      add(InspectedQuantity::kDampingRatio, {i}, limits.damping_ratio);
      if (struts[i].wheel) add(InspectedQuantity::kAdhesion, {i}, limits.adhesion);
    }
    for (const StrutPair& axle : axles())
      for (const InspectedQuantity quantity :
           {InspectedQuantity::kDampingImbalance, InspectedQuantity::kStiffnessImbalance})
        add(quantity, {axle.first, axle.second}, limits.imbalance);
    certain_ = normalQuantile(kFalseFail / static_cast<double>(numbers_.size()));
  }

  Inspection result() {
    Inspection result;
    for (const InspectedStrut& strut : struts_)
      result.frequencies.push_back(doubtOf(strut).empty() ? frequencyOf(strut.estimate) : ValueRange());
    for (InspectedNumber& number : numbers_)
      if (number.doubt.empty()) judge(number);
    using Verdict = InspectionVerdict;
    for (const Verdict worse : {Verdict::kPasses, Verdict::kCannotTell, Verdict::kFails})
      for (const InspectedNumber& number : numbers_)
        if (number.verdict == worse) result.verdict = worse;
    result.numbers = std::move(numbers_);
    return result;
  }

 private:
  // Pairs of left and right.
  std::vector<StrutPair> axles() const {
    StrutPlaces places;
    for (const InspectedStrut& strut : struts_)
      if (strut.place) places.push_back(*strut.place);
    std::vector<StrutPair> pairs;
    if (places.size() == struts_.size()) {
      pairs = pairsOf(places);
      for (auto& [left, right] : pairs)
        if (places[left][1] < places[right][1]) std::swap(left, right);
      return pairs;
    }
    for (const std::size_t left : {0, 2}) {
      const auto place = [&](std::size_t corner) {
        const auto is_it = [&](const InspectedStrut& strut) { return strut.name == kCornerNames[corner]; };
        return std::find_if(struts_.begin(), struts_.end(), is_it) - struts_.begin();
      };
      const StrutPair pair(place(left), place(left + 1));
      if (std::max(pair.first, pair.second) < struts_.size()) pairs.push_back(pair);
    }
    return pairs;
  }

  void add(InspectedQuantity quantity, const std::vector<std::size_t>& of, double limit) {
    InspectedNumber number;
    number.quantity = quantity;
    number.struts = of;
    number.limit = limit;
    for (const std::size_t i : of)
      if (number.doubt.empty()) number.doubt = doubtOf(struts_[i]);
    numbers_.push_back(std::move(number));
  }

  // What an imbalance compares, of one strut.
  Uncertain partOf(const InspectedNumber& number, std::size_t strut) const {
    const StrutEstimate& its = struts_[strut].estimate;
    return number.quantity == InspectedQuantity::kDampingImbalance ? dampingOf(its) : stiffnessOf(its);
  }

  // The model is the same on both sides: most of its error is in both struts alike and leaves their ratio as it is.
  Uncertain imbalance(const InspectedNumber& number) const {
    const std::size_t left = number.struts.front(), right = number.struts.back();
    const Uncertain weaker = partOf(number, *number.weaker);
    const Uncertain stronger = partOf(number, *number.weaker == left ? right : left);
    const double ratio = weaker.value / stronger.value;
    const auto both = [&](double Uncertain::*error) {
      return std::hypot(weaker.*error, ratio * stronger.*error) / stronger.value;
    };
    return {1.0 - ratio, both(&Uncertain::stddev), kOwnShare * both(&Uncertain::model_stddev)};
  }

  // Of any number but an adhesion.
  Uncertain uncertain(const InspectedNumber& number) const {
    return isImbalance(number) ? imbalance(number) : dampingRatioOf(struts_[number.struts.front()].estimate);
  }

  // As many standard deviations either way, from so many times the data.
  ValueRange intervalOf(const InspectedNumber& number, double sigmas, double longer) const {
    if (number.quantity != InspectedQuantity::kAdhesion) return uncertain(number).range(sigmas, longer);
    const InspectedStrut& strut = struts_[number.struts.front()];
    return adhesionRange(dampingOf(strut.estimate).range(sigmas, longer),
                         stiffnessOf(strut.estimate).range(sigmas, longer), *strut.wheel);
  }

  void judge(InspectedNumber& number) const {
    const std::size_t left = number.struts.front(), right = number.struts.back();
    if (isImbalance(number)) number.weaker = partOf(number, left).value < partOf(number, right).value ? left : right;
    if (number.quantity == InspectedQuantity::kAdhesion) {
      const ValueRange typical = intervalOf(number, 0.0, 1.0);
      number.value = (typical.low + typical.high) / 2.0;
    } else {
      number.value = uncertain(number).value;
    }
    number.interval = intervalOf(number, kTwoSided95, 1.0);
    number.verdict = verdictOn(number, 1.0);
    for (double longer = 2.0; longer <= kMostLonger && !number.longer; longer *= 2.0)
      if (verdictOn(number, longer) != InspectionVerdict::kCannotTell) number.longer = longer;
  }

  InspectionVerdict verdictOn(const InspectedNumber& number, double longer) const {
    const ValueRange likely = intervalOf(number, kTwoSided95, longer), certain = intervalOf(number, certain_, longer);
    const bool most = isImbalance(number);
    if (most ? likely.high <= number.limit : likely.low >= number.limit) return InspectionVerdict::kPasses;
    if (most ? certain.low > number.limit : certain.high < number.limit) return InspectionVerdict::kFails;
    return InspectionVerdict::kCannotTell;
  }

  const std::vector<InspectedStrut>& struts_;
  std::vector<InspectedNumber> numbers_;
  double certain_ = 0.0;
};

}  // namespace

Inspection inspect(const std::vector<InspectedStrut>& struts, const InspectionLimits& limits) {
  return struts.empty() ? Inspection() : Inspector(struts, limits).result();
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
