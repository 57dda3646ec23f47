// heft list: the sessions of a log and their progress.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/files/Printable.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "replay/Replay.h"
#include "session/Session.h"

namespace heft::cli {

namespace {
using Line = std::vector<std::string>;

const Line headings{"session",     "participant",   "protocol", "purpose",
                    "state",       "trials",        "minutes",  "pictures dropped, late",
                    "doubled",     "started (UTC)", "head",     "study",
                    "group, order"};

// "2026-11-28 09:30" of "2026-11-28T09:30:12.345Z".
std::string minutes_of(const std::string& utc) {
  constexpr std::size_t day = 10, minutes = 11, length = 5;
  return utc.size() < minutes + length ? utc
                                       : utc.substr(0, day) + ' ' + utc.substr(minutes, length);
}

double percent(int n, int of) {
  return of > 0 ? 100.0 * n / of : 0;
}

// Empty without a live camera.
std::string pictures_text(const PictureCounts& pictures) {
  if (pictures.shown + pictures.dropped == 0) return "";
  return fmt::format("{:.1f} %, {:.1f} %",
                     percent(pictures.dropped, pictures.shown + pictures.dropped),
                     percent(pictures.late, pictures.shown));
}

// Empty without a second print of a tag.
std::string doubled_text(const PictureCounts& pictures) {
  if (pictures.doubled == 0) return "";
  return fmt::format("{:.1f} %", percent(pictures.doubled, pictures.shown));
}

Line line_of(const SessionFacts& facts) {
  const SessionHeader& header = facts.row.header;
  Line line{fmt::format("{}", facts.row.session_id),
            header.participant,
            header.protocol_name,
            std::string(name_of(header.purpose)),
            std::string(name_of(facts.row.state)),
            trials_text(facts),
            fmt::format("{:.0f}", facts.duration_s / 60),
            pictures_text(facts.pictures),
            doubled_text(facts.pictures),
            minutes_of(header.started_utc),
            short_head(facts.head),
            "",
            ""};
  if (const auto& place = facts.place) {
    line[11] = fmt::format("{} {} of {}", place->study, place->number, place->participants);
    line[12] =
        place->group + (place->group.empty() || place->order.empty() ? "" : ": ") + place->order;
  }
  return line;
}

// What several sessions have in common is said once; its column is left empty.
std::string in_common(std::vector<Line>& lines) {
  if (lines.size() < 3) return "";
  std::vector<std::string> common;
  for (const std::size_t k : {2u, 3u, 4u}) {  // protocol, purpose, state
    const auto is_first = [&](const Line& line) { return line[k] == lines[1][k]; };
    if (!std::all_of(lines.begin() + 1, lines.end(), is_first)) continue;
    common.push_back(fmt::format("{} {}", headings[k], lines[1][k]));
    for (std::size_t i = 1; i < lines.size(); ++i) lines[i][k].clear();
  }
  return common.empty() ? "" : fmt::format("all: {}\n", fmt::join(common, ", "));
}

std::string in_columns(std::vector<Line> lines) {
  for (Line& line : lines)
    for (std::string& cell : line) cell = escaped_line(cell);
  std::string text = in_common(lines);
  std::vector<int> widths(lines.front().size());
  for (std::size_t i = 1; i < lines.size(); ++i)
    for (std::size_t k = 0; k < widths.size(); ++k)
      widths[k] = std::max(widths[k], columns_of(lines[i][k]));
  for (const Line& line : lines) {
    std::string row;
    for (std::size_t k = 0; k < widths.size(); ++k) {
      if (widths[k] == 0) continue;  // an empty column
      const int width = std::max(widths[k], columns_of(headings[k])) + 2;
      row += line[k] + std::string(static_cast<std::size_t>(width - columns_of(line[k])), ' ');
    }
    text += row.substr(0, row.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

void list(const std::string& db, bool json) {
  refuse_special_file(db);
  const LogReader reader(db);
  warn_of_fault(fault_of_structure(reader), db);
  std::vector<SessionFacts> sessions;
  for (const SessionRow& row : reader.sessions()) sessions.push_back(facts_of(reader, row));
  if (json) {
    auto all = nlohmann::ordered_json::array();
    for (const SessionFacts& facts : sessions) all.push_back(as_json(facts));
    return fmt::print("{}\n", all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  if (sessions.empty()) return say("{} holds no session yet\n", db);
  std::vector<Line> lines{headings};
  for (const SessionFacts& facts : sessions) lines.push_back(line_of(facts));
  print("{}", in_columns(lines));
  flush_output();
  say("\ndetails of a session: heft show --db {} --session N\n", shell_quoted(db));
  for (const std::string& step : next_steps(sessions, db)) say("{}\n", step);
}
}  // namespace

void add_list(Command& app) {
  struct ListOptions {
    std::string db;
    bool json = false;
  };
  const auto options = std::make_shared<ListOptions>();
  Command command =
      app.add_command("list", "the sessions of a log: participant, protocol, progress",
                      {"heft list --db lab.db", "heft list --db lab.db --json"});
  command.add_log(options->db);
  command.add_flag("--json", options->json, "JSON on stdout instead of a table");
  command.does([options] { list(options->db, options->json); });
}

}  // namespace heft::cli
