#include "record/integrity/Seals.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "record/schema/Binding.h"
#include "record/schema/Digests.h"
#include "record/schema/RowSql.h"

namespace heft {

namespace {
constexpr auto seal_columns =
    "seal_id, session_id, state, n_events, n_frames, info_digest, digest, head";

Seal seal_from(SQLite::Statement& query) {
  return {query.getColumn(0).getInt64(),
          query.getColumn(1).getInt64(),
          query.getColumn(2),
          query.getColumn(3).getInt64(),
          query.getColumn(4).getInt64(),
          query.getColumn(5),
          query.getColumn(6),
          query.getColumn(7)};
}

template <typename... Values>
std::vector<Seal> seals(SQLite::Database& database, std::string_view which,
                        const Values&... values) {
  SQLite::Statement query(database, fmt::format("SELECT {} FROM seal {}", seal_columns, which));
  Binding binding(query, values...);
  std::vector<Seal> found;
  while (binding.step()) found.push_back(seal_from(query));
  return found;
}

bool cover_the_same(const Seal& one, const Seal& other) {
  return one.state == other.state && one.n_events == other.n_events &&
         one.n_frames == other.n_frames && one.info_digest == other.info_digest &&
         one.digest == other.digest;
}

// The header's digest, which covers the seed, is included: otherwise the few possible answers about
// a participant could be tried until one has this digest.
std::string info_sealed(const std::string& header_digest, const std::string& info_digest) {
  RowDigest digest;
  digest.begin("info", header_digest);
  digest.text(info_digest);
  return digest.value();
}

std::string rows_sealed(std::int64_t session_id, const std::string& header_digest,
                        const std::string& last_event, const std::string& last_frames) {
  RowDigest digest;
  digest.begin("rows", header_digest);
  digest.integer(session_id);
  digest.text(last_event);
  digest.text(last_frames);
  return digest.value();
}

std::string head_of(const Seal& seal, const std::string& previous_head) {
  RowDigest digest;
  digest.begin("seal", previous_head);
  digest.integer(seal.seal_id);
  digest.integer(seal.session_id);
  digest.text(seal.state);
  digest.integer(seal.n_events);
  digest.integer(seal.n_frames);
  digest.text(seal.info_digest);
  digest.text(seal.digest);
  return digest.value();
}

std::string last_event(SQLite::Database& database, std::int64_t session_id) {
  SQLite::Statement query(
      database, "SELECT digest FROM event WHERE session_id = ? ORDER BY event_id DESC LIMIT 1");
  query.bind(1, session_id);
  return query.executeStep() ? query.getColumn(0).getString() : "";
}

// The last frame of each chain, by id; found in the index of trials.
std::string last_frames(SQLite::Database& database, std::int64_t session_id) {
  SQLite::Statement query(
      database,
      "SELECT digest FROM frame WHERE frame_id IN (SELECT (SELECT max(frame_id) FROM frame f WHERE "
      "f.trial_id = t.trial_id) FROM trial t WHERE t.session_id = ?1 UNION ALL SELECT "
      "max(frame_id) FROM frame WHERE trial_id IS NULL AND session_id = ?1) ORDER BY frame_id");
  query.bind(1, session_id);
  RowDigest digest;
  digest.begin("frames", "");
  while (query.executeStep()) digest.text(query.getColumn(0).getString());
  return digest.value();
}

struct Header {
  std::string state, digest, info_digest;
  std::int64_t n_events, n_frames;
};

Header header_of(SQLite::Database& database, std::int64_t session_id) {
  SQLite::Statement query(
      database,
      "SELECT state, digest, info_digest, n_events, n_frames FROM session WHERE session_id = ?");
  query.bind(1, session_id);
  query.executeStep();
  return {query.getColumn(0), query.getColumn(1), query.getColumn(2), query.getColumn(3).getInt64(),
          query.getColumn(4).getInt64()};
}

std::string name_of_seal(const Seal& seal) {
  return fmt::format("seal {} (of session {})", seal.seal_id, seal.session_id);
}

BrokenDigest broken_seal(const Seal& seal, std::string logged, std::string recomputed) {
  return {"seal", seal.seal_id, 0, 0, std::move(logged), std::move(recomputed), name_of_seal(seal),
          {}};
}

BrokenDigest unsealed(std::int64_t session_id) {
  BrokenDigest broken{"session", session_id, 0, 0, {}, {}, {}, {}};
  broken.row = fmt::format("the seal of session {}", session_id);
  broken.damage = "missing";
  return broken;
}

std::int64_t last_id_in(SQLite::Database& database, const std::string& table) {
  return database.execAndGet(fmt::format("SELECT ifnull(max({0}_id), 0) FROM {0}", table));
}

// What the session that was withdrawn last left; none in a log of a version that did not note it.
std::optional<std::map<std::string, std::int64_t>> noted_missing_ids(SQLite::Database& database) {
  SQLite::Statement query(database,
                          "SELECT run_options FROM session s WHERE state = ? ORDER BY (SELECT "
                          "max(seal_id) FROM seal l WHERE l.session_id = s.session_id) DESC");
  query.bind(1, std::string(name_of(SessionState::withdrawn)));
  if (!query.executeStep()) return std::map<std::string, std::int64_t>();
  try {
    return nlohmann::json::parse(query.getColumn(0).getString())
        .at("missing_ids")
        .get<std::map<std::string, std::int64_t>>();
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

// Digests do not cover the ids of rows. Rows are numbered from 1 without gaps, except where a
// session was withdrawn; so an id that nothing refers to, that of a table's last row, cannot be
// changed either.
std::optional<BrokenDigest> misnumbered(SQLite::Database& database) {
  auto expected = noted_missing_ids(database);
  if (!expected) return std::nullopt;
  for (const auto& [table, n_missing] : missing_ids(database)) {
    const std::int64_t excess = n_missing - (*expected)[table];
    if (excess == 0) continue;
    const std::int64_t last_id = last_id_in(database, table);
    BrokenDigest broken{
        table, last_id, 0, 0, fmt::format("id {}", last_id), fmt::format("id {}", last_id - excess),
        {},    {}};
    broken.row = fmt::format("the id of the last row of {}", table);
    return broken;
  }
  return std::nullopt;
}

bool has_ended(SQLite::Database& database, std::int64_t session_id) {
  const std::string state = header_of(database, session_id).state;
  return state == name_of(SessionState::finished) || state == name_of(SessionState::aborted);
}

// Sessions with rows or a state that their last seals do not cover.
std::vector<std::int64_t> unsealed_sessions(SQLite::Database& database) {
  SQLite::Statement query(
      database,
      "SELECT session_id FROM session s WHERE NOT EXISTS (SELECT 1 FROM seal WHERE seal_id = "
      "(SELECT max(seal_id) FROM seal l WHERE l.session_id = s.session_id) AND (state, n_events, "
      "n_frames) = (s.state, s.n_events, s.n_frames)) ORDER BY session_id");
  std::vector<std::int64_t> ids;
  while (query.executeStep()) ids.push_back(query.getColumn(0).getInt64());
  return ids;
}
}  // namespace

std::vector<Seal> seals_in(SQLite::Database& database) {
  return seals(database, "ORDER BY seal_id");
}

std::map<std::string, std::int64_t> missing_ids(SQLite::Database& database) {
  std::map<std::string, std::int64_t> missing;
  for (const std::string table : {"event", "frame", "answer", "trial", "setup"})
    missing[table] = last_id_in(database, table) -
                     database.execAndGet("SELECT count(*) FROM " + table).getInt64();
  return missing;
}

std::string seal(SQLite::Database& database, std::int64_t session_id) {
  const Header header = header_of(database, session_id);
  const auto last = seals(database, "ORDER BY seal_id DESC LIMIT 1");
  const auto last_of_session =
      seals(database, "WHERE session_id = ? ORDER BY seal_id DESC LIMIT 1", session_id);
  Seal seal{last.empty() ? 1 : last.front().seal_id + 1,
            session_id,
            header.state,
            header.n_events,
            header.n_frames,
            info_sealed(header.digest, header.info_digest),
            rows_sealed(session_id, header.digest, last_event(database, session_id),
                        last_frames(database, session_id)),
            {}};
  if (!last_of_session.empty() && cover_the_same(last_of_session.front(), seal))
    return last.front().head;
  seal.head = head_of(seal, last.empty() ? "" : last.front().head);
  SQLite::Statement insert(database, insert_sql("seal", seal_columns));
  run(insert, seal.seal_id, seal.session_id, seal.state, seal.n_events, seal.n_frames,
      seal.info_digest, seal.digest, seal.head);
  return seal.head;
}

void seal_sessions(SQLite::Database& database) {
  for (const std::int64_t session_id : unsealed_sessions(database)) seal(database, session_id);
}

void seal_if_ended(SQLite::Database& database, std::int64_t session_id) {
  if (has_ended(database, session_id)) seal(database, session_id);
}

std::optional<BrokenDigest> first_broken_seal(SQLite::Database& database) {
  std::string head;
  std::int64_t n = 0;
  for (const Seal& seal : seals_in(database)) {
    const std::string recomputed = head_of(seal, head);
    if (seal.seal_id != ++n || recomputed != seal.head)
      return broken_seal(seal, "head " + short_head(seal.head), "head " + short_head(recomputed));
    head = seal.head;
  }
  const auto missing =
      seals(database,
            "WHERE session_id NOT IN (SELECT session_id FROM session) ORDER BY seal_id LIMIT 1");
  if (!missing.empty())
    return broken_seal(missing.front(), "a session that is sealed", "no such session");
  const auto not_sealed = unsealed_sessions(database);
  if (not_sealed.size() > 1 || (!not_sealed.empty() && has_ended(database, not_sealed.front())))
    return unsealed(not_sealed.front());
  return misnumbered(database);
}

SealCheck::SealCheck(SQLite::Database& database, std::int64_t session_id)
    : database_(database),
      session_id_(session_id),
      seals_(seals(database, "WHERE session_id = ? ORDER BY seal_id", session_id)) {
  events_[0] = "";
  collect_frames();
}

void SealCheck::event(const std::string& digest) {
  ++n_events_;
  if (std::ranges::find(seals_, n_events_, &Seal::n_events) != seals_.end())
    events_[n_events_] = digest;
}

void SealCheck::frame(const std::string& chain, const std::string& digest) {
  chains_[chain] = {++n_frames_, digest};
  collect_frames();
}

void SealCheck::collect_frames() {
  if (std::ranges::find(seals_, n_frames_, &Seal::n_frames) == seals_.end()) return;
  std::map<std::int64_t, std::string> in_order;
  for (const auto& [chain, last] : chains_) in_order.insert(last);
  RowDigest digest;
  digest.begin("frames", "");
  for (const auto& [number, last] : in_order) digest.text(last);
  frames_[n_frames_] = digest.value();
}

std::optional<BrokenDigest> SealCheck::first_broken() const {
  const Header header = header_of(database_, session_id_);
  const bool is_withdrawn = header.state == name_of(SessionState::withdrawn);
  if (is_withdrawn && seals_.empty()) return unsealed(session_id_);
  for (const Seal& seal : seals_) {
    if (is_withdrawn && &seal != &seals_.back()) continue;  // of rows that were removed
    const auto events = events_.find(seal.n_events), frames = frames_.find(seal.n_frames);
    if (events == events_.end() || frames == frames_.end())
      return broken_seal(seal, fmt::format("{} events and {} frames", seal.n_events, seal.n_frames),
                         fmt::format("{} events and {} frames", n_events_, n_frames_));
    const std::string digest =
        rows_sealed(session_id_, header.digest, events->second, frames->second);
    if (digest != seal.digest)
      return broken_seal(seal, "digest " + short_head(seal.digest), "digest " + short_head(digest));
  }
  if (seals_.empty()) return std::nullopt;
  const Seal& last = seals_.back();
  const bool has_grown = n_events_ > last.n_events || n_frames_ > last.n_frames;
  if (has_grown) return std::nullopt;
  const std::string info = info_sealed(header.digest, header.info_digest);
  if (header.state != last.state) return broken_seal(last, last.state, header.state);
  if (info != last.info_digest)
    return broken_seal(last, "digest " + short_head(last.info_digest),
                       "digest " + short_head(info));
  return std::nullopt;
}

}  // namespace heft
