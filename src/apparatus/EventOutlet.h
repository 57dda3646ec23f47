// Where lines of text go for other recorders (EEG, motion capture, eye trackers): a UDP port, a
// named pipe or a serial line. It never waits: what can't be handed over at once is dropped and
// counted, and a reader that is not there, or goes away, harms nothing.
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

/// Where lines go, as --events says it.
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

  std::string text;  ///< as it was given
  std::variant<Udp, NamedPipe, SerialLine> to;
};

/// udp:HOST:PORT (udp:[::1]:PORT), fifo:PATH, or serial:DEVICE
/// @throws Error (usage) for another text
EventTarget parse_event_target(const std::string& text);

class EventOutlet {
 public:
  /// @throws Error (device_missing) where there is no such host, pipe or serial line; Error (usage)
  ///   where the path is something else
  explicit EventOutlet(const EventTarget& target);
  ~EventOutlet();
  EventOutlet(const EventOutlet&) = delete;

  /// Hands a line over, with a line end; at most 4096 bytes, which pipes and datagrams take whole.
  void send(const std::string& line);

  std::int64_t n_sent() const { return n_sent_; }
  /// Lines that nobody took.
  std::int64_t n_dropped() const { return n_dropped_; }

  class Way;  ///< that lines take

 private:
  std::unique_ptr<Way> way_;
  std::int64_t n_sent_ = 0, n_dropped_ = 0;
};

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
