#include "suspension_health_monitor/internal/wording/search_sentences.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/fit/noise_floor.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLeastShown = 0.001;  // what percent() shows, 0.1 %

std::string describe(const char* number, const std::optional<Measured>& change) {
  if (!change) return std::string(number) + " wrong by an unknown share";
  if (change->isKnown() && std::abs(change->value) >= kLeastShown)
    return number + (" " + percent(std::abs(change->value))) + (change->value > 0.0 ? " high" : " low");
  return number + (" wrong by less than " + percent(std::max(kLeastShown, change->most())));
}

const char* wordsFor(DriveKind kind) {
  switch (kind) {
    case DriveKind::kMoreTravel: return "a rougher road or more speed, with twice the travel";
    case DriveKind::kLessTravel: return "a smooth road, with a third of the travel";
    case DriveKind::kSlower: return "slow and long bumps, with the same travel at a third of the rate";
    case DriveKind::kQuicker: return "short and hard bumps, with the same travel at three times the rate";
    case DriveKind::kLonger: return "a drive three times as long";
    case DriveKind::kAtRest:
    case DriveKind::kNoneHelps: break;
  }
  return "";
}

std::string suggest(const SeparatingDrive& drive) {
  std::vector<std::string> names = drive.group;
  const std::string last = names.back();
  names.pop_back();
  const std::string group = join(names) + " and " + last;
  if (drive.kind == DriveKind::kAtRest)
    return "To tell " + group +
           " apart, read both IMUs on level ground at rest: one that is tilted has gravity across "
           "the strut, too.";
  if (drive.kind == DriveKind::kNoneHelps)
    return "No other kind of drive would tell " + group + " apart much better: look at the strut.";
  return "To tell " + group + " apart, record " + wordsFor(drive.kind) + ": there their forces differ by " +
         percent(drive.difference_there) + " of the strut's force, against " + percent(drive.difference_here) +
         " here.";
}

std::string suggestForUnexplained(const SearchResult& result) {
  const auto wanders = [](const RankedModel& model) { return model.failure == FitFailure::kWanders; };
  if (std::any_of(result.ranking.begin(), result.ranking.end(), wanders))
    return "The reading's offset wanders more slowly than the strut moves, and a constant one would not be larger than "
           "that: a body that leans by more than two degrees turns gravity away from its IMUs, or a sensor drifts.";
  if (result.folded_share > kMostFolded)
    return "The wheel still shakes at half the sampling rate, so that a part of its motion is lost to any model, which "
           "is the likely cause: record at twice the rate, or with the filter of the IMU set below half of it.";
  if (result.turns_body)
    return "The strut turns its body, so that others must hold it: other struts move the same body, give their IMUs, "
           "too (--vehicle, vehicle.launch).";
  if (result.surface_share > kMajority)
    return "A force that depends on travel and travel rate alone would explain " + percent(result.surface_share) +
           " of what is missing: describe it as a law of your own and diagnose again.";
  return "A force of travel and travel rate would explain only " + percent(result.surface_share) +
         " of what is missing. If struts that are not given move the same body, give their IMUs, too (--vehicle, "
         "vehicle.launch). "
         "Else drive the same road again with engine and load at rest, and at another speed: a force that does not "
         "come through the strut keeps its own time and size.";
}

}  // namespace

std::string describe(const EffectCost& cost) {
  const std::string name = cost.effect + (cost.size.empty() ? "" : " of " + cost.size);
  if (!cost.fits_without) return "No strut fits without " + name + ".";
  return "Leaving out " + name + " makes " + describe("b1 (damping)", cost.damping) + " and " +
         describe("b0 (stiffness)", cost.stiffness) + (cost.isHarmless() ? "; nothing to do." : ".");
}

const char* nameOf(Verdict verdict) {
  constexpr std::array kNames{"effect_found", "suspect", "nothing_missing", "unexplained"};
  static_assert(kNames.size() == static_cast<std::size_t>(Verdict::kUnexplained) + 1);
  return kNames[static_cast<std::size_t>(verdict)];
}

std::string summaryOf(const SearchResult& result) {
  switch (result.verdict) {
    case Verdict::kEffectFound: return "Missing from the model: " + join(result.selected, " and ") + ".";
    case Verdict::kSuspect:
      return "Main suspect: " + join(result.selected) + ", which takes " + percent(result.explained_share) +
             " of what is missing, not all of it.";
    case Verdict::kNothingMissing: return "Nothing is missing: what the model leaves is noise.";
    case Verdict::kUnexplained: break;
  }
  return "Something is missing, but no known effect explains most of it: no name is given.";
}

std::string describe(const MotionRange& one_frequency) {
  return formatted(
      "All motion is between %.2g and %.2g Hz, and one frequency cannot tell which law it is: drive on a "
      "road, or over bumps at several speeds",
      one_frequency.low, one_frequency.high);
}

std::string suggestionOf(const SearchResult& result) {
  if (result.one_frequency) return describe(*result.one_frequency) + ".";
  if (result.verdict == Verdict::kUnexplained) return suggestForUnexplained(result);
  return join(mapped(result.separating, suggest), " ");
}

std::string remainderOf(const SearchResult& result) {
  if (result.verdict != Verdict::kSuspect || result.one_frequency) return "";
  if (result.remainder_surface_share > kMajority)
    return "A force of travel and travel rate would take " + percent(result.remainder_surface_share) +
           " of what it leaves: the law is not quite this one, or another acts beside it.";
  return "A force of travel and travel rate would take only " + percent(result.remainder_surface_share) +
         " of what it leaves: the rest remembers, changes with time, or does not come through the strut.";
}

std::string reasonOf(BodyChannel missing) {
  const bool linear = missing == BodyChannel::kAccelerationX || missing == BodyChannel::kAccelerationY;
  return linear ? "the body's IMU shows no changing acceleration across the strut"
                : "the body's IMU shows no changing angular velocity";
}

const char* reasonOf(FitFailure failure) {
  switch (failure) {
    case FitFailure::kRunsAway: return "not stable on these drives";
    case FitFailure::kNeverActs: return "never acts in these drives";
    case FitFailure::kNotSolved: return "the fit came to no end";
    case FitFailure::kNoSpring: return "leaves no spring";
    case FitFailure::kTooFast: return "too fast for this sampling";
    case FitFailure::kWrongSign: return "its coefficient would have to be negative";
    case FitFailure::kShapeAtEnd: return "is another law at the end of its range";
    case FitFailure::kConfoundedWithFrequency:
      return "time and the frequency of the motion go together in these drives";
    case FitFailure::kWanders: return "the offset wanders: a body that leans, or a sensor that drifts";
    case FitFailure::kNone: break;
  }
  return "";
}

// One period more than the blocks take: a record loses samples at its ends.
static std::string enoughToHoldOut(const StrutModel& strut) {
  if (!(strut.stiffness_to_mass > 0.0)) return {};
  return describeEnough((kEnoughPeriods + 1.0) * 2.0 * M_PI / std::sqrt(strut.stiffness_to_mass));
}

static constexpr const char* kMaybeSwapped = ": are the IMUs swapped, is an axis upside down, or did nothing move?";

std::string reasonOf(Shortcoming shortcoming, const StrutModel& start) {
  const std::string numbers =
      formatted("damping/mass %.4g, stiffness/mass %.4g", start.damping_to_mass, start.stiffness_to_mass);
  switch (shortcoming) {
    case Shortcoming::kNoDampedSpring:
      return "show no damped spring" + (start.stiffness_to_mass != 0.0 ? " (" + numbers + ")" : "") + kMaybeSwapped;
    case Shortcoming::kTooFast: return "are sampled too slowly for so stiff a strut (" + numbers + ")";
    case Shortcoming::kTooShort:
      return "are too short or too calm: nothing can be held out to judge a model by" + enoughToHoldOut(start);
    case Shortcoming::kNoStableFit: return std::string("have no stable damped spring that fits them") + kMaybeSwapped;
    case Shortcoming::kModelUntestable: return "do not tell a fault of the body's IMU that the model has";
    case Shortcoming::kNone: break;
  }
  return "";
}

}  // namespace suspension_health_monitor
