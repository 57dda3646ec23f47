// A log of version 1 is read as it is, keeps its digests, and becomes one of today's when written.
#include <gmock/gmock.h>

#include "record/tampered_log.h"

namespace heft::test {
namespace {

class older_version : public TamperedLog {
 protected:
  // What version 1 wrote: the same rows without the columns that came later.
  void SetUp() override {
    TamperedLog::SetUp();
    SQLite::Database file(original_, SQLite::OPEN_READWRITE);
    for (const char* column : {"detected_s", "simulated_s", "n_dropped"})
      file.exec(fmt::format("ALTER TABLE frame DROP COLUMN {}", column));
    file.exec("PRAGMA user_version = 1");
  }
};

TEST_F(older_version, is_read_with_its_digests) {
  const LogReader reader(original_);
  for (std::int64_t session_id : {2, 3}) {
    EXPECT_EQ(reader.frames(session_id, 1).size(), 2U);
    EXPECT_FALSE(reader.first_broken_digest(session_id));
  }
  EXPECT_FALSE(reader.frames(2, 1).front().detected_s);
}

TEST_F(older_version, is_brought_up_to_date_when_somebody_goes_on_with_it) {
  {
    SessionLog log = SessionLog::reopen(original_, 2);
    FrameRow timed = frame(1, 9);
    timed.detected_s = 9.01;
    timed.simulated_s = 9.02;
    timed.n_dropped = 1;
    log.add_frame(timed);
  }
  const LogReader reader(original_);
  EXPECT_EQ(reader.frames(2, 1).back().n_dropped, 1);
  EXPECT_EQ(reader.frames(2, 1).front().n_dropped, std::nullopt);
  for (std::int64_t session_id : {2, 3}) EXPECT_FALSE(reader.first_broken_digest(session_id));
}

TEST_F(older_version, a_changed_time_of_a_new_row_is_found) {
  {
    SessionLog log = SessionLog::reopen(original_, 2);
    FrameRow timed = frame(1, 9);
    timed.detected_s = 9.01;
    log.add_frame(timed);
  }
  SQLite::Database(original_, SQLite::OPEN_READWRITE)
      .exec("UPDATE frame SET detected_s = NULL WHERE detected_s IS NOT NULL");
  EXPECT_TRUE(LogReader(original_).first_broken_digest(2));
}

}  // namespace
}  // namespace heft::test
