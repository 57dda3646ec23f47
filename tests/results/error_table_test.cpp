// What `auto` picks from is what the bench measured. HEFT_WRITE_ERROR_TABLE=1 in the environment
// writes the table anew, after a new `heft bench physics`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <span>

#include "SourceFolder.h"
#include "base/Error.h"
#include "base/files/TextFile.h"

namespace heft {
namespace {

std::string error_table_text(std::string_view hands_csv) {
  const auto lines = lines_of(hands_csv);
  if (lines.empty()) throw Error("hands.csv is empty");
  const auto names = cells_of(lines.front());
  const auto column = [&](std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw Error(fmt::format("hands.csv has no column {}", name));
    return static_cast<std::size_t>(found - names.begin());
  };
  const std::size_t simulator = column("simulator"), rate = column("rate_hz"),
                    setting = column("setting");
  const std::array most{column("most_clone_rms_mm"), column("most_lag_g"),
                        column("most_cubes_rms_mm"), column("most_turn_deg")};
  constexpr std::array units{1e-3, 1.0, 1e-3, M_PI / 180};
  // The errors of a simulator at the rate of `auto` in a group of settings; empty if not measured.
  const auto errors = [&](std::string_view of, std::string_view at_hz, std::string_view group) {
    std::string values;
    for (const std::string_view line : std::span(lines).subspan(1)) {
      const auto cells = cells_of(line);
      if (cells.size() != names.size() || cells[simulator] != of || cells[rate] != at_hz ||
          cells[setting] != group)
        continue;
      for (std::size_t i = 0; i < most.size(); ++i)
        values += fmt::format("{}{:.3g}", i ? ", " : "",
                              units[i] * number_in(cells[most[i]]).value_or(1e9));
    }
    return values;
  };
  return fmt::format(
      "// Written from results/physics/hands.csv; see tests/results/error_table_test.cpp.\n"
      "{{\"push\", {{{}}}, {{}}}},\n{{\"boxes\", {{{}}}, Tolerance{{{}}}}},\n",
      errors("push", "15", "even"), errors("boxes", "240", "even"),
      errors("boxes", "240", "uneven"));
}

TEST(ErrorTable, IsThatOfTheCheckedInResults) {
  const std::string source = source_folder() + "/src/physics/auto/ErrorTable.inc";
  const std::string text =
      error_table_text(read_text_file(source_folder() + "/results/physics/hands.csv"));
  if (std::getenv("HEFT_WRITE_ERROR_TABLE")) std::ofstream(source) << text;
  EXPECT_EQ(read_text_file(source), text) << "HEFT_WRITE_ERROR_TABLE=1 writes it anew";
}

TEST(ErrorTable, TakesPushAndBoxesAtTheRateOfAutoInSIUnits) {
  const std::string text = error_table_text(
      "simulator,rate_hz,setting,most_clone_rms_mm,most_lag_g,most_cubes_rms_mm,most_turn_deg\n"
      "boxes,240,one,9,9,9,9\nboxes,240,even,0.12345,0.5,0.25,18\n"
      "boxes,60,even,8,8,8,8\nboxes,240,uneven,1,2,3,180\n"
      "bullet-lx,240,even,1,1,1,1\npush,15,even,0,0,0,0\n");
  EXPECT_NE(text.find("{\"push\", {0, 0, 0, 0}, {}},\n"
                      "{\"boxes\", {0.000123, 0.5, 0.00025, 0.314}, "
                      "Tolerance{0.001, 2, 0.003, 3.14}},\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("bullet"), std::string::npos);
}

}  // namespace
}  // namespace heft
