#include "record/writer/SessionLog.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <utility>

#include "base/Error.h"
#include "base/Names.h"
#include "base/files/Printable.h"
#include "record/file/Failures.h"
#include "record/file/LogFile.h"
#include "record/integrity/Seals.h"
#include "record/schema/EventRow.h"
#include "record/schema/Schema.h"
#include "record/writer/RowWriter.h"

namespace heft {

namespace {
constexpr auto longest_wait = std::chrono::seconds(1);
constexpr int busy_timeout_ms = 1000;  ///< longest unannounced wait for a lock

std::string counted(const std::vector<RecordedEntry>& entries) {
  if (entries.empty()) return "the session";
  std::ptrdiff_t n_frames = 0;
  for (const RecordedEntry& entry : entries)
    if (std::holds_alternative<FrameRow>(entry)) ++n_frames;
  return fmt::format("the last {} and {}", heft::counted(std::ssize(entries) - n_frames, "event"),
                     heft::counted(n_frames, "picture"));
}
}  // namespace

class SessionLog::Impl {
 public:
  explicit Impl(const std::string& path) : file_(path), writer_(file_.database()) {
    file_.database().setBusyTimeout(busy_timeout_ms);
  }
  Impl(const Impl&) = delete;
  ~Impl() { write_last(); }

  void start(const SessionHeader& header, const std::optional<RecordedEvent>& first);
  void reopen(std::int64_t session_id);
  void append(const Event& event, const Changes& changes, Durability durability);
  void add_frame(const FrameRow& frame);
  void add_info(const std::string& key, const std::string& value);
  void flush();
  std::string seal();
  std::int64_t session_id() const { return session_id_; }

 private:
  void check_session(std::int64_t session_id);
  void refuse_after_failure() const;
  [[noreturn]] void fail(const std::string& what, const std::exception& reason);
  Error described(const std::string& what, const std::exception& reason);
  void forget_lock();
  void wait_with(RecordedEntry entry);
  void commit_waiting();
  void commit_or_fail(const std::string& what);
  void write_last() noexcept;
  std::string described(const Event& event, const Changes& changes);

  LogFile file_;
  RowWriter writer_;
  std::int64_t session_id_ = 0;
  std::vector<RecordedEntry> waiting_;                             ///< not yet written, in order
  std::vector<std::pair<std::string, std::string>> waiting_info_;  ///< not yet written
  std::chrono::steady_clock::time_point waiting_since_;
  std::string failure_;     ///< of the first call that failed
  bool is_locked_ = false;  ///< by another program, reported by LogBusy
};

void SessionLog::Impl::start(const SessionHeader& header,
                             const std::optional<RecordedEvent>& first) {
  try {
    SQLite::Transaction transaction(file_.database(), SQLite::TransactionBehavior::IMMEDIATE);
    schema::create(file_.database());
    seal_sessions(file_.database());
    session_id_ = writer_.write_session(header);
    if (first) {
      writer_.write(session_id_, *first);
      writer_.write_rest(session_id_);
    }
    transaction.commit();
  } catch (const std::exception& error) {
    throw write_error("the start of the session", file_, error, "start again");
  }
}

void SessionLog::Impl::reopen(std::int64_t session_id) {
  if (schema::kind_of(file_.database()) == schema::FileKind::empty)
    throw Error(fmt::format("{} has no session. Start one with heft run.", file_.path()));
  try {
    SQLite::Transaction transaction(file_.database(), SQLite::TransactionBehavior::IMMEDIATE);
    schema::create(file_.database());
    check_session(session_id);
    seal_sessions(file_.database());
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    throw write_error("the reopened session", file_, error, "try again");
  }
  session_id_ = session_id;
}

void SessionLog::Impl::check_session(std::int64_t session_id) {
  SQLite::Statement query(file_.database(), "SELECT 1 FROM session WHERE session_id = ?");
  query.bind(1, session_id);
  if (!query.executeStep())
    throw Error(
        fmt::format("{} has no session {}. heft resume --db {} without --session resumes "
                    "the latest unfinished one.",
                    file_.path(), session_id, shell_quoted(file_.path())));
}

void SessionLog::Impl::append(const Event& event, const Changes& changes, Durability durability) {
  refuse_after_failure();
  if (durability == Durability::buffered) return wait_with(RecordedEvent{event, changes});
  waiting_.push_back(RecordedEvent{event, changes});
  try {
    commit_waiting();
  } catch (const std::exception& error) {
    const std::string what = described(event, changes);
    // Earlier entries may still be saved on destruction, later ones must not.
    if (!is_busy(error) && !waiting_.empty()) waiting_.pop_back();
    fail(what, error);
  }
}

void SessionLog::Impl::add_frame(const FrameRow& frame) {
  refuse_after_failure();
  wait_with(frame);
}

void SessionLog::Impl::add_info(const std::string& key, const std::string& value) {
  refuse_after_failure();
  waiting_info_.emplace_back(key, value);
  try {
    commit_waiting();
  } catch (const std::exception& error) {
    if (!is_busy(error) && !waiting_info_.empty()) waiting_info_.pop_back();
    fail(fmt::format("the answer about the participant ({})", key), error);
  }
}

void SessionLog::Impl::flush() {
  refuse_after_failure();
  commit_or_fail(counted(waiting_));
}

std::string SessionLog::Impl::seal() {
  flush();
  try {  // a session that ended is sealed already: nothing is written
    SQLite::Transaction transaction(file_.database(), SQLite::TransactionBehavior::DEFERRED);
    std::string head = heft::seal(file_.database(), session_id_);
    transaction.commit();
    return head;
  } catch (const SQLite::Exception& error) {
    fail("the session's seal", error);
  }
}

void SessionLog::Impl::refuse_after_failure() const {
  if (!failure_.empty()) throw Error(failure_);
}

// A lock of another program is no failure: the data are kept and written later.
void SessionLog::Impl::fail(const std::string& what, const std::exception& reason) {
  const Error error = described(what, reason);
  if (is_busy(reason)) {
    is_locked_ = true;
    file_.database().setBusyTimeout(0);
    throw LogBusy(error.what());
  }
  failure_ = error.what();
  throw Error(error);
}

Error SessionLog::Impl::described(const std::string& what, const std::exception& reason) {
  return write_error(what, file_, reason,
                     fmt::format("continue with: heft resume --db {} --session {}",
                                 shell_quoted(file_.path()), session_id_));
}

void SessionLog::Impl::forget_lock() {
  if (std::exchange(is_locked_, false)) file_.database().setBusyTimeout(busy_timeout_ms);
}

void SessionLog::Impl::wait_with(RecordedEntry entry) {
  const auto now = std::chrono::steady_clock::now();
  if (waiting_.empty()) waiting_since_ = now;
  waiting_.push_back(std::move(entry));
  if (now - waiting_since_ >= longest_wait) commit_or_fail(counted(waiting_));
}

void SessionLog::Impl::commit_or_fail(const std::string& what) {
  try {
    commit_waiting();
  } catch (const std::exception& error) {
    fail(what, error);
  }
}

void SessionLog::Impl::commit_waiting() {
  file_.check_in_place();
  if (waiting_.empty() && waiting_info_.empty() && !is_locked_) return;
  try {
    SQLite::Transaction transaction(file_.database(), SQLite::TransactionBehavior::IMMEDIATE);
    for (const RecordedEntry& entry : waiting_) writer_.write(session_id_, entry);
    for (const auto& [key, value] : waiting_info_) writer_.write_info(session_id_, key, value);
    writer_.write_rest(session_id_);
    seal_if_ended(file_.database(), session_id_);
    transaction.commit();
  } catch (...) {
    writer_.forget();
    throw;
  }
  waiting_.clear();
  waiting_info_.clear();
  forget_lock();
  file_.check_in_place();
}

// Failures that a call has reported are not reported again.
void SessionLog::Impl::write_last() noexcept {
  try {
    commit_waiting();
  } catch (const std::exception& error) {
    if (!failure_.empty() || is_locked_) return;
    std::fprintf(stderr, "heft: %s\n", escaped(described(counted(waiting_), error).what()).c_str());
  }
}

std::string SessionLog::Impl::described(const Event& event, const Changes& changes) {
  std::optional<int> trial_number;
  if (changes.trial)
    trial_number = changes.trial->plan.trial_number;
  else if (changes.attempt_index > 0)
    trial_number = writer_.trial_number(session_id_, changes.attempt_index);
  return description(event, trial_number);
}

SessionLog SessionLog::start(const std::string& path, const SessionHeader& header,
                             const std::optional<RecordedEvent>& first) {
  auto impl = std::make_unique<Impl>(path);
  impl->start(header, first);
  return SessionLog(std::move(impl));
}

SessionLog SessionLog::reopen(const std::string& path, std::int64_t session_id) {
  auto impl = std::make_unique<Impl>(path);
  impl->reopen(session_id);
  return SessionLog(std::move(impl));
}

SessionLog::SessionLog(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SessionLog::SessionLog(SessionLog&&) noexcept = default;
SessionLog& SessionLog::operator=(SessionLog&&) noexcept = default;
SessionLog::~SessionLog() = default;

std::int64_t SessionLog::session_id() const {
  return impl_->session_id();
}

void SessionLog::append(const Event& event, const Changes& changes, Durability durability) {
  impl_->append(event, changes, durability);
}

void SessionLog::add_frame(const FrameRow& frame) {
  impl_->add_frame(frame);
}

void SessionLog::add_info(const std::string& key, const std::string& value) {
  impl_->add_info(key, value);
}

void SessionLog::flush() {
  impl_->flush();
}

std::string SessionLog::seal() {
  return impl_->seal();
}

class SessionArchive::Impl {
 public:
  explicit Impl(const std::string& path) : file_(path), writer_(file_.database()) {
    constexpr int archive_timeout_ms = 30'000;  // the simulation may have taken hours
    file_.database().setBusyTimeout(archive_timeout_ms);
  }

  std::int64_t store(const RecordedSession& session) {
    SQLite::Transaction transaction(file_.database(), SQLite::TransactionBehavior::IMMEDIATE);
    schema::create(file_.database());
    if (!std::exchange(are_sealed_, true)) seal_sessions(file_.database());
    const std::int64_t session_id = writer_.write_session(session.header());
    for (const RecordedEntry& entry : session.entries()) writer_.write(session_id, entry);
    writer_.write_rest(session_id);
    seal(file_.database(), session_id);
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
  bool are_sealed_ = false;  ///< the sessions that were in the log
};

SessionArchive::SessionArchive(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
SessionArchive::SessionArchive(SessionArchive&&) noexcept = default;
SessionArchive& SessionArchive::operator=(SessionArchive&&) noexcept = default;
SessionArchive::~SessionArchive() = default;

std::int64_t SessionArchive::store(const RecordedSession& session) {
  return impl_->store_or_explain(session);
}

}  // namespace heft
