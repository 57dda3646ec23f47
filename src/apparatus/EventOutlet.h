// Events as lines of text for other recorders (EEG, motion capture, eye trackers), sent to a UDP
// port, a named pipe or a serial line. Sending never blocks: a line that cannot be sent immediately
// is dropped and counted.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "experiment/TrialPlan.h"
#include "record/stream/EventSink.h"

namespace heft {

/// Where lines are sent: the argument of --events.
struct EventTarget {
  struct Udp {
    std::string host, port;
  };
  struct NamedPipe {
    std::string path;
  };
  struct SerialLine {
    std::string device;  ///< 115200 baud, 8N1
  };

  std::string text;  ///< the argument itself
  std::variant<Udp, NamedPipe, SerialLine> to;
};

/// udp:HOST:PORT (udp:[::1]:PORT), fifo:PATH, or serial:DEVICE
/// @throws Error (usage) for another text
EventTarget parse_event_target(const std::string& text);

class EventOutlet {
 public:
  /// @throws Error (device_missing) if the host, pipe or serial line is missing; Error (usage) if
  ///   the path is something else
  explicit EventOutlet(const EventTarget& target);
  ~EventOutlet();
  EventOutlet(const EventOutlet&) = delete;

  /// Sends a line and a line end; at most 4096 bytes, which pipes and datagrams do not split.
  void send(const std::string& line);

  std::int64_t n_sent() const { return n_sent_; }
  /// Lines that could not be sent.
  std::int64_t n_dropped() const { return n_dropped_; }

  class Channel;

 private:
  std::unique_ptr<Channel> channel_;
  std::int64_t n_sent_ = 0, n_dropped_ = 0;
};

/// Passes events to a log, and sends each as a line of JSON once it is on disk. Buffered events and
/// resets are also sent immediately, with "logged":false.
class AnnouncingSink final : public EventSink {
 public:
  AnnouncingSink(EventSink& log, EventOutlet& outlet, std::int64_t session_id,
                 std::string participant);

  /// Announces the log's head after the session's last event.
  void announce_head(double t_s, const std::string& head);

  /// Announces an event that is already on disk.
  void announce(const Event& event, const Changes& changes);

  void append(const Event& event, const Changes& changes, Durability durability) override;
  void add_frame(const FrameRow& frame) override { log_.add_frame(frame); }
  void add_info(const std::string& key, const std::string& value) override;
  void flush() override;

 private:
  std::string utc_at(double t_s);
  std::string line_of(const Event& event, const Changes& changes, std::optional<bool> logged = {});
  void send_waiting();

  EventSink& log_;
  EventOutlet& outlet_;
  std::int64_t session_id_;
  std::string participant_;
  /// UTC at session time 0: two events are equally far apart in UTC and in session time.
  std::optional<std::chrono::system_clock::time_point> zero_;
  int attempt_index_ = 0;
  std::optional<TrialPlan> plan_;     ///< of the current attempt
  std::vector<std::string> waiting_;  ///< until their events are on disk
};

}  // namespace heft
