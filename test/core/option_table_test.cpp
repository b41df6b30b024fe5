#include "suspension_health_monitor/internal/base/option_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/monitor/monitor_settings.h"
#include "suspension_health_monitor/internal/simulation/scenario.h"

namespace suspension_health_monitor {
namespace {

struct Sample {
  bool flag = false;
  int count = 3;
  double gain = 0.5;
  std::string mode = "fast";
  std::string label = "any";
  std::optional<double> mass;
};

constexpr OptionField<Sample> kSampleFields[] = {
    {"first", "flag", "-", "a switch", &Sample::flag},
    {"first", "count", "-", "a whole number", &Sample::count, -2, 2147483647},
    {"first", "gain", "V/m", "a number", &Sample::gain, 1e-9, 2.0},
    {"first", "mode", "-", "a choice", &Sample::mode, 0, 0, "slow fast 17"},
    {"second", "label", "-", "a text", &Sample::label},
    {"first", "group/mass", "kg", "a number or none", &Sample::mass, 0.0, 1e6},
};

Sample taken(const std::string& name, const OptionValue& value) {
  Sample options;
  OptionMap values{{name, value}};
  takeOptions(values, kSampleFields, options);
  EXPECT_TRUE(values.empty());
  return options;
}

std::string complaint(const std::string& name, const OptionValue& value) {
  try {
    taken(name, value);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(OptionTable, TakesEveryKindOfMember) {
  EXPECT_TRUE(taken("flag", true).flag);
  EXPECT_EQ(taken("count", 7).count, 7);
  EXPECT_EQ(taken("gain", 0.25).gain, 0.25);
  EXPECT_EQ(taken("mode", std::string("slow")).mode, "slow");
  EXPECT_EQ(taken("label", std::string("left front")).label, "left front");
  EXPECT_EQ(taken("group/mass", 12.5).mass, 12.5);
}

TEST(OptionTable, TakesNumbersInWhateverWayTheyAreWritten) {
  EXPECT_EQ(taken("gain", 1).gain, 1.0);
  EXPECT_EQ(taken("gain", std::string("1e-8")).gain, 1e-8);
  EXPECT_EQ(taken("gain", std::string("0.5")).gain, 0.5);
  EXPECT_EQ(taken("group/mass", std::string("1e3")).mass, 1000.0);
  EXPECT_EQ(taken("count", 30.0).count, 30);
  EXPECT_EQ(taken("count", -2.0).count, -2);
  EXPECT_EQ(taken("count", std::string("30.0")).count, 30);
  EXPECT_EQ(taken("count", std::string("30")).count, 30);
  EXPECT_TRUE(taken("flag", std::string("true")).flag);
  EXPECT_FALSE(taken("flag", std::string("False")).flag);
  EXPECT_EQ(taken("mode", 17).mode, "17");
}

TEST(OptionTable, TakesEveryWholeNumberOfItsRange) {
  EXPECT_EQ(taken("count", 2147483647).count, 2147483647);
  EXPECT_EQ(taken("count", 2000000000.0).count, 2000000000);
}

TEST(OptionTable, RefusesTheWrongType) {
  EXPECT_NE(complaint("flag", 1), "");
  EXPECT_NE(complaint("flag", std::string("yes")), "");
  EXPECT_NE(complaint("count", true), "");
  EXPECT_NE(complaint("count", 3.5), "");
  EXPECT_NE(complaint("count", std::string("three")), "");
  EXPECT_NE(complaint("count", std::string("")), "");
  EXPECT_NE(complaint("count", 1e300), "");
  EXPECT_NE(complaint("gain", false), "");
  EXPECT_NE(complaint("gain", std::string("0.5 V/m")), "");
  EXPECT_NE(complaint("gain", std::string("0,5")), "");
  EXPECT_NE(complaint("mode", true), "");
  EXPECT_NE(complaint("label", 0.5), "");
  EXPECT_NE(complaint("group/mass", std::string("none")), "");
}

TEST(OptionTable, RefusesWhatIsOutsideTheRange) {
  EXPECT_EQ(complaint("gain", 2.0), "");
  EXPECT_NE(complaint("gain", std::nextafter(2.0, 3.0)), "");
  EXPECT_EQ(complaint("gain", 1e-9), "");
  EXPECT_NE(complaint("gain", 0.0), "");
  EXPECT_NE(complaint("count", -3), "");
  EXPECT_NE(complaint("group/mass", -1e-300), "");
  for (const char* word : {"", " ", "medium", "fas", "Fast", "slow fast", "fast "})
    EXPECT_NE(complaint("mode", std::string(word)), "") << word;
}

TEST(OptionTable, RefusesNaNAndInfinity) {
  for (const char* name : {"gain", "group/mass", "count"}) {
    EXPECT_NE(complaint(name, std::nan("")), "") << name;
    EXPECT_NE(complaint(name, -std::numeric_limits<double>::infinity()), "") << name;
    EXPECT_NE(complaint(name, std::string("nan")), "") << name;
    EXPECT_NE(complaint(name, std::string("inf")), "") << name;
  }
}

TEST(OptionTable, MessageHasNameValueUnitAndWhatIsAllowed) {
  EXPECT_EQ(complaint("gain", 2.5), "gain = 2.5 [V/m], must be in [1e-09, 2]: a number");
  EXPECT_EQ(complaint("gain", true), "gain = true [V/m], must be in [1e-09, 2]: a number");
  EXPECT_EQ(complaint("count", -3), "count = -3 [-], must be a whole number in [-2, 2147483647]: a whole number");
  EXPECT_EQ(complaint("flag", 1), "flag = 1 [-], must be true or false: a switch");
  EXPECT_EQ(complaint("mode", std::string("medium")), "mode = \"medium\" [-], must be one of slow, fast, 17: a choice");
  EXPECT_EQ(complaint("label", 0.5), "label = 0.5 [-], must be any text: a text");
  const UnusableList list{"[1, 2]"};
  EXPECT_EQ(complaint("gain", list), "gain = [1, 2] [V/m], must be in [1e-09, 2]: a number");
  EXPECT_EQ(complaint("flag", list), "flag = [1, 2] [-], must be true or false: a switch");
  EXPECT_EQ(complaint("mode", list), "mode = [1, 2] [-], must be one of slow, fast, 17: a choice");
  EXPECT_EQ(complaint("label", list), "label = [1, 2] [-], must be any text or a list of texts: a text");
}

TEST(OptionTable, LeavesOptionsUnchangedWhenItRefusesOne) {
  Sample options;
  options.gain = 1.25;
  OptionMap values{{"flag", true}, {"gain", 0.75}, {"group/mass", -1.0}};
  EXPECT_THROW(takeOptions(values, kSampleFields, options), std::invalid_argument);
  EXPECT_FALSE(options.flag);
  EXPECT_EQ(options.gain, 1.25);
  EXPECT_FALSE(options.mass);
}

TEST(OptionTable, LeavesUnknownKeysForOtherTables) {
  Sample options;
  OptionMap values{{"gain", 0.75}, {"gian", 0.75}};
  takeOptions(values, kSampleFields, options);
  EXPECT_EQ(values.size(), 1u);
  EXPECT_EQ(values.count("gian"), 1u);
}

TEST(OptionTable, ProposesTheNearestNameForAMisspeltKey) {
  const auto proposal = [](const std::string& key) -> std::string {
    try {
      refuseUnknown({{key, 0.75}}, describeOptions(kMonitorFields));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(proposal("forgeting_factor"),
            "unknown option forgeting_factor = 0.75; the nearest known name is forgetting_factor");
  EXPECT_NE(proposal("health/payload_rang").find("is health/payload_range"), std::string::npos);
  EXPECT_NE(proposal("sample_perido").find("is sample_period"), std::string::npos);
  EXPECT_NE(proposal("sprungmass").find("is sprung_mass"), std::string::npos);
  for (const char* far_from_all : {"foo", "x", "health", "zzzzzzzzzzzz"})
    EXPECT_EQ(proposal(far_from_all), std::string("unknown option ") + far_from_all + " = 0.75");
  EXPECT_NO_THROW(refuseUnknown({}, describeOptions(kMonitorFields)));
  EXPECT_THROW(refuseUnknown({{"x", 1}}, {}), std::invalid_argument);
}

TEST(OptionTable, ValidateFindsWhatWasSetDirectly) {
  Sample options;
  EXPECT_NO_THROW(validate(options, kSampleFields));
  options.gain = std::nan("");
  EXPECT_THROW(validate(options, kSampleFields), std::invalid_argument);
  options.gain = 1.0;
  options.mass = -1.0;
  EXPECT_THROW(validate(options, kSampleFields), std::invalid_argument);
}

TEST(OptionTable, DescribesDefaultsAsTheyWouldBeWritten) {
  const std::vector<OptionDescription> rows = describeOptions(kSampleFields);
  const std::vector<std::string> defaults{"false", "3", "0.5", "fast", "any", "none"};
  ASSERT_EQ(rows.size(), defaults.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i].default_value, defaults[i]) << rows[i].name;
  EXPECT_EQ(rows[2].unit, "V/m");
  EXPECT_EQ(rows[1].allowed, "a whole number in [-2, 2147483647]");
}

TEST(OptionTable, ShowsGroupAfterGroupInTheOrderOfTheTable) {
  constexpr OptionField<Sample> kMore[] = {{"second", "more", "-", "a switch", &Sample::flag}};
  std::string names;
  for (const auto& row : inGroups({"second", "first"}, describeOptions(kSampleFields), describeOptions(kMore)))
    names += row.name + ' ';
  EXPECT_EQ(names, "label more flag count gain mode group/mass ");
}

TEST(OptionTable, SaysWhatServesInsteadOfAFormerOption) {
  const auto refusal = [](const std::string& key) -> std::string {
    try {
      refuseUnknown({{key, 1}}, describeOptions(kMonitorFields));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("integration_rule"), "integration_rule is no option any more: preset: paper has the paper's value");
  EXPECT_NE(refusal("la/small_divisor").find("preset: paper"), std::string::npos);
  EXPECT_NE(refusal("horizon_samples").find("integration_horizon"), std::string::npos);
}

// What every shipped table must keep. A default taken by its own description must give itself: text, range and type
// agree.
template <class Options, std::size_t N>
void expectSound(const OptionField<Options> (&fields)[N]) {
  EXPECT_NO_THROW(validate(Options{}, fields));
  std::set<std::string> names;
  for (const OptionDescription& row : describeOptions(fields)) {
    SCOPED_TRACE(row.name);
    EXPECT_FALSE(row.name.empty());
    EXPECT_FALSE(row.group.empty());
    EXPECT_TRUE(names.insert(row.name).second) << "twice";
    EXPECT_FALSE(row.help.empty());
    EXPECT_FALSE(row.unit.empty());
    EXPECT_EQ(row.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_/"), std::string::npos);
    Options options;
    OptionMap values{{row.name, std::string("no such value")}};
    try {
      takeOptions(values, fields, options);
      ADD_FAILURE() << "taken";
    } catch (const std::invalid_argument& error) {
      const std::string expected = row.name + " = \"no such value\" [" + row.unit + "], must be " + row.allowed;
      EXPECT_EQ(std::string(error.what()), expected + ": " + row.help);
    }
    if (row.default_value == "none") continue;
    OptionMap own{{row.name, row.default_value}};
    EXPECT_NO_THROW(takeOptions(own, fields, options));
  }
}

TEST(OptionTable, EveryRowOfTheMonitorIsSound) { expectSound(kMonitorFields); }

TEST(OptionTable, EveryRowOfTheSimulationIsSound) { expectSound(kSimulationFields); }

}  // namespace
}  // namespace suspension_health_monitor
