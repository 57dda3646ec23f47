#include "cli/console/RawTerminal.h"

#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <string_view>

namespace heft::cli {

namespace {
// State of the one RawTerminal, for signal handlers; set before these are installed.
termios as_it_was{}, raw{};
std::atomic<bool> is_raw{false};
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

// Calls only async-signal-safe functions.
void on_stop(int) {
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

RawTerminal::RawTerminal() : is_there_(isatty(STDIN_FILENO) == 1 && isatty(STDERR_FILENO) == 1) {
  if (!is_there_) return;
  tcgetattr(STDIN_FILENO, &as_it_was);
  raw = as_it_was;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // single keys; Ctrl-C remains a signal
  install(SIGTSTP, on_stop, stopping_before);
  install(SIGCONT, on_continue, continuing_before);
  listens();
}

RawTerminal::~RawTerminal() {
  if (!is_there_) return;
  sigaction(SIGTSTP, &stopping_before, nullptr);
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
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual;
  return size.ws_col;
}

}  // namespace heft::cli
