#include "record/writer/SessionArchive.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "record/schema/Schema.h"
#include "record/writer/Failures.h"
#include "record/writer/LogFile.h"
#include "record/writer/RowWriter.h"

namespace heft {

class SessionArchive::Impl {
 public:
  explicit Impl(const std::string& path) : file_(path), writer_(file_.database()) {
    constexpr int busy_timeout_ms = 30'000;  // what was computed may have taken hours
    file_.database().setBusyTimeout(busy_timeout_ms);
  }

  std::int64_t store(const RecordedSession& session) {
    SQLite::Transaction transaction(file_.database(), SQLite::TransactionBehavior::IMMEDIATE);
    schema::create(file_.database());
    const std::int64_t session_id = writer_.write_session(session.header());
    for (const RecordedEntry& entry : session.entries()) writer_.write(session_id, entry);
    writer_.write_counts(session_id);
    transaction.commit();
    file_.check_in_place();
    return session_id;
  }

  std::int64_t store_or_explain(const RecordedSession& session) {
    try {
      return store(session);
    } catch (const std::exception& error) {
      writer_.forget();
      throw write_error(fmt::format("the session of {}", session.header().participant), file_,
                        error, "start again");
    }
  }

 private:
  LogFile file_;
  RowWriter writer_;
};

SessionArchive::SessionArchive(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
SessionArchive::SessionArchive(SessionArchive&&) noexcept = default;
SessionArchive& SessionArchive::operator=(SessionArchive&&) noexcept = default;
SessionArchive::~SessionArchive() = default;

std::int64_t SessionArchive::store(const RecordedSession& session) {
  return impl_->store_or_explain(session);
}

}  // namespace heft
