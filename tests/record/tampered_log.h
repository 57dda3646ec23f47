// A log whose copies are changed, to test what is found.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "record/reader/LogReader.h"
#include "record/rows.h"
#include "record/temporary_folder.h"
#include "record/writer/SessionLog.h"

namespace heft::test {

class TamperedLog : public testing::Test {
 protected:
  // Session 2 has events 1 to 4 and frames 1 to 6, of which 3 and 6 are outside trials.
  void SetUp() override {
    SessionLog::start(original_, header_of("P01"));
    write_session("P02");
    write_session("P03");
  }

  void write_session(const std::string& participant) {
    SessionLog log = SessionLog::start(original_, header_of(participant));
    for (int n = 1; n <= 2; ++n) {
      log.append(event(n, event_kind<TrialStarted>), starting(sorting_trial(n, n)),
                 Durability::acknowledged);
      log.append(action(n + 0.25, "label", 2, "heaviest"), of_attempt(n), Durability::acknowledged);
      for (double t_s : {n + 0.5, n + 0.75}) log.add_frame(picture(n, t_s));
      log.add_frame(picture(0, n + 0.9));
    }
  }

  static FrameRow picture(int attempt_index, double t_s) {
    FrameRow made = frame(attempt_index, t_s);
    made.contact_slot = 2;
    made.quality = 0.9;
    return made;
  }

  /// The broken digest in a session after changing a copy with all constraints disabled.
  std::optional<BrokenDigest> found_after(const std::string& change, std::int64_t session_id = 2) {
    std::filesystem::copy_file(original_, copy_, std::filesystem::copy_options::overwrite_existing);
    {
      SQLite::Database database(copy_, SQLite::OPEN_READWRITE);
      database.exec("PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = OFF");
      database.exec(change);
    }
    return LogReader(copy_).first_broken_digest(session_id);
  }

  void expect_found(const std::string& change, const std::string& table, std::int64_t row_id) {
    const auto broken = found_after(change);
    ASSERT_TRUE(broken) << change;
    EXPECT_EQ(broken->table, table) << change;
    EXPECT_EQ(broken->row_id, row_id) << change;
  }

  TemporaryFolder folder_;
  std::string original_ = folder_.file("log.db"), copy_ = folder_.file("copy.db");
};

}  // namespace heft::test
