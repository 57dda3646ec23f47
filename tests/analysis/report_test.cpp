// The report's folder: its contents, and that other files are not overwritten.
#include "analysis/report/Report.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "MadeUpSessions.h"
#include "analysis/Analysis.h"
#include "analysis/charts/Charts.h"
#include "base/Error.h"
#include "base/files/TextFile.h"

namespace heft {
namespace {

using namespace made_up;
namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class ReportFolder : public testing::Test {
 protected:
  ReportFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::temp_directory_path() / (std::string("heft_report_test_") + test->name());
    fs::remove_all(folder);
  }
  ~ReportFolder() override { fs::remove_all(folder); }

  std::string read(const std::string& name) const { return read_text_file(folder / name); }

  fs::path folder;
};

Summary summary_with_everything() {
  SessionData data = session(1, "it's <P01>", Purpose::simulated, "simulated");
  add_introduction(data, 1);
  add_sortings(data, "C1", "correct", 2);  // and nothing in C2
  add_staircase(data, "15g", 15, 100);
  add_staircase(data, "800g", 800, 700);
  return summarize({"x.db", {data}}, "heft analyse --db x.db --out 'a folder'");
}

TEST_F(ReportFolder, HoldsTablesChartsPageAndSummary) {
  const ReportResult result = write_report(summary_with_everything(), folder);
  for (const char* name :
       {"sorting.csv", "jnd.csv", "sessions.csv", "staircases.gp", "report.html", "summary.json"})
    EXPECT_THAT(result.files, Contains(name));
  for (const std::string& name : result.files) EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_FALSE(fs::exists(folder / "report_unfinished.txt"));
  const auto json = nlohmann::json::parse(read("summary.json"));
  EXPECT_EQ(json["made_by"], "heft analyse");
  EXPECT_EQ(json["command"], "heft analyse --db x.db --out 'a folder'");
}

TEST_F(ReportFolder, PageIsSelfContainedAndEscaped) {
  const ReportResult result = write_report(summary_with_everything(), folder);
  if (!result.charts_drawn) GTEST_SKIP() << "gnuplot is not installed";
  const std::string page = read("report.html");
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, Not(HasSubstr("<?xml")));
  EXPECT_THAT(page, Not(HasSubstr("<P01>")));
  EXPECT_THAT(read("staircases.svg"), HasSubstr("Staircases of session 1"));
}

// Names come from protocols and logs of anybody.
TEST_F(ReportFolder, NamesAreNoCommandsOfGnuplot) {
  const std::string commands =
      fmt::format("x\nsystem('touch {0}/harm')\n#`touch {0}/harm`\"'.system('touch {0}/harm').'",
                  folder.string());
  SessionData data = session(1, commands);
  data.session.header.protocol_name = commands;
  add_introduction(data, 1);
  add_sortings(data, commands, "correct", 4);
  add_staircase(data, commands, 15, 100);
  add_staircase(data, "800g", 800, 700);
  for (Attempt& attempt : data.attempts) attempt.trial.plan.condition = commands;
  const ReportResult result = write_report(summarize({"x.db", {data}}, commands), folder);
  if (!result.charts_drawn) GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_FALSE(fs::exists(folder / "harm"));
  EXPECT_THAT(result.files, Contains("staircases.svg"));
}

TEST_F(ReportFolder, AnswersFirstAndHoldsWhatAReviewerAsksFor) {
  SessionData data = session(1, "a");
  add_sortings(data, "C2", "correct", 8);
  data.setups[0].setup.simulator = "boxes";
  data.noted = {{12.5, event_kind<Deviation>, "the lamp <fell>"}};
  std::vector<SessionData> sessions(13, data);
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    sessions[i].session.session_id = static_cast<int>(i) + 1;
    sessions[i].session.header.participant = "P" + std::to_string(i);
  }
  write_report(summarize({"x.db", sessions}, ""), folder);
  const std::string page = read("report.html");
  EXPECT_THAT(page, HasSubstr("Did C2 work? Yes"));
  EXPECT_THAT(page, Not(HasSubstr("<p>Masses are discriminated in C2.</p>"))) << "said above it";
  EXPECT_THAT(page, HasSubstr("<p>Brackets are 95 % intervals.</p>"));
  EXPECT_LT(page.find("id=\"sorting\""), page.find("id=\"times_by_trial\""));
  EXPECT_LT(page.find("Did C2 work?"), page.find("Contents"));
  EXPECT_THAT(page, HasSubstr("the lamp &lt;fell&gt;"));
  EXPECT_THAT(read("deviations.csv"), HasSubstr("deviation,the lamp <fell>"));
  EXPECT_THAT(read("setups.csv"), HasSubstr("simulator,boxes,,13,104,"));
  EXPECT_THAT(read("dictionary.csv"), HasSubstr("trial,level_g,g,"));
}

TEST_F(ReportFolder, EveryChartCarriesItsCommandAndVersion) {
  for (const Chart& chart : charts_of(summary_with_everything())) {
    EXPECT_THAT(chart.script, HasSubstr("Made by: heft analyse --db x.db --out ''a folder''"));
    EXPECT_THAT(chart.script, HasSubstr("(heft " HEFT_VERSION ")"));
    EXPECT_THAT(chart.title, HasSubstr("(simulated)"));
  }
  std::vector<std::string> names;
  for (const Chart& chart : charts_of(summary_with_everything())) {
    names.push_back(chart.name);
    EXPECT_FALSE(chart.caption.empty()) << chart.name;
    EXPECT_FALSE(chart.csv.empty()) << chart.name;
    EXPECT_GT(chart.n, 0) << chart.name;
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"sorting", "choice_curves", "jnd", "staircases",
                                            "all_staircases_15g", "jnd_against_start",
                                            "beside_published"}));
  EXPECT_TRUE(charts_of(summarize({"x.db", {}}, "")).empty());
}

TEST_F(ReportFolder, OfNothingIsAReportToo) {
  const ReportResult result = write_report(summarize({"x.db", {}}, ""), folder);
  EXPECT_THAT(result.files, Contains("report.html"));
  EXPECT_THAT(read("report.html"), HasSubstr("x.db holds no sessions."));
}

TEST_F(ReportFolder, WithOtherFilesIsRefused) {
  fs::create_directories(folder);
  std::ofstream(folder / "thesis.txt") << "mine";
  EXPECT_THROW(write_report(summary_with_everything(), folder), Error);
  std::ofstream(folder / "summary.json") << R"({"made_by": "me"})";
  EXPECT_THROW(write_report(summary_with_everything(), folder), Error);
  EXPECT_FALSE(fs::exists(folder / "report.html"));
}

TEST_F(ReportFolder, ThatIsAFileIsRefused) {
  std::ofstream(folder.string()) << "mine";
  EXPECT_THROW(refuse_foreign_folder(folder), Error);
}

TEST_F(ReportFolder, ThatIsUnfinishedIsMarkedAndRefused) {
  fs::create_directories(folder / "report.html");  // so that this file can't be written
  std::ofstream(folder / "summary.json") << R"({"made_by": "heft analyse"})";
  EXPECT_THROW(write_report(summary_with_everything(), folder), Error);
  EXPECT_TRUE(fs::exists(folder / "jnd.csv"));
  EXPECT_THAT(read("report_unfinished.txt"), HasSubstr("incomplete"));
  fs::remove(folder / "report.html");
  try {
    refuse_foreign_folder(folder);
    FAIL() << "it is taken for a complete report";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("an unfinished report. Delete it"));
  }
}

TEST_F(ReportFolder, OverAnOlderOneLeavesNothingOfIt) {
  write_report(summary_with_everything(), folder);
  std::ofstream(folder / "notes.txt") << "mine";
  write_report(summarize({"x.db", {session(1, "a")}}, ""), folder);
  EXPECT_FALSE(fs::exists(folder / "jnd.csv"));
  EXPECT_FALSE(fs::exists(folder / "jnd.gp"));
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
}

TEST_F(ReportFolder, WithoutGnuplotHasEverythingButTheDrawings) {
  const std::string path = getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const ReportResult result = write_report(summary_with_everything(), folder);
  setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(result.charts_drawn);
  EXPECT_THAT(result.files, Contains("jnd.gp"));
  EXPECT_THAT(result.files, Not(Contains("jnd.svg")));
  EXPECT_THAT(read("report.html"), HasSubstr("No charts were drawn."));
}

}  // namespace
}  // namespace heft
