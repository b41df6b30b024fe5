// The programs in example/ do what they say.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace {

/// @return what a program prints.
std::string outputOf(const std::string& name) {
  std::FILE* pipe = popen((std::string(EXAMPLES) + "/example_" + name).c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  std::string text;
  char line[512];
  while (pipe != nullptr && std::fgets(line, sizeof line, pipe) != nullptr) text += line;
  EXPECT_EQ(pipe == nullptr ? -1 : pclose(pipe), 0) << name << " prints: " << text;
  return text;
}

TEST(Example, ArraysAreIdentified) {
  const std::string text = outputOf("identify_arrays");
  double damping = 0.0, spread = 0.0, stiffness = 0.0, stiffness_spread = 0.0;
  const auto line = text.find("estimate: ");
  ASSERT_NE(line, std::string::npos) << text;
  ASSERT_EQ(std::sscanf(text.c_str() + line, "estimate: damping/mass %lf +- %lf 1/s, stiffness/mass %lf +- %lf",
                        &damping, &spread, &stiffness, &stiffness_spread),
            4);
  EXPECT_NEAR(damping, 4.0, 0.04) << text;
  EXPECT_NEAR(stiffness, 40.0, 0.4) << text;
  EXPECT_LT(spread, 0.04);
  EXPECT_EQ(text.find("not valid"), std::string::npos) << text;
}

TEST(Example, AStrutIsMonitoredLive) {
  const std::string text = outputOf("monitor_live");
  EXPECT_NE(text.find("level 0: "), std::string::npos) << text;
  const auto worn = text.find("level 2: damping ");
  ASSERT_NE(worn, std::string::npos) << text;
  double percent = 0.0, damping = 0.0;
  EXPECT_EQ(std::sscanf(text.c_str() + worn, "level 2: damping %lf %% below nominal", &percent), 1) << text;
  const auto end = text.find("at the end: ");
  ASSERT_EQ(std::sscanf(text.c_str() + end, "at the end: damping/mass %lf", &damping), 1) << text;
  EXPECT_NEAR(damping, 2.0, 0.1) << text;
}

TEST(Example, ArraysAreDiagnosed) {
  const std::string text = outputOf("diagnose_arrays");
  EXPECT_NE(text.find("a spring and a damper: "), std::string::npos) << text;
  EXPECT_NE(text.find("Missing from the model: bump_stop."), std::string::npos) << text;
  EXPECT_NE(text.find("bump_stop/g = 0.01"), std::string::npos) << text;
}

}  // namespace
