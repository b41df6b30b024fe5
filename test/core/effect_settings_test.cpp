#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {
namespace {

std::string refusal(OptionMap values) {
  try {
    takeEffects(values, forceEffects());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expectNamed(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

TEST(EffectSettings, TakesEffectsAndLeavesOtherSettings) {
  OptionMap values{{"effects/bump_stop/coefficient", 500.0},
                   {"effects/bump_stop/g", 0.02},
                   {"effects/asymmetric_damping/coefficient", -1},
                   {"effects_of_weather", true},
                   {"rate", 100.0}};
  const std::vector<ActiveEffect> effects = takeEffects(values, forceEffects());
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0].effect.name, "asymmetric_damping");
  EXPECT_EQ(effects[0].coefficient, -1.0);
  EXPECT_TRUE(effects[0].shapes.empty());
  EXPECT_EQ(effects[1].effect.name, "bump_stop");
  EXPECT_EQ(effects[1].coefficient, 500.0);
  EXPECT_EQ(effects[1].shapes, std::vector<double>{0.02});
  EXPECT_EQ(values.size(), 2u);
  EXPECT_EQ(values.count("rate"), 1u);
}

TEST(EffectSettings, MessagesNameTheMistakeAndWhatIsKnown) {
  expectNamed(refusal({{"effects/gremlin/coefficient", 1.0}}), {"gremlin", "bump_stop", "hysteresis"});
  expectNamed(refusal({{"effects/bump_stop/coefficient", 1.0}}), {"effects/bump_stop/g", "missing", "coefficient, g"});
  expectNamed(refusal({{"effects/bump_stop/g", 1.0}}), {"effects/bump_stop/coefficient", "missing"});
  expectNamed(
      refusal({{"effects/bump_stop/coefficient", 1.0}, {"effects/bump_stop/g", 0.1}, {"effects/bump_stop/h", 1.0}}),
      {"effects/bump_stop/h", "unknown", "coefficient, g"});
  expectNamed(refusal({{"effects/bump_stop/coefficient", 1.0}, {"effects/bump_stop/g", 0.0}}),
              {"effects/bump_stop/g = 0", "[m]", "[1e-09, 1000000000]"});
  for (const double absurd : {1e12, 5e-324, -0.01})
    expectNamed(refusal({{"effects/bump_stop/coefficient", 1.0}, {"effects/bump_stop/g", absurd}}),
                {"effects/bump_stop/g", "[m]", "[1e-09, 1000000000]"});
  expectNamed(refusal({{"effects/progressive_spring/coefficient", 1.0}, {"effects/progressive_spring/p", 6.0}}),
              {"effects/progressive_spring/p = 6", "[1.5, 5]"});
  expectNamed(refusal({{"effects/bump_stop/coefficient", std::string("much")}}),
              {"effects/bump_stop/coefficient", "much"});
  expectNamed(refusal({{"effects/bump_stop", 1.0}}), {"effects/bump_stop", "NAME/SETTING"});
}

TEST(EffectSettings, AssignmentBecomesSettings) {
  OptionMap values;
  setEffect(values, "hysteresis=-2.5,x=0.01", measurementEffects());
  setEffect(values, "asymmetric_spring=3e2", measurementEffects());
  const std::vector<ActiveEffect> effects = takeEffects(values, forceEffects());
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0].effect.name, "asymmetric_spring");
  EXPECT_EQ(effects[0].coefficient, 300.0);
  EXPECT_EQ(effects[1].effect.name, "hysteresis");
  EXPECT_EQ(effects[1].coefficient, -2.5);
  EXPECT_EQ(effects[1].shapes, std::vector<double>{0.01});
}

TEST(EffectSettings, AssignmentOfAFaultBecomesAReading) {
  OptionMap values;
  setEffect(values, "clock_offset=0.004", measurementEffects());
  setEffect(values, "mount_tilt=0.02", measurementEffects());
  setEffect(values, "lever_arm=0.3,r_y=-0.1", measurementEffects());
  const std::vector<ActiveMeasurementEffect> readings = takeReadings(values, measurementEffects());
  EXPECT_TRUE(values.empty());
  ASSERT_EQ(readings.size(), 3u);  // by name
  EXPECT_EQ(readings[0].effect.name, "clock_offset");
  EXPECT_EQ(readings[0].coefficients, std::vector<double>{0.004});
  EXPECT_EQ(readings[1].effect.name, "lever_arm");
  EXPECT_EQ(readings[1].coefficients, (std::vector<double>{0.3, -0.1}));
  EXPECT_EQ(readings[2].effect.name, "mount_tilt");
  EXPECT_EQ(readings[2].coefficients, (std::vector<double>{0.02, 0.0}));
}

TEST(EffectSettings, AssignmentsOfAnotherFormAreRefused) {
  for (const char* wrong :
       {"", "hysteresis", "=1", "hysteresis=", "hysteresis=1,x", "hysteresis=1,=2", "hysteresis=1,,x=2"}) {
    OptionMap values;
    EXPECT_THROW(setEffect(values, wrong, measurementEffects()), std::invalid_argument) << wrong;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
