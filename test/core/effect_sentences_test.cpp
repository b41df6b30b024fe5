// What a workshop is told of every effect: nothing is left out, and what is a sensor's fault is no strut's.
#include <gtest/gtest.h>

#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {
namespace {

bool has(const std::string& text, const char* words) { return text.find(words) != std::string::npos; }

/// One sentence, with a stop at its end only.
bool isOneSentence(const std::string& text) {
  return !text.empty() && text.find(". ") == std::string::npos && text.back() == '.';
}

TEST(AdviceOnEffects, EveryForceIsDesignWearOrDamageAndSaysWhatToCheck) {
  for (const ForceEffect& effect : builtInEffects().forces) {
    const std::string& advice = effect.advice;
    EXPECT_TRUE(isOneSentence(advice)) << effect.name << ": " << advice;
    EXPECT_TRUE(has(advice, "esign") || has(advice, "Wear") || has(advice, "Damage")) << effect.name;
    EXPECT_TRUE(has(advice, "check")) << effect.name;
    EXPECT_FALSE(has(advice, "fault of the sensor")) << effect.name;
  }
}

TEST(AdviceOnEffects, EveryReadingIsNoFaultOfTheStrut) {
  for (const MeasurementEffect& effect : builtInEffects().readings) {
    const std::string& advice = effect.advice;
    EXPECT_TRUE(isOneSentence(advice)) << effect.name << ": " << advice;
    EXPECT_TRUE(has(advice, "A fault of the sensor") && has(advice, "not of the strut")) << effect.name;
  }
}

TEST(AdviceOnEffects, OrificeFlowIsDesignAndFrictionMayBeWear) {
  EXPECT_EQ(findEffect(forceEffects(), "quadratic_damping").advice.rfind("Design, not wear", 0), 0u);
  EXPECT_TRUE(has(findEffect(forceEffects(), "coulomb_friction").advice, "more than when new is wear"));
}

}  // namespace
}  // namespace suspension_health_monitor
