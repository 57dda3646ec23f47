// Simulated participants must not contain figures of the paper's results.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "SourceFolder.h"
#include "base/files/TextFile.h"

namespace heft {
namespace {

TEST(Sources, HoldNoneOfThePapersResults) {
  // Percentages as fractions, too.
  const std::regex results(
      R"((^|[^0-9.])(6\.2|55\.4|38\.5|78\.5|21\.5|10\.1|172\.3|271\.5|696\.2|72\.4|155\.3|394\.7|9\.6|20\.8|)"
      R"(0?\.062|0?\.554|0?\.385|0?\.785|0?\.215|0?\.101|0?\.096|0?\.208)([^0-9]|$))");
  ASSERT_TRUE(std::regex_search("rate = 78.5;", results));
  ASSERT_TRUE(std::regex_search("rate{0.785}", results));
  ASSERT_FALSE(std::regex_search("178.5 0.0785 6.25", results));
  int n_files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(source_folder() + "/src/responders")) {
    if (!entry.is_regular_file()) continue;
    const std::string text = read_text_file(entry.path().string());
    ++n_files;
    std::smatch found;
    EXPECT_FALSE(std::regex_search(text, found, results)) << entry.path() << ": " << found.str();
  }
  EXPECT_GT(n_files, 10);
}

}  // namespace
}  // namespace heft
