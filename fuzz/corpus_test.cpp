#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
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

TEST(DriveRecords, NoRecordBreaksASearchOrAComparison) {
  for (const auto& [name, content] : corpus("drive_records")) {
    const std::vector<std::uint8_t> bytes(content.begin(), content.end());
    EXPECT_NO_THROW(searchDriveRecords(bytes.data(), bytes.size())) << name;
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

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

/// Too large for the corpus.
TEST(SettingsText, LargeTextsAreRefusedInWords) {
  const std::string often = "a: &a \"" + repeated("x", 200000) + "\"\n";
  std::string aliases;
  for (int i = 0; i < 9000; ++i) aliases += "k" + std::to_string(i) + ": *a\n";
  const auto law = [](const std::string& force) { return "effects: {x: {force: \"" + force + "\", unit: m}}"; };
  for (const std::string& text :
       {often + aliases, repeated("a: 1\n", 500000), "[" + repeated("[", 100000), "a: " + repeated("{a: ", 100000),
        "effects: {" + repeated("x", 500000) + ": {force: d, unit: m}}", law(repeated("(", 200000) + "d"),
        law(repeated("y", 500000)), law("d" + repeated("+d", 200000)), law(repeated("d>0?1:", 100000) + "0"),
        law(repeated("-", 300000) + "d"), law(repeated("sin(", 100000) + "d" + repeated(")", 100000)),
        repeated("x", 2000000)}) {
    std::string answers;
    EXPECT_NO_THROW(answers = readSettingsText(text)) << text.substr(0, 100);
    EXPECT_EQ(answers.find("accepted"), std::string::npos) << text.substr(0, 100);
    EXPECT_LT(answers.size(), 4 * (text.size() + 5000));
  }
}

}  // namespace
}  // namespace suspension_health_monitor
