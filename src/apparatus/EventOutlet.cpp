#include "apparatus/EventOutlet.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/Clock.h"
#include "base/Error.h"
#include "base/files/Printable.h"
#include "record/schema/EventRow.h"

namespace heft {

namespace {
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

[[noreturn]] void refuse(const std::string& spec, const std::string& why) {
  throw Error(fmt::format("--events {}: {}, expected udp:HOST:PORT, fifo:PATH or serial:DEVICE",
                          printable(spec), why),
              ExitCode::usage);
}

[[noreturn]] void miss(const std::string& spec, const std::string& why) {
  throw Error(fmt::format("--events {}: {}", printable(spec), why), ExitCode::device_missing);
}
}  // namespace

class EventOutlet::Channel {
 public:
  virtual ~Channel() = default;
  /// @return whether the whole line was sent, or will be before the next one
  virtual bool hand_over(const std::string& line) = 0;
};

namespace {
class Datagrams final : public EventOutlet::Channel {
 public:
  Datagrams(const EventTarget::Udp& target, const std::string& spec) {
    const auto& [host, port] = target;
    addrinfo wanted{}, *found = nullptr;
    wanted.ai_socktype = SOCK_DGRAM;
    wanted.ai_flags = AI_NUMERICSERV;
    if (const int error = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found); error != 0)
      miss(spec, fmt::format("{}: {}", host, gai_strerror(error)));
    for (const addrinfo* one = found; one && !socket_.is_open(); one = one->ai_next) {
      Descriptor socket(::socket(one->ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
      if (socket.is_open() && connect(socket.number(), one->ai_addr, one->ai_addrlen) == 0)
        socket_ = std::move(socket);
    }
    freeaddrinfo(found);
    if (!socket_.is_open()) miss(spec, std::strerror(errno));
  }

  // The first try may only report that an earlier datagram was refused.
  bool hand_over(const std::string& line) override {
    return sends(line) || (errno == ECONNREFUSED && sends(line));
  }

 private:
  bool sends(const std::string& line) {
    return ::send(socket_.number(), line.data(), line.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(line.size());
  }
  Descriptor socket_;
};

// Opens the pipe when it has a reader, and again for each new reader.
class PipeWriter final : public EventOutlet::Channel {
 public:
  PipeWriter(const EventTarget::NamedPipe& target, const std::string& spec) : path_(target.path) {
    struct stat there {};
    if (stat(path_.c_str(), &there) != 0)
      miss(spec,
           fmt::format("there is no such pipe; make it with: mkfifo {}", shell_quoted(path_)));
    if (!S_ISFIFO(there.st_mode)) refuse(spec, fmt::format("{} is not a named pipe", path_));
  }

  bool hand_over(const std::string& line) override {
    if (!pipe_.is_open())
      pipe_ = Descriptor(open(path_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
    if (!pipe_.is_open()) return false;
    if (write(pipe_.number(), line.data(), line.size()) == static_cast<ssize_t>(line.size()))
      return true;
    if (errno == EPIPE) pipe_ = Descriptor();
    return false;
  }

 private:
  std::string path_;
  Descriptor pipe_;
};

// Completes an interrupted line before it sends the next one.
class SerialWriter final : public EventOutlet::Channel {
 public:
  SerialWriter(const EventTarget::SerialLine& target, const std::string& spec)
      : line_(open(target.device.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {
    if (!line_.is_open()) miss(spec, std::strerror(errno));
    termios settings{};
    if (tcgetattr(line_.number(), &settings) != 0)
      refuse(spec, fmt::format("{} is not a serial line", target.device));
    cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL;
    cfsetspeed(&settings, B115200);
    tcsetattr(line_.number(), TCSANOW, &settings);
  }

  bool hand_over(const std::string& line) override {
    write_some();
    if (!rest_.empty()) return false;
    rest_ = line;
    write_some();
    if (rest_.size() < line.size() || rest_.empty()) return true;
    rest_.clear();
    return false;
  }

 private:
  void write_some() {
    const ssize_t n = rest_.empty() ? 0 : write(line_.number(), rest_.data(), rest_.size());
    if (n > 0) rest_.erase(0, static_cast<std::size_t>(n));
  }
  Descriptor line_;
  std::string rest_;
};

EventTarget::Udp udp_target(const std::string& target, const std::string& spec) {
  const auto colon = target.rfind(':');
  if (colon == std::string::npos || colon == 0) refuse(spec, "HOST:PORT is missing");
  std::string host = target.substr(0, colon);
  const std::string port = target.substr(colon + 1);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']')
    host = host.substr(1, host.size() - 2);
  else if (host.find(':') != std::string::npos)
    refuse(spec, "put an address with colons in brackets");
  const bool is_number = !port.empty() && port.size() <= 5 &&
                         port.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number || std::stoi(port) < 1 || std::stoi(port) > 65535)
    refuse(spec, fmt::format("\"{}\" is not a port from 1 to 65535", printable(port)));
  return {host, port};
}

struct Opens {
  std::unique_ptr<EventOutlet::Channel> operator()(const EventTarget::Udp& target) const {
    return std::make_unique<Datagrams>(target, spec);
  }
  std::unique_ptr<EventOutlet::Channel> operator()(const EventTarget::NamedPipe& target) const {
    return std::make_unique<PipeWriter>(target, spec);
  }
  std::unique_ptr<EventOutlet::Channel> operator()(const EventTarget::SerialLine& target) const {
    return std::make_unique<SerialWriter>(target, spec);
  }

  const std::string& spec;
};
}  // namespace

EventTarget parse_event_target(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) refuse(text, "the colon is missing");
  const std::string kind = text.substr(0, colon), target = text.substr(colon + 1);
  if (target.empty()) refuse(text, "nothing follows the colon");
  if (kind == "udp") return {text, udp_target(target, text)};
  if (kind == "fifo") return {text, EventTarget::NamedPipe{target}};
  if (kind == "serial") return {text, EventTarget::SerialLine{target}};
  refuse(text, fmt::format("\"{}\" is not a kind of target", printable(kind)));
}

EventOutlet::EventOutlet(const EventTarget& target)
    : channel_(std::visit(Opens{target.text}, target.to)) {}
EventOutlet::~EventOutlet() = default;

void EventOutlet::send(const std::string& line) {
  constexpr std::size_t longest = 4096;  // a longer line could be split by a pipe (PIPE_BUF)
  const bool is_taken = line.size() < longest && channel_->hand_over(line + '\n');
  ++(is_taken ? n_sent_ : n_dropped_);
}

namespace {
auto as_duration(double seconds) {
  return std::chrono::duration_cast<std::chrono::system_clock::duration>(
      std::chrono::duration<double>(seconds));
}
}  // namespace

AnnouncingSink::AnnouncingSink(EventSink& log, EventOutlet& outlet, std::int64_t session_id,
                               std::string participant)
    : log_(log), outlet_(outlet), session_id_(session_id), participant_(std::move(participant)) {}

std::string AnnouncingSink::utc_at(double t_s) {
  if (!zero_) zero_ = std::chrono::system_clock::now() - as_duration(t_s);
  return utc_of(*zero_ + as_duration(t_s));
}

std::string AnnouncingSink::line_of(const Event& event, const Changes& changes,
                                    std::optional<bool> logged) {
  if (changes.trial) {
    attempt_index_ = changes.attempt_index;
    plan_ = changes.trial->plan;
  }
  AnnouncedEvent about{session_id_, participant_, utc_at(event.t_s), {}, logged};
  if (changes.attempt_index > 0 && changes.attempt_index == attempt_index_) about.plan = plan_;
  return event_line(event, about);
}

void AnnouncingSink::announce_head(double t_s, const std::string& head) {
  outlet_.send(sealed_line({session_id_, participant_, utc_at(t_s), {}}, t_s, head));
}

void AnnouncingSink::announce(const Event& event, const Changes& changes) {
  outlet_.send(line_of(event, changes));
}

// A buffered event, such as a contact, is on disk up to a second later: too late for a trigger. It
// is announced immediately, and again when it is logged; so is a reset, which can be a trigger,
// too. Others are announced once, when they are logged, and never if the log refuses them.
void AnnouncingSink::append(const Event& event, const Changes& changes, Durability durability) {
  const bool at_once = durability == Durability::buffered || event.is<CubesReset>();
  if (at_once) outlet_.send(line_of(event, changes, false));
  waiting_.push_back(line_of(event, changes, at_once ? std::optional(true) : std::nullopt));
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
