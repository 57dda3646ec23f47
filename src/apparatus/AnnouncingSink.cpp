#include "apparatus/AnnouncingSink.h"

#include <utility>

#include "base/Clock.h"
#include "record/schema/EventRow.h"

namespace heft {

namespace {
auto as_duration(double seconds) {
  return std::chrono::duration_cast<std::chrono::system_clock::duration>(
      std::chrono::duration<double>(seconds));
}
}  // namespace

AnnouncingSink::AnnouncingSink(EventSink& log, EventOutlet& outlet, std::int64_t session_id,
                               std::string participant)
    : log_(log), outlet_(outlet), session_id_(session_id), participant_(std::move(participant)) {}

std::string AnnouncingSink::line_of(const Event& event, const Changes& changes) {
  if (!zero_) zero_ = std::chrono::system_clock::now() - as_duration(event.t_s);
  if (changes.trial) {
    attempt_index_ = changes.attempt_index;
    plan_ = changes.trial->plan;
  }
  AnnouncedEvent about{session_id_, participant_, utc_of(*zero_ + as_duration(event.t_s)), {}};
  if (changes.attempt_index > 0 && changes.attempt_index == attempt_index_) about.plan = plan_;
  return event_line(event, about);
}

void AnnouncingSink::announce(const Event& event, const Changes& changes) {
  outlet_.send(line_of(event, changes));
}

// An event that the log can't take yet is kept by it; one that it refuses has never been.
void AnnouncingSink::append(const Event& event, const Changes& changes, Durability durability) {
  waiting_.push_back(line_of(event, changes));
  try {
    log_.append(event, changes, durability);
  } catch (const LogBusy&) {
    throw;
  } catch (...) {
    waiting_.pop_back();
    throw;
  }
  if (durability == Durability::acknowledged) send_waiting();
}

void AnnouncingSink::add_info(const std::string& key, const std::string& value) {
  log_.add_info(key, value);
  send_waiting();
}

void AnnouncingSink::flush() {
  log_.flush();
  send_waiting();
}

void AnnouncingSink::send_waiting() {
  for (const std::string& line : std::exchange(waiting_, {})) outlet_.send(line);
}

}  // namespace heft
