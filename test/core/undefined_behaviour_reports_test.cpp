// Part of builds with UBSan only: do its reports reach the file where scripts/test looks for them?
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

namespace {

[[gnu::noinline]] int successor(int number) { return number + 1; }

TEST(UndefinedBehaviour, EndsTheProcessAndIsReportedInAFile) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "undefined_behaviour_reports_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const char* const before = std::getenv("UBSAN_OPTIONS");
  const std::string options = before == nullptr ? "" : before;
  setenv("UBSAN_OPTIONS", ("exitcode=99:log_path=" + (folder / "report").string()).c_str(), 1);
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // a process of its own, which reads the options anew
  volatile int largest = std::numeric_limits<int>::max();
  EXPECT_EXIT(std::exit(successor(largest) == 0), testing::ExitedWithCode(99), "");
  setenv("UBSAN_OPTIONS", options.c_str(), 1);

  ASSERT_FALSE(std::filesystem::is_empty(folder));
  std::ifstream file(std::filesystem::directory_iterator(folder)->path());
  const std::string report{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(report.find("signed integer overflow"), std::string::npos) << report;
}

}  // namespace
