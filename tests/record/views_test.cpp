// The views for other programs.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {
namespace {

/// A cell as text; "NULL" for NULL.
std::string cell(const std::string& file, const std::string& query) {
  SQLite::Database database(file, SQLite::OPEN_READONLY);
  SQLite::Statement statement(database, query);
  if (!statement.executeStep()) return "no row";
  return statement.getColumn(0).isNull() ? "NULL" : statement.getColumn(0).getString();
}

class Views : public testing::Test {
 protected:
  std::string of(const std::string& query) const { return cell(file_, query); }

  // Masses by slot: 800, 15, 200 g. Shown at 11 s, validated at 31.5 s.
  void complete_sorting(int attempt_index, const std::vector<Event>& answers) {
    TrialRow trial = sorting_trial(attempt_index, 10);
    log_.append(event(10, event_kind<TrialStarted>), starting(trial), Durability::buffered);
    for (const Event& answer : answers) {
      Changes changes = of_attempt(attempt_index);
      changes.answers = {answer_of(attempt_index, answer)};
      log_.append(answer, changes, Durability::buffered);
    }
    trial.status = TrialStatus::completed;
    trial.outcome = "correct";
    trial.shown_s = 11;
    trial.validated_s = trial.ended_s = 31.5;
    trial.paused_s = 4;
    trial.lost_s = 0.25;
    log_.append(event(31.5, event_kind<Note>), starting(trial), Durability::acknowledged);
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("log.db");
  SessionLog log_ = SessionLog::start(file_, header_of("P07"));
};

TEST_F(Views, ResponseTimeExcludesPausesAndLosses) {
  complete_sorting(1, {});
  EXPECT_EQ(of("SELECT response_time_s FROM v_trial"), "16.25");
  EXPECT_EQ(of("SELECT response_time_s FROM v_sorting"), "16.25");
}

TEST_F(Views, TrialHasMassesParticipantAndPushes) {
  TrialRow trial = sorting_trial(1, 10);
  Changes changes = starting(trial);
  changes.cubes = {{1, 1, 800, 2, 1.5, {}, {}}, {1, 3, 200, 3, 0.25, {}, {}}};
  log_.append(event(10, event_kind<TrialStarted>), changes, Durability::acknowledged);
  EXPECT_EQ(of("SELECT participant || ' ' || cube1_mass_g || ' ' || cube2_mass_g || ' ' || "
               "cube3_mass_g FROM v_trial"),
            "P07 800.0 15.0 200.0");
  EXPECT_EQ(of("SELECT n_pushes || ' ' || contact_s FROM v_trial"), "5 1.75");
  EXPECT_EQ(of("SELECT response_time_s FROM v_trial"), "NULL");
}

TEST_F(Views, ComparisonHasItsMassAndNoThirdCube) {
  TrialRow trial = sorting_trial(1, 10);
  trial.plan.task = "comparison";
  trial.plan.staircase = "200g";
  trial.plan.reference_g = 200;
  trial.plan.level_g = 75;
  trial.plan.masses_g = {275, 200};
  log_.append(event(10, event_kind<TrialStarted>), starting(trial), Durability::acknowledged);
  EXPECT_EQ(of("SELECT comparison_g FROM v_trial"), "275.0");
  EXPECT_EQ(of("SELECT cube3_mass_g FROM v_trial"), "NULL");
  EXPECT_EQ(of("SELECT count(*) FROM v_sorting"), "0");
}

// The effector is turned by 20 degrees about z and tilted; the clone by 12 degrees more about its
// z.
TEST_F(Views, FrameHasTurnOfCloneAgainstEffector) {
  const auto turned = [](double rad, const Eigen::Vector3d& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(rad, axis));
  };
  TrialRow trial = sorting_trial(1, 10);
  log_.append(event(10, event_kind<TrialStarted>), starting(trial), Durability::acknowledged);
  FrameRow frame;
  frame.attempt_index = 1;
  frame.contact_slot = 2;
  frame.effector.orientation =
      turned(0.35, Eigen::Vector3d::UnitZ()) * turned(0.1, Eigen::Vector3d::UnitX());
  for (const double deg : {12.0, -70.0}) {
    frame.clone = frame.effector;
    frame.clone->orientation =
        frame.effector.orientation * turned(deg * M_PI / 180, Eigen::Vector3d::UnitZ());
    frame.clone->orientation.coeffs() *= deg < 0 ? -1 : 1;  // the same turn
    log_.add_frame(frame);
  }
  frame.clone.reset();
  log_.add_frame(frame);
  log_.flush();
  EXPECT_EQ(of("SELECT round(clone_yaw_deg, 6) FROM v_frame ORDER BY frame_id"), "12.0");
  EXPECT_EQ(of("SELECT round(min(clone_yaw_deg), 6) FROM v_frame"), "-70.0");
  EXPECT_EQ(of("SELECT count(clone_yaw_deg) FROM v_frame"), "2");
}

// 40 px of 0.15 mm are 6 mm, at 450 mm 0.7639 degrees (small-angle approximation: 0.76394).
TEST_F(Views, FrameHasVisualAngleOfOffset) {
  SessionConfig setup;
  setup.display_w_px = 1000;
  setup.display_w_mm = 150;
  setup.eye_distance_mm = 450;
  Changes told;
  told.setup = setup;
  log_.append(Event{9, setup}, told, Durability::acknowledged);
  TrialRow trial = sorting_trial(1, 10);
  trial.setup_index = 1;
  log_.append(event(10, event_kind<TrialStarted>), starting(trial), Durability::acknowledged);
  FrameRow frame;
  frame.attempt_index = 1;
  frame.clone_offset_px = 40;
  log_.add_frame(frame);
  frame.clone_offset_px.reset();
  log_.add_frame(frame);
  log_.flush();
  EXPECT_EQ(of("SELECT clone_offset_mm FROM v_frame ORDER BY frame_id"), "6.0");
  EXPECT_EQ(of("SELECT round(clone_offset_deg, 4) FROM v_frame ORDER BY frame_id"), "0.7639");
  EXPECT_EQ(of("SELECT count(clone_offset_deg) FROM v_frame"), "1");
  EXPECT_EQ(of("SELECT round(peak_clone_offset_deg, 4) FROM v_trial"), "0.7639");
}

TEST_F(Views, JndHasReferenceOfItsStaircase) {
  TrialRow trial = sorting_trial(1, 10);
  trial.plan.task = "comparison";
  trial.plan.staircase = "fine";
  trial.plan.reference_g = 800;
  Changes changes = starting(trial);
  changes.estimates = {
      {"fine", "mean_of_reversals", 101.5, {}, {}, 32, 10, 1, 0, StopReason::reversals, {}}};
  log_.append(event(10, event_kind<TrialStarted>), changes, Durability::acknowledged);
  EXPECT_EQ(of("SELECT participant || ' ' || staircase || ' ' || reference_g || ' ' || jnd_g || ' "
               "' || n_trials || ' ' || reason FROM v_jnd"),
            "P07 fine 800.0 101.5 32 reversals");
}

TEST_F(Views, SortingHasMassOfEachFinalLabel) {
  complete_sorting(1, {action(12, "label", 1, "heaviest"), action(13, "label", 2, "lightest"),
                       action(14, "label", 3, "intermediate")});
  EXPECT_EQ(of("SELECT labeled_lightest_g || ' ' || labeled_intermediate_g || ' ' || "
               "labeled_heaviest_g FROM v_sorting"),
            "15.0 200.0 800.0");
}

TEST_F(Views, SortingFollowsMovedReplacedAndRemovedLabels) {
  complete_sorting(
      1,
      {action(12, "label", 1, "lightest"), action(13, "label", 2, "lightest"),      // moves it
       action(14, "label", 1, "heaviest"), action(15, "label", 1, "intermediate"),  // replaces it
       action(16, "label", 3, "heaviest"), action(17, "unlabel", 3)});
  EXPECT_EQ(of("SELECT labeled_lightest_g FROM v_sorting"), "15.0");
  EXPECT_EQ(of("SELECT labeled_intermediate_g FROM v_sorting"), "800.0");
  EXPECT_EQ(of("SELECT labeled_heaviest_g FROM v_sorting"), "NULL");
}

TEST_F(Views, VoidAttemptsAreNoSortingResults) {
  TrialRow trial = sorting_trial(1, 10);
  trial.status = TrialStatus::voided;
  trial.void_reason = "camera";
  log_.append(event(10, event_kind<TrialStarted>), starting(trial), Durability::acknowledged);
  EXPECT_EQ(of("SELECT count(*) FROM v_sorting"), "0");
  EXPECT_EQ(of("SELECT status || ' ' || void_reason FROM v_trial"), "void camera");
}

}  // namespace
}  // namespace heft::test
