#include "record/WriteFailure.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include "record/LogFile.h"
#include "record/SqliteError.h"

namespace heft {

namespace {
std::string action_text(const Action& action) {
  std::string text(name_of(action.kind));
  if (action.slot) text += fmt::format(" cube {}", *action.slot);
  if (action.label) text += fmt::format(" {}", name_of(*action.label));
  return text;
}
}  // namespace

std::string description(const Event& event, std::optional<int> trial_number) {
  const auto* action = event.as<Action>();
  const std::string text = action ? fmt::format("the answer \"{}\"", action_text(*action))
                                  : fmt::format("the event \"{}\"", name_of(event.kind()));
  return trial_number ? fmt::format("{} of trial {}", text, *trial_number) : text;
}

Error write_error(const std::string& what, const LogFile& file, const std::exception& reason,
                  const std::string& next) {
  if (const auto* displaced = dynamic_cast<const DisplacedLog*>(&reason))
    return Error(fmt::format("{} is not safe in {}: {}. {}, then {}", what, file.path(),
                             displaced->what(), displaced->remedy(), next));
  SqliteFailure failure{reason.what(), "This is a mistake in heft: please report it"};
  if (const auto* error = dynamic_cast<const SQLite::Exception*>(&reason))
    failure = explained(*error, &file.database());
  return Error(
      fmt::format("could not save {} in {}: {}. Nothing of it is in the file; all that was "
                  "acknowledged before it is. {}, then {}",
                  what, file.path(), failure.reason, failure.advice, next));
}

}  // namespace heft
