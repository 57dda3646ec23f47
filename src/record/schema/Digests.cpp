#include "record/schema/Digests.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <array>
#include <bit>

#include "base/files/TextFile.h"
#include "record/schema/Binding.h"
#include "record/schema/RowSql.h"

namespace heft {

void RowDigest::begin(std::string_view table, std::string_view previous) {
  bytes_.clear();
  text(table);
  text(previous);
}

void RowDigest::null() {
  bytes_ += 'n';
}

void RowDigest::integer(std::int64_t value) {
  bytes_ += 'i';
  eight_bytes(static_cast<std::uint64_t>(value));
}

void RowDigest::real(double value) {
  bytes_ += 'r';
  eight_bytes(std::bit_cast<std::uint64_t>(value));
}

void RowDigest::text(std::string_view value) {
  sized('t', value);
}

void RowDigest::cell(const SQLite::Column& cell) {
  switch (cell.getType()) {
    case SQLITE_INTEGER:
      return integer(cell.getInt64());
    case SQLITE_FLOAT:
      return real(cell.getDouble());
    case SQLITE_TEXT:
      return text(cell.getString());
    case SQLITE_BLOB:
      return sized('b', cell.getString());
    default:
      return null();
  }
}

std::string RowDigest::value() const {
  return sha256(bytes_);
}

void RowDigest::sized(char type, std::string_view bytes) {
  bytes_ += type;
  eight_bytes(bytes.size());
  bytes_ += bytes;
}

void RowDigest::eight_bytes(std::uint64_t bits) {
  std::array<char, 8> bytes{};
  for (char& byte : bytes) {
    byte = static_cast<char>(bits & 0xff);
    bits >>= 8;
  }
  bytes_.append(bytes.data(), bytes.size());
}

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

std::string info_digest(SQLite::Database& database, std::int64_t session_id) {
  RowDigest digest;
  digest.begin("participant_info", "");
  SQLite::Statement query(
      database, "SELECT key, value FROM participant_info WHERE session_id = ? ORDER BY key");
  query.bind(1, session_id);
  while (query.executeStep()) {
    digest.cell(query.getColumn(0));
    digest.cell(query.getColumn(1));
  }
  return digest.value();
}

}  // namespace heft
