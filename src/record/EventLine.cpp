#include "record/EventLine.h"

#include <nlohmann/json.hpp>

#include "base/Printable.h"
#include "record/EventRow.h"

namespace heft {

namespace {
// At most so many bytes, and no half letter.
std::string begun(const std::string& text, std::size_t most) {
  std::string kept;
  for (const std::string_view letter : letters_of(text)) {
    if (kept.size() + letter.size() > most) break;
    kept += letter;
  }
  return kept;
}
}  // namespace

std::string event_line(const Event& event, const AnnouncedEvent& about) {
  constexpr std::size_t longest_detail = 240, longest_name = 60;  // bytes; escaped at most sixfold
  const EventRow row = row_of(event);
  nlohmann::ordered_json line;
  line["t_s"] = event.t_s;
  line["utc"] = about.utc;
  line["session"] = about.session_id;
  line["participant"] = begun(about.participant, longest_name);
  line["kind"] = name_of(row.kind);
  if (about.plan) {
    line["trial"] = about.plan->trial_number;
    line["attempt"] = about.plan->attempt;
  }
  if (row.slot) line["slot"] = *row.slot;
  if (row.label) line["label"] = name_of(*row.label);
  if (!row.detail.empty() && row.kind != event_kind<SessionConfig>)
    line["detail"] = begun(row.detail, longest_detail);
  return line.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace heft
