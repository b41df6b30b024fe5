#pragma once

#include <string>
#include <vector>

#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/internal/search/effect_cost.h"
#include "suspension_health_monitor/internal/search/effect_search.h"

namespace suspension_health_monitor {

/// The verdict's name for programs: effect_found, suspect, nothing_missing or unexplained.
const char* nameOf(Verdict verdict);

/// The verdict in a sentence for people.
std::string summaryOf(const SearchResult& result);

/// What an effect does to b1 and b0 in a sentence; of a harmless fault of a sensor also that there is nothing to do.
std::string describe(const EffectCost& cost);

/// What a suspect leaves, in a sentence; empty with any other verdict.
std::string remainderOf(const SearchResult& result);

/// What to record next, in sentences; empty if there is nothing to tell apart and nothing unexplained.
std::string suggestionOf(const SearchResult& result);

/// What motion at one frequency cannot tell, and what to do.
std::string describe(const MotionRange& one_frequency);

/// Why an effect is not tried: all motion is at one frequency, or a channel of the body's IMU is missing.
inline constexpr const char* kOneFrequency = "all motion is at one frequency, which cannot tell it";
std::string reasonOf(BodyChannel missing);

/// Why there is no model with a candidate, to be read after its name; empty for kNone.
const char* reasonOf(FitFailure failure);

/// What is the matter with drives, to be read after "the drives"; empty for kNone.
/// @param start  the model that was given, or the rough one by least squares.
std::string reasonOf(Shortcoming shortcoming, const StrutModel& start);

/// Puts regions into words: fills `region` and `sentence` from the facts.
/// @param views, noise_floor  of the comparison that found them: numbers get the SI prefix that reads well for its
/// drives.
void describeFailures(const ResidualViews& views, double noise_floor, std::vector<FailureRegion>& regions);

}  // namespace suspension_health_monitor
