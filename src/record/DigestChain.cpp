#include "record/DigestChain.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "record/Binding.h"
#include "record/RowQueries.h"

namespace heft {

namespace {
template <typename... Values>
std::optional<std::string> first_text(SQLite::Database& database, const char* sql,
                                      const Values&... values) {
  SQLite::Statement query(database, sql);
  Binding binding(query, values...);
  if (!binding.step()) return std::nullopt;
  return query.getColumn(0).getString();
}
}  // namespace

const std::string& DigestChain::before_event(std::int64_t session_id) {
  if (!event_ || event_->session_id != session_id)
    event_ = {session_id, std::nullopt, last_event(session_id)};
  return event_->digest;
}

const std::string& DigestChain::before_frame(std::int64_t session_id,
                                             std::optional<std::int64_t> trial_id) {
  if (!frame_ || frame_->session_id != session_id || frame_->trial_id != trial_id)
    frame_ = {session_id, trial_id, last_frame(session_id, trial_id)};
  return frame_->digest;
}

void DigestChain::forget() {
  event_.reset();
  frame_.reset();
}

std::string DigestChain::start(std::int64_t session_id) {
  return first_text(database_, chain_start_sql, session_id).value_or("");
}

std::string DigestChain::last_event(std::int64_t session_id) {
  const auto digest = first_text(
      database_, "SELECT digest FROM event WHERE session_id = ? ORDER BY event_id DESC LIMIT 1",
      session_id);
  return digest ? *digest : start(session_id);
}

std::string DigestChain::last_frame(std::int64_t session_id, std::optional<std::int64_t> trial_id) {
  const auto digest = first_text(database_,
                                 "SELECT digest FROM frame WHERE session_id = ? AND trial_id IS ? "
                                 "ORDER BY frame_id DESC LIMIT 1",
                                 session_id, trial_id);
  return digest ? *digest : start(session_id);
}

}  // namespace heft
