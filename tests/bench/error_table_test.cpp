// What `auto` picks from is what the bench measured. HEFT_WRITE_ERROR_TABLE=1 in the environment
// writes the table anew, after a new `heft bench physics`.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "base/TextFile.h"
#include "bench/physics/ErrorTable.h"

namespace heft {
namespace {

TEST(ErrorTable, IsThatOfTheCheckedInResults) {
  const std::string source = HEFT_SOURCE_DIR "/src/physics/auto/ErrorTable.inc";
  const std::string text =
      error_table_text(read_text_file(HEFT_SOURCE_DIR "/results/physics/errors.csv"));
  if (std::getenv("HEFT_WRITE_ERROR_TABLE")) std::ofstream(source) << text;
  EXPECT_EQ(read_text_file(source), text) << "HEFT_WRITE_ERROR_TABLE=1 writes it anew";
}

TEST(ErrorTable, LeavesOutWhatBlowsUpOrIsNotModeled) {
  const std::string text = error_table_text(
      "simulator,rate_hz,scene_class,n_scenes,n_outside_model,n_blew_up,worst_clone_rms_mm,"
      "worst_cubes_rms_mm,worst_clone_turn_rms_deg,worst_lag_error_g\n"
      "boxes,60,push,3,0,0,0.12345,0,0,1\nboxes,60,turn,3,0,1,0.1,0,0,1\n"
      "bullet-ea,60,push,3,0,0,0.1,0,0,1\npush,60,turn,2,2,0,,,,\npush,60,push,2,0,0,0,0,0,0\n");
  EXPECT_NE(text.find("{\"push\", 60, SceneClass::push, 0, 0},\n"
                      "{\"boxes\", 60, SceneClass::push, 0.123, 1},\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("turn"), std::string::npos);
  EXPECT_EQ(text.find("bullet-ea"), std::string::npos);
}

}  // namespace
}  // namespace heft
