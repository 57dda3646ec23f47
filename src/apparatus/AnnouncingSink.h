// A log whose events are told to other recorders as soon as they are on disk, and not before.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "apparatus/EventOutlet.h"
#include "experiment/TrialPlan.h"
#include "record/stream/EventSink.h"

namespace heft {

class AnnouncingSink final : public EventSink {
 public:
  AnnouncingSink(EventSink& log, EventOutlet& outlet, std::int64_t session_id,
                 std::string participant);

  /// Tells of an event that is on disk already.
  void announce(const Event& event, const Changes& changes);

  void append(const Event& event, const Changes& changes, Durability durability) override;
  void add_frame(const FrameRow& frame) override { log_.add_frame(frame); }
  void add_info(const std::string& key, const std::string& value) override;
  void flush() override;

 private:
  std::string line_of(const Event& event, const Changes& changes);
  void send_waiting();

  EventSink& log_;
  EventOutlet& outlet_;
  std::int64_t session_id_;
  std::string participant_;
  /// When session time 0 was, so that two events are as far apart in UTC as in session time.
  std::optional<std::chrono::system_clock::time_point> zero_;
  int attempt_index_ = 0;
  std::optional<TrialPlan> plan_;     ///< of that attempt
  std::vector<std::string> waiting_;  ///< for their events to be on disk
};

}  // namespace heft
