#include "cli/console/Terminal.h"

#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "analysis/report/Report.h"
#include "base/files/TextFile.h"

namespace heft::cli {

namespace {
constexpr std::array stopping_signals{SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void request_stop(int) {
  stop_requested = true;
}
}  // namespace

void replace_file(const std::string& path, const std::string& text) {
  const std::string kept = replace_text_file(path, text);
  if (!kept.empty()) say("the previous {} is kept as {}\n", path, kept);
}

void flush_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw output_error(errno != 0 ? std::strerror(errno) : "an earlier write failed");
}

int columns_of(std::string_view line) {
  constexpr char32_t first_wide = 0x1100;
  int columns = 0;
  for (const std::string_view letter : letters_of(line))
    columns += first_letter(letter).code >= first_wide ? 2 : 1;
  return columns;
}

Error output_error(const std::string& reason) {
  return Error(
      fmt::format("cannot write to the standard output: {}. Its content is incomplete.", reason));
}

void ring() {
  if (isatty(STDERR_FILENO) == 1) draw("\a");
}

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), shown_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (shown_) draw("\r\033[K");
}

std::string of_about(int n_done, double expected, std::string_view between) {
  if (n_done > std::round(expected)) return fmt::format("{}", n_done);
  return fmt::format("{}{}{:.0f}", n_done, between, expected);
}

void ProgressBar::update(double done, const std::string& text) {
  constexpr int width = 30;
  const auto now = std::chrono::steady_clock::now();
  if (!shown_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  const int filled = static_cast<int>(width * std::clamp(done, 0.0, 1.0));
  draw(fmt::format("\r\033[K{} [{:=<{}}{:{}}] {}", label_, "", filled, "", width - filled,
                   escaped_line(text)));
}

StopOnSignal::StopOnSignal() {
  for (std::size_t i = 0; i < stopping_signals.size(); ++i) {
    before_[i] = std::signal(stopping_signals[i], request_stop);
    if (stopping_signals[i] == SIGHUP && before_[i] == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  }
}

StopOnSignal::~StopOnSignal() {
  for (std::size_t i = 0; i < stopping_signals.size(); ++i)
    std::signal(stopping_signals[i], before_[i]);
}

const std::atomic<bool>& StopOnSignal::requested() const {
  return stop_requested;
}

void explain_missing_charts(const ReportResult& report, const std::string& folder) {
  if (report.charts_drawn) return;
  say("No charts: gnuplot is not installed (sudo apt-get install gnuplot-nox). To draw them later "
      "from "
      "the .gp files in {}: gnuplot NAME.gp\n",
      folder);
}

namespace {
// State of the one RawTerminal, for signal handlers; set before these are installed.
termios as_it_was{}, raw{};
std::atomic<bool> is_raw{false};
std::atomic<bool> suspend_requested{false};
struct sigaction stopping_before {
}, continuing_before{};

// A terminal that does not control the program has no background.
bool is_in_foreground() {
  const pid_t group = tcgetpgrp(STDIN_FILENO);
  return group < 0 || group == getpgrp();
}

void set(const termios& settings) {
  tcsetattr(STDIN_FILENO, TCSANOW, &settings);
}

void on_suspend(int) {
  if (suspend_requested.exchange(true)) SuspendOnSignal::stop_now();
}

// Another program may have changed the terminal meanwhile; listens() checks.
void on_continue(int) {
  is_raw = false;
}

void install(int signal, void (*handler)(int), struct sigaction& held) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, &held);
}
}  // namespace

SuspendOnSignal::SuspendOnSignal() {
  suspend_requested = false;
  install(SIGTSTP, on_suspend, stopping_before);
}

SuspendOnSignal::~SuspendOnSignal() {
  sigaction(SIGTSTP, &stopping_before, nullptr);
}

std::atomic<bool>& SuspendOnSignal::requested() const {
  return suspend_requested;
}

// Calls only async-signal-safe functions.
void SuspendOnSignal::stop_now() {
  const int error = errno;
  if (is_raw.exchange(false)) {
    set(as_it_was);
    constexpr std::string_view clear = "\r\033[J";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, clear.data(), clear.size());
  }
  struct sigaction now {};
  sigaction(SIGTSTP, &stopping_before, &now);
  raise(SIGTSTP);
  sigset_t stopping, blocked;
  sigemptyset(&stopping);
  sigaddset(&stopping, SIGTSTP);
  pthread_sigmask(SIG_UNBLOCK, &stopping, &blocked);  // stops here, until continued
  pthread_sigmask(SIG_SETMASK, &blocked, nullptr);
  sigaction(SIGTSTP, &now, nullptr);
  errno = error;
}

RawTerminal::RawTerminal() : is_there_(isatty(STDIN_FILENO) == 1 && isatty(STDERR_FILENO) == 1) {
  if (!is_there_) return;
  tcgetattr(STDIN_FILENO, &as_it_was);
  raw = as_it_was;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // single keys; Ctrl-C remains a signal
  install(SIGCONT, on_continue, continuing_before);
  listens();
}

RawTerminal::~RawTerminal() {
  if (!is_there_) return;
  sigaction(SIGCONT, &continuing_before, nullptr);
  if (is_raw.exchange(false)) set(as_it_was);
}

bool RawTerminal::listens() {
  if (!is_there_ || !is_in_foreground()) return false;
  if (!is_raw.exchange(true)) set(raw);
  return true;
}

int RawTerminal::width() {
  constexpr int usual = 80;
  return terminal_width(STDERR_FILENO).value_or(usual);
}

std::optional<int> terminal_width(int file_descriptor) {
  winsize size{};
  if (ioctl(file_descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
  return size.ws_col;
}

}  // namespace heft::cli
