// Where lines of text go for other recorders (EEG, motion capture, eye trackers): a UDP port, a
// named pipe or a serial line. It never waits: what can't be handed over at once is dropped and
// counted, and a reader that is not there, or goes away, harms nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace heft {

class EventOutlet {
 public:
  /// @param spec udp:HOST:PORT (udp:[::1]:PORT), fifo:PATH, or serial:DEVICE (115200 baud, 8N1)
  /// @throws Error (usage) for another spec; Error (device_missing) where there is no such host,
  ///   pipe or serial line
  explicit EventOutlet(const std::string& spec);
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

}  // namespace heft
