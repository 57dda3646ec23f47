// BIDS, behavioral experiments (bids-specification.readthedocs.io): participants.tsv, and for each
// session and task a table of trials and one of events. Their columns are described once, in
// task-..._beh.json and task-..._events.json at the top (inheritance principle).
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "record/export/ExportFolder.h"
#include "tasks/Task.h"

namespace heft {

namespace {
using nlohmann::ordered_json;

// A session with its tasks and its label among the person's sessions.
struct BidsSession {
  std::size_t log = 0;
  std::string session_id, label;
  std::set<std::string> tasks;
};

struct BidsPerson {
  std::string name, label;
  std::vector<BidsSession> sessions;
};

// ASCII letters and digits, unique also without regard to case.
std::string label_of(const std::string& name, std::set<std::string>& taken) {
  std::string label;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 128)
      label += c;
  if (label.empty()) label = "x";
  const auto lower = [](std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  };
  std::string free = label;
  for (int i = 2; !taken.insert(lower(free)).second; ++i) free = fmt::format("{}x{}", label, i);
  return free;
}

std::string task_label(const std::string& task) {
  std::set<std::string> none_taken;
  return label_of(task, none_taken);
}

std::vector<BidsPerson> people_of(const ExportSource& source) {
  const ExportTable sessions = source.shown(
      {"sessions",
       "",
       "(SELECT DISTINCT session_id, task FROM trial) r JOIN session s ON s.session_id = "
       "r.session_id",
       "s.session_id, r.task",
       {{"session_id", "", "", "", "s.session_id"},
        {"participant", "", "", "", "s.participant", Privacy::person},
        {"task", "", "", "", "r.task"}}});
  std::vector<BidsPerson> people;
  std::map<std::pair<std::size_t, std::string>, std::size_t> places;  // by log and name
  std::set<std::string> taken;
  for (std::size_t log = 0; log < source.n_logs(); ++log)
    source.each_row(sessions, log, "", [&](const ExportCells& cells) {
      const std::string& name = cells[2].text;
      const auto [place, is_new] = places.try_emplace({log, name}, people.size());
      if (is_new) people.push_back({name, label_of(name, taken), {}});
      std::vector<BidsSession>& theirs = people[place->second].sessions;
      if (theirs.empty() || theirs.back().log != log || theirs.back().session_id != cells[1].text)
        theirs.push_back({log, cells[1].text, fmt::format("{:02}", theirs.size() + 1), {}});
      theirs.back().tasks.insert(cells[3].text);
    });
  return people;
}

ordered_json column_json(const ExportColumn& column) {
  ordered_json json{{"Description", column.meaning}};
  if (!column.unit.empty()) json["Units"] = column.unit;
  ordered_json levels = ordered_json::object();
  for (const std::string& level : levels_of(column)) levels[level] = level;
  if (!levels.empty()) json["Levels"] = levels;
  return json;
}

void write_json(ExportFolder& folder, const std::string& name, const ordered_json& json) {
  folder.write_text(name, json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n');
}

ordered_json sidecar_of(const ExportTable& table, ordered_json json, const ExportFolder& folder) {
  for (const ExportColumn& column : table.columns) json[column.name] = column_json(column);
  if (const std::string warning = folder.warning(); !warning.empty())
    json["unverified"] = {{"Description", "1 in every row." + warning}};
  return json;
}

class BidsExport {
 public:
  BidsExport(const ExportSource& source, ExportFolder& folder,
             const std::function<void(double)>& progress)
      : source_(source),
        folder_(folder),
        trials_(source.shown(behavior_table())),
        events_(source.shown(event_table())),
        progress_(source.count(trials_) + source.count(events_), progress) {}

  void write() {
    const std::vector<BidsPerson> people = people_of(source_);
    write_description();
    write_people(people);
    std::set<std::string> tasks;
    for (const BidsPerson& person : people) {
      write_sessions(person);
      for (const BidsSession& session : person.sessions)
        for (const std::string& task : session.tasks) {
          write_task(person, session, task);
          tasks.insert(task);
        }
    }
    for (const std::string& task : tasks) write_sidecars(task);
    write_estimates(people);
  }

 private:
  static ordered_json description(const std::string& name, const std::string& type) {
    return {{"Name", name},
            {"BIDSVersion", "1.8.0"},
            {"DatasetType", type},
            {"Authors", {"unknown"}},
            {"GeneratedBy", {{{"Name", "heft"}, {"Version", HEFT_VERSION}}}}};
  }

  void write_description() {
    write_json(folder_, "dataset_description.json", description("Perceived mass", "raw"));
    folder_.write_text("README", readme_of("BIDS", folder_));
  }

  static ExportColumn participant_id() {
    return {"participant_id", "", "participant's label, as in file names", "", ""};
  }

  // Answers about each person are those of the first session.
  void write_people(const std::vector<BidsPerson>& people) {
    ExportTable answers = source_.table("participants");
    std::erase_if(answers.columns, [](const ExportColumn& column) {
      return !column.name.starts_with("info_") && !column.name.starts_with("parameter_");
    });
    std::vector<ExportColumn> header{
        participant_id(), {"n_sessions", "", "number of sessions of the person", "", ""}};
    header.insert(header.end(), answers.columns.begin(), answers.columns.end());
    RowFile file = folder_.rows("participants.tsv", RowFile::Kind::tsv);
    file.header(header);
    for (const BidsPerson& person : people) {
      ExportCells row{text("sub-" + person.label), text(std::to_string(person.sessions.size()))};
      const BidsSession& first = person.sessions.front();
      if (!answers.columns.empty())
        source_.each_row(answers, first.log, where_session(first), [&](const ExportCells& cells) {
          row.insert(row.end(), cells.begin() + 1, cells.end());
        });
      file.row(row);
    }
    file.close();
    folder_.wrote("participants.tsv", static_cast<std::int64_t>(people.size()));
    ExportTable described{"participants", "", "", "", header};
    write_json(folder_, "participants.json",
               sidecar_of(described, ordered_json::object(), folder_));
  }

  void write_sessions(const BidsPerson& person) {
    ExportTable table = source_.table("participants");
    std::erase_if(table.columns, [](const ExportColumn& column) {
      return column.name == "session_id" || column.name == "participant" ||
             column.name.starts_with("info_") || column.name.starts_with("parameter_");
    });
    ExportTable described{
        "sessions", "", "", "", {{"session_id", "", "session's label, as in file names", "", ""}}};
    for (const ExportColumn& column : source_.columns(table)) described.columns.push_back(column);
    const std::string name = fmt::format("sub-{0}/sub-{0}_sessions", person.label);
    RowFile file = folder_.rows(name + ".tsv", RowFile::Kind::tsv);
    file.header(described.columns);
    for (const BidsSession& session : person.sessions)
      source_.each_row(table, session.log, where_session(session), [&](const ExportCells& cells) {
        ExportCells row{text("ses-" + session.label)};
        row.insert(row.end(), cells.begin(), cells.end());
        file.row(row);
      });
    file.close();
    folder_.wrote(name + ".tsv", static_cast<std::int64_t>(person.sessions.size()));
    write_json(folder_, name + ".json", sidecar_of(described, ordered_json::object(), folder_));
  }

  void write_task(const BidsPerson& person, const BidsSession& session, const std::string& task) {
    const std::string stem = fmt::format("sub-{0}/ses-{1}/beh/sub-{0}_ses-{1}_task-{2}",
                                         person.label, session.label, task_label(task));
    write_rows(trials_, session,
               fmt::format("{} AND r.task = {}", where_session(session), sql_text(task)),
               stem + "_beh.tsv");
    write_rows(events_, session,
               fmt::format("{} AND t.task = {}", where_session(session), sql_text(task)),
               stem + "_events.tsv");
  }

  void write_rows(const ExportTable& table, const BidsSession& session,
                  const std::string& condition, const std::string& name) {
    RowFile file = folder_.rows(name, RowFile::Kind::tsv);
    file.header(table.columns);
    std::int64_t n = 0;
    source_.each_row(table, session.log, condition, [&](const ExportCells& cells) {
      file.row(std::span(cells).subspan(1));
      progress_.row();
      ++n;
    });
    file.close();
    folder_.wrote(name, n);
  }

  void write_sidecars(const std::string& task) {
    const ordered_json about{{"TaskName", task}, {"TaskDescription", task_named(task).about}};
    const std::string stem = "task-" + task_label(task);
    write_json(folder_, stem + "_beh.json", sidecar_of(trials_, about, folder_));
    write_json(folder_, stem + "_events.json",
               sidecar_of(events_, ordered_json::object(), folder_));
  }

  // Estimates are derived from the answers, hence a derivative dataset.
  void write_estimates(const std::vector<BidsPerson>& people) {
    ExportTable table = source_.table("estimates");
    if (source_.count(table) == 0) return;
    std::erase_if(table.columns, [](const ExportColumn& column) {
      return column.name == "session_id" || column.name == "participant";
    });
    ExportTable described{
        "estimates",
        "",
        "",
        "",
        {participant_id(), {"session_id", "", "session's label, as in file names", "", ""}}};
    for (const ExportColumn& column : table.columns) described.columns.push_back(column);
    RowFile file = folder_.rows("derivatives/heft/estimates.tsv", RowFile::Kind::tsv);
    file.header(described.columns);
    std::int64_t n = 0;
    for (const BidsPerson& person : people)
      for (const BidsSession& session : person.sessions)
        source_.each_row(table, session.log, where_session(session), [&](const ExportCells& cells) {
          ExportCells row{text("sub-" + person.label), text("ses-" + session.label)};
          row.insert(row.end(), cells.begin() + 1, cells.end());
          file.row(row);
          ++n;
        });
    file.close();
    folder_.wrote("derivatives/heft/estimates.tsv", n);
    write_json(folder_, "derivatives/heft/estimates.json",
               sidecar_of(described, ordered_json::object(), folder_));
    write_json(folder_, "derivatives/heft/dataset_description.json",
               description("Perceived mass: estimates of staircases", "derivative"));
  }

  static ExportCell text(const std::string& value) { return {ExportCell::Kind::text, value}; }
  static std::string where_session(const BidsSession& session) {
    return " WHERE s.session_id = " + session.session_id;
  }

  const ExportSource& source_;
  ExportFolder& folder_;
  ExportTable trials_, events_;
  ExportProgress progress_;
};
}  // namespace

void export_bids(const ExportSource& source, ExportFolder& folder,
                 const std::function<void(double)>& progress) {
  BidsExport(source, folder, progress).write();
}

}  // namespace heft
