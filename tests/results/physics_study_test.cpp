// The quick part of the physics study: its files exist, and their figures support its statements.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>

#include "SourceFolder.h"
#include "base/files/TextFile.h"
#include "results/Study.h"
#include "results/StudyFolder.h"
#include "results/physics/Stability.h"
#include "results/physics/scenes/Measurements.h"
#include "results/physics/scenes/RandomScenes.h"

namespace heft {
namespace {

using Row = std::map<std::string, std::string>;

// Cells have no commas in these files but for the last one, the command.
std::vector<Row> rows_of(const std::string& path) {
  const std::string text = read_text_file(path);
  const auto lines = lines_of(text);
  const auto names = cells_of(lines.front());
  std::vector<Row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto cells = cells_of(lines[i]);
    EXPECT_EQ(cells.size(), names.size()) << path << " line " << i + 1;
    Row& row = rows.emplace_back();
    for (std::size_t c = 0; c < std::min(cells.size(), names.size()); ++c)
      row[std::string(names[c])] = cells[c];
  }
  return rows;
}

class QuickStudy : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = testing::TempDir() + "heft_physics_study_" + std::to_string(::getpid());
    std::filesystem::create_directories(folder);
    study_named("physics").run({folder, "heft bench physics --quick", true});
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder); }
  static std::vector<Row> rows(const std::string& name) { return rows_of(folder + "/" + name); }

  static inline std::string folder;
};

TEST_F(QuickStudy, MakesEveryFileAndSaysWhereItIsFrom) {
  for (const char* name : {"work_precision", "references", "stability", "input", "lag_vs_mass",
                           "hands", "promise", "growth"}) {
    const auto table = rows(std::string(name) + ".csv");
    EXPECT_FALSE(table.empty()) << name;
    for (const Row& row : table) {
      EXPECT_EQ(row.at("command"), "heft bench physics --quick") << name;
      EXPECT_FALSE(row.at("commit").empty()) << name;
      for (const auto& [column, cell] : row) {
        EXPECT_EQ(cell.find("nan"), std::string::npos) << name << ' ' << column;
        EXPECT_EQ(cell.find("inf"), std::string::npos) << name << ' ' << column;
      }
    }
  }
}

TEST_F(QuickStudy, DrawsEveryChart) {
  for (const char* name :
       {"work_precision", "stability", "input", "lag_vs_mass", "hands", "growth"}) {
    const std::string path = folder + "/" + name + ".svg";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "gnuplot is not installed";
    EXPECT_THAT(read_text_file(path), testing::HasSubstr("heft bench physics --quick")) << name;
    EXPECT_FALSE(std::filesystem::exists(folder + "/" + name + ".gnuplot"));
  }
}

// The chart of the checked-in table. HEFT_DRAW_CHART=1 in the environment also checks it in.
TEST(WorkPrecisionChart, LabelsOfRatesAreApart) {
  const StudyFolder folder("work_precision");
  const std::string results = source_folder() + "/results/physics", out = folder.options().out;
  std::filesystem::copy(results + "/work_precision.csv", out);
  draw_work_precision(folder.options());
  if (!std::filesystem::exists(out + "/work_precision.svg")) GTEST_SKIP() << "no gnuplot";
  const std::string svg = folder.text("work_precision.svg");
  struct Label {
    double x, y, width;
  };
  std::vector<Label> labels;
  const std::regex rate(
      "translate\\(([0-9.]+),([0-9.]+)\\)\"[^>]*font-size=\"7.00\"[^>]*>"
      "\\s*<text>([0-9]+)<");
  for (std::sregex_iterator found(svg.begin(), svg.end(), rate), end; found != end; ++found)
    labels.push_back({std::stod((*found)[1]), std::stod((*found)[2]),
                      4.45 * static_cast<double>((*found)[3].length())});
  EXPECT_GT(labels.size(), 40u);
  const double height = 5.2;  // of digits
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Label &a = labels[i], &b = labels[j];
      EXPECT_FALSE(std::abs(a.x - b.x) < (a.width + b.width) / 2 && std::abs(a.y - b.y) < height)
          << "two labels at " << a.x << ", " << a.y;
    }
  if (std::getenv("HEFT_DRAW_CHART"))
    std::filesystem::copy_file(out + "/work_precision.svg", results + "/work_precision.svg",
                               std::filesystem::copy_options::overwrite_existing);
}

TEST_F(QuickStudy, HasEverySimulatorAtEveryRateInEveryScene) {
  std::map<std::string, int> n;
  for (const Row& row : rows("work_precision.csv")) ++n[row.at("simulator")];
  for (const SimulatorEntry& simulator : measured_simulators())
    EXPECT_EQ(n[std::string(simulator.name)], 6) << simulator.name;  // 2 rates, 3 scenes
}

TEST_F(QuickStudy, KnowsThatTheExplicitForceBlowsUpAndThatBoxesDoNot) {
  for (const Row& row : rows("work_precision.csv")) {
    if (row.at("scene_class") != "push") continue;
    if (row.at("simulator") == "bullet-explicit") {
      EXPECT_EQ(row.at("outcome"), "blew_up");
      EXPECT_EQ(row.at("clone_rms_mm"), "");
    }
    if (row.at("simulator") == "boxes") {
      EXPECT_EQ(row.at("outcome"), "ran");
      EXPECT_LT(std::stod(row.at("clone_rms_mm")), 0.25);
    }
  }
}

TEST_F(QuickStudy, ShowsWhatInputHandlingCosts) {
  std::map<std::string, double> in_air, at_picture, at_present, kick;
  for (const Row& row : rows("input.csv")) {
    if (row.at("camera_hz") != "15" || row.at("fault") != "clean") continue;
    const std::string& mode = row.at("mode");
    if (row.at("condition") == "C1") kick[mode] = std::stod(row.at("fastest_cube_m_s"));
    if (row.at("scene") == "free_air") in_air[mode] = std::stod(row.at("clone_at_picture_rms_mm"));
    if (row.at("condition") == "C1" || row.at("scene") == "free_air") continue;
    at_picture[mode] = std::stod(row.at("clone_at_picture_rms_mm"));
    at_present[mode] = std::stod(row.at("clone_at_present_rms_mm"));
  }
  EXPECT_LT(in_air["smooth"], 0.02);
  EXPECT_GT(in_air["path"], 0.1);
  EXPECT_LT(at_picture["path"], 0.3 * at_picture["hold"]);
  EXPECT_LT(at_present["extrapolate"], 0.5 * at_present["path"]);
  EXPECT_LT(kick["path"], 0.2);  // the hand's own speed
  EXPECT_GT(kick["hold"], 1);
}

// At the last step within the stroke, at most 0.42 mm before its end.
TEST_F(QuickStudy, ShowsWhatEachTechniqueMakesOfAMass) {
  for (const Row& row : rows("lag_vs_mass.csv")) {
    const std::string& technique = row.at("technique");
    if (row.at("simulator") != "boxes" || technique == "C2") continue;
    EXPECT_NEAR(std::stod(row.at("lag_at_end_mm")), std::stod(row.at("expected_mm")), 0.42)
        << technique << ' ' << row.at("cube_mass_g");
  }
}

TEST_F(QuickStudy, DrawsRandomHandsFromItsSeed) {
  std::map<std::string, int> n_ran;
  for (const Row& row : rows("hands.csv")) {
    EXPECT_EQ(row.at("seed"), "1");
    if (row.at("simulator") == "boxes" && row.at("rate_hz") == "240")
      n_ran[row.at("setting")] = std::stoi(row.at("n_ran"));
  }
  EXPECT_EQ(n_ran["even"], 9);
  EXPECT_EQ(n_ran["uneven"], 4);
  const BenchScene one = random_scene(Setting::staggered, 7, 3);
  EXPECT_EQ(path_csv(one), path_csv(random_scene(Setting::staggered, 7, 3)));
  EXPECT_NE(path_csv(one), path_csv(random_scene(Setting::staggered, 7, 4)));
}

TEST(Stability, KnowsAStableMethodFromOthers) {
  const BenchScene scene = stability_scene(Varied::cube_mass, 0.2);
  const SceneTrack reference =
      run_scene(make_simulator("boxes"), scene, 4 * reference_rate_hz, reference_rate_hz).track;
  const auto verdict = [&](const char* name, int rate_hz) {
    return judge(simulator_named(name), scene, reference, rate_hz);
  };
  EXPECT_EQ(verdict("boxes", 240), Verdict::stable);
  EXPECT_EQ(verdict("bullet-stable-pd", 240), Verdict::wrong_lag);
  EXPECT_EQ(verdict("bullet-explicit", 240), Verdict::blows_up);
  EXPECT_EQ(verdict("bullet-soft-rows", 960), Verdict::blows_up);
}

}  // namespace
}  // namespace heft
