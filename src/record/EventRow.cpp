#include "record/EventRow.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "record/SetupJson.h"

namespace heft {

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const EventRow& row, std::string_view expected) {
  throw Error(fmt::format("event \"{}\" at {} s: expected {}, found \"{}\"", name_of(row.kind),
                          row.t_s, expected, row.detail));
}

// What each kind of event puts into the row's columns.
class ToRow {
 public:
  explicit ToRow(EventRow& to) : row(to) {}

  void operator()(const Action& action) const {
    row.detail = name_of(action.kind);
    row.slot = action.slot;
    row.label = action.label;
  }
  void operator()(const TrialVoided& voided) const { row.detail = voided.reason; }
  void operator()(const SessionPaused& paused) const { row.detail = paused.reason; }
  void operator()(const CubesReset& reset) const {
    row.detail = reset.slot ? "out_of_area" : "button";
    row.slot = reset.slot;
  }
  void operator()(const DemonstrationShown& shown) const { row.detail = shown.block; }
  void operator()(const SessionResumed& resumed) const {
    row.detail = resumed.utc;
    row.value = resumed.away_s;
  }
  void operator()(const SessionEnded& ended) const { row.detail = name_of(ended.how); }
  void operator()(const Setup& setup) const { row.detail = to_json(setup); }
  void operator()(const CubeTouch& contact) const {
    row.detail = contact.ended_after_s ? "ended" : "began";
    row.slot = contact.slot;
    row.value = contact.ended_after_s;
  }
  void operator()(const Consent& consent) const {
    tell({{"agreed", consent.agreed}, {"language", consent.language}, {"sha256", consent.sha256}});
  }
  void operator()(const TextShown& text) const {
    tell({{"page", text.page}, {"language", text.language}, {"sha256", text.sha256}});
  }
  void operator()(const BreakTaken& taken) const {
    row.detail = taken.name;
    row.value = taken.duration_s;
  }
  void operator()(const Note& note) const { row.detail = note.text; }
  void operator()(const Deviation& deviation) const { row.detail = deviation.text; }
  void operator()(const Unblinding& unblinding) const { row.detail = unblinding.who; }
  void operator()(const CameraReport& report) const {
    tell({{"shown", report.n_shown}, {"dropped", report.n_dropped}, {"late", report.n_late}});
  }
  void operator()(const CheckResult& check) const {
    tell({{"name", check.name}, {"verdict", name_of(check.verdict)}, {"finding", check.finding}});
  }
  // Trial started, continued, cubes shown, effector lost and found: there is nothing to tell.
  template <typename Plain>
  void operator()(const Plain&) const {}

 private:
  // Bytes that are no text must not keep an event from being saved.
  void tell(const Json& json) const {
    row.detail = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  EventRow& row;
};

// The JSON object in a row's detail.
class Detail {
 public:
  explicit Detail(const EventRow& row)
      : row_(row), json_(Json::parse(row.detail, nullptr, /*allow_exceptions=*/false)) {
    if (!json_.is_object()) refuse(row_, "a JSON object");
  }

  template <typename Value>
  Value at(const char* key) const try {
    return json_.at(key).get<Value>();
  } catch (const nlohmann::json::exception&) {
    refuse(row_, fmt::format("JSON with \"{}\"", key));
  }

 private:
  const EventRow& row_;
  Json json_;
};

template <typename Enum>
Enum name_in(const EventRow& row, const std::string& text) {
  if (const auto value = named<Enum>(text)) return *value;
  refuse(row, quoted_list(EnumNames<Enum>::names));
}

int slot_of(const EventRow& row) {
  if (!row.slot) refuse(row, "a cube's slot");
  return *row.slot;
}

double value_of(const EventRow& row) {
  if (!row.value || !(*row.value >= 0)) refuse(row, "a duration");
  return *row.value;
}

CubeTouch contact_in(const EventRow& row) {
  CubeTouch contact{slot_of(row), std::nullopt};
  if (row.detail == "ended")
    contact.ended_after_s = value_of(row);
  else if (row.detail != "began")
    refuse(row, "\"began\" or \"ended\"");
  return contact;
}

CubesReset reset_in(const EventRow& row) {
  if (row.detail != (row.slot ? "out_of_area" : "button"))
    refuse(row, "\"button\", or \"out_of_area\" with a cube's slot");
  return {row.slot};
}

CheckResult check_in(const EventRow& row) {
  const Detail detail(row);
  return {name_in<CheckVerdict>(row, detail.at<std::string>("verdict")),
          detail.at<std::string>("name"), detail.at<std::string>("finding")};
}

TextShown text_in(const EventRow& row) {
  const Detail detail(row);
  return {detail.at<std::string>("page"), detail.at<std::string>("language"),
          detail.at<std::string>("sha256")};
}

Consent consent_in(const EventRow& row) {
  const Detail detail(row);
  return {detail.at<bool>("agreed"), detail.at<std::string>("language"),
          detail.at<std::string>("sha256")};
}

CameraReport report_in(const EventRow& row) {
  const Detail detail(row);
  return {detail.at<int>("shown"), detail.at<int>("dropped"), detail.at<int>("late")};
}

Happening happening_in(const EventRow& row) {
  switch (row.kind) {
    case EventKind::trial_started:
      return TrialStarted{};
    case EventKind::action:
      return Action{name_in<ActionKind>(row, row.detail), row.slot, row.label};
    case EventKind::voided:
      return TrialVoided{row.detail};
    case EventKind::paused:
      return SessionPaused{row.detail};
    case EventKind::continued:
      return SessionContinued{};
    case EventKind::cubes_reset:
      return reset_in(row);
    case EventKind::demonstration_shown:
      return DemonstrationShown{row.detail};
    case EventKind::resumed:
      return SessionResumed{row.detail, row.value.value_or(0)};
    case EventKind::ended:
      return SessionEnded{name_in<Ending>(row, row.detail)};
    case EventKind::setup:
      return setup_from_json(row.detail);
    case EventKind::cubes_shown:
      return CubesShown{};
    case EventKind::cube_contact:
      return contact_in(row);
    case EventKind::effector_lost:
      return EffectorLost{};
    case EventKind::effector_found:
      return EffectorFound{};
    case EventKind::consent:
      return consent_in(row);
    case EventKind::text_shown:
      return text_in(row);
    case EventKind::rest:
      return BreakTaken{row.detail, value_of(row)};
    case EventKind::note:
      return Note{row.detail};
    case EventKind::deviation:
      return Deviation{row.detail};
    case EventKind::unblinding:
      return Unblinding{row.detail};
    case EventKind::camera:
      return report_in(row);
    case EventKind::check:
      return check_in(row);
  }
  refuse(row, "an event");
}

}  // namespace

EventRow row_of(const Event& event) {
  EventRow row;
  row.t_s = event.t_s;
  row.kind = event.kind();
  std::visit(ToRow(row), event.what);
  return row;
}

Event event_of(const EventRow& row) {
  return {row.t_s, happening_in(row)};
}

std::string text_of(const Event& event) {
  const EventRow row = row_of(event);
  std::string text = fmt::format("{} \"{}\"", name_of(row.kind), row.detail);
  if (row.slot) text += fmt::format(" cube {}", *row.slot);
  if (row.label) text += fmt::format(" {}", name_of(*row.label));
  text += fmt::format(" at {} s", row.t_s);
  if (row.value) text += fmt::format(", {} s", *row.value);
  return text;
}

}  // namespace heft
