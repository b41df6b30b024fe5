#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "entry_points.h"

namespace suspension_health_monitor {
namespace {

/// The inputs that the fuzzers start from, and those that once broke something: name and content.
std::vector<std::pair<std::string, std::string>> corpus(const std::string& fuzzer) {
  std::vector<std::pair<std::string, std::string>> inputs;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(CORPUS_FOLDER) + '/' + fuzzer)) {
    std::ifstream file(entry.path(), std::ios::binary);
    inputs.emplace_back(entry.path().filename().string(), std::string(std::istreambuf_iterator<char>(file), {}));
  }
  EXPECT_GT(inputs.size(), 5U);
  return inputs;
}

TEST(SampleStream, NoReadingsBreakTheMonitor) {
  for (const auto& [name, content] : corpus("sample_stream")) {
    const std::vector<std::uint8_t> bytes(content.begin(), content.end());
    EXPECT_NO_THROW(feedSampleStream(bytes.data(), bytes.size())) << name;
  }
}

TEST(SettingsText, NoTextBreaksTheReaders) {
  for (const auto& [name, content] : corpus("settings_text")) {
    const bool good = name.compare(0, 5, "good_") == 0;
    std::string answers;
    EXPECT_NO_THROW(answers = readSettingsText(content)) << name;
    EXPECT_EQ(answers.find("accepted") != std::string::npos, good) << name << ":\n" << answers;
  }
}

}  // namespace
}  // namespace suspension_health_monitor
