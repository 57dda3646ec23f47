// Self-test of --events: from sending a line to its arrival at another end on this machine, by each
// kind of outlet.
#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <stdlib.h>  // NOLINT: posix_openpt
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "apparatus/EventOutlet.h"
#include "apparatus/checks/ApparatusCheck.h"
#include "base/Clock.h"
#include "base/Error.h"

namespace heft {

namespace {
constexpr int n_lines = 200;
constexpr double most_s = 0.005;

// The receiving end, and the target that leads to it.
struct Receiver {
  Receiver() = default;
  Receiver(const Receiver&) = delete;
  ~Receiver() {
    if (end >= 0) close(end);
    if (!file.empty()) unlink(file.c_str());
  }

  int end = -1;
  std::string target;
  std::string file;  ///< to be removed
};

void receive_datagrams(Receiver& receiver) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const place = reinterpret_cast<sockaddr*>(&address);
  receiver.end = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (receiver.end < 0 || bind(receiver.end, place, size) != 0 ||
      getsockname(receiver.end, place, &size) != 0)
    throw Error("no socket");
  receiver.target = fmt::format("udp:127.0.0.1:{}", ntohs(address.sin_port));
}

void receive_pipe(Receiver& receiver) {
  const std::string file =
      std::filesystem::temp_directory_path() / fmt::format("heft-outlet-{}", getpid());
  if (mkfifo(file.c_str(), 0600) != 0) throw Error("no named pipe");
  receiver.file = file;
  receiver.end = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  receiver.target = "fifo:" + file;
}

// A pseudo-terminal: the serial line itself is not measured.
void receive_serial(Receiver& receiver) {
  receiver.end = posix_openpt(O_RDWR | O_NOCTTY);
  if (receiver.end < 0 || grantpt(receiver.end) != 0 || unlockpt(receiver.end) != 0)
    throw Error("no pseudo-terminal");
  receiver.target = fmt::format("serial:{}", ptsname(receiver.end));
}

// @throws Error if a line does not arrive
double delay_of_line(EventOutlet& outlet, int end) {
  constexpr int patience_ms = 200;
  const std::string line(200, 'x');
  const double sent_s = monotonic_s();
  outlet.send(line);
  std::array<char, 4096> bytes{};
  for (ssize_t n = 0; n <= static_cast<ssize_t>(line.size());) {
    pollfd waits{end, POLLIN, 0};
    if (poll(&waits, 1, patience_ms) != 1) throw Error("a line did not arrive");
    n += std::max<ssize_t>(0, read(end, bytes.data(), bytes.size()));
  }
  return monotonic_s() - sent_s;
}

CheckResult delay_verdict(const std::string& kind, void (*open_end)(Receiver&)) try {
  Receiver receiver;
  open_end(receiver);
  EventOutlet outlet(parse_event_target(receiver.target));
  std::vector<double> delays_s;
  for (int i = 0; i < n_lines; ++i) delays_s.push_back(delay_of_line(outlet, receiver.end));
  std::ranges::sort(delays_s);
  const double p99_s = delays_s[n_lines * 99 / 100];
  return {p99_s > most_s ? CheckVerdict::warning : CheckVerdict::ok, kind + " events",
          fmt::format("{:.3f} ms from sending to arrival (99 %; at most {:.0f} ms expected)",
                      1e3 * p99_s, 1e3 * most_s)};
} catch (const Error& error) {
  return {CheckVerdict::warning, kind + " events", fmt::format("not tested: {}", error.what())};
}
}  // namespace

std::vector<CheckResult> outlet_verdicts() {
  return {delay_verdict("udp", receive_datagrams), delay_verdict("fifo", receive_pipe),
          delay_verdict("serial", receive_serial)};
}

}  // namespace heft
