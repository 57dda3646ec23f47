#include "cli/TerminalConsole.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "cli/Terminal.h"

namespace heft::cli {

namespace {
constexpr auto redraw_every = std::chrono::milliseconds(200);
constexpr char escape = 27, backspace = 127;

// Reason codes of a veto, by their key.
constexpr std::array<std::pair<char, std::string_view>, 4> veto_reasons{
    {{'1', "equipment"}, {'2', "disturbance"}, {'3', "participant"}, {'4', "experimenter"}}};

bool key_waits() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return poll(&input, 1, 0) > 0 && (input.revents & POLLIN) != 0;
}

std::optional<char> next_key() {
  char key = 0;
  if (!key_waits() || read(STDIN_FILENO, &key, 1) != 1) return std::nullopt;
  return key;
}

// What terminals send for one key after Esc: "[" or "O", parameters, and a letter or "~".
void swallow_sequence() {
  const auto introducer = next_key();
  if (introducer != '[' && introducer != 'O') return;
  for (auto key = next_key(); key && (*key < '@' || *key > '~');) key = next_key();
}

std::string tracking_words(const ConsoleStatus& status) {
  std::string words;
  const auto& tracking = status.tracking;
  if (tracking && tracking->frames_per_s > 0)
    words = fmt::format("  {:.1f} pictures/s", tracking->frames_per_s);
  if (!status.trouble.empty()) return words + "  " + status.trouble;
  if (!tracking) return "  nothing tracked";
  if (!tracking->quality) return words;
  return words + fmt::format("  {} {:.2f}", tracking->tracked ? "tracked" : "not tracked",
                             *tracking->quality);
}
}  // namespace

std::string status_line(const ConsoleStatus& status, double expected_trials) {
  const auto seconds = static_cast<long>(status.session_s);
  std::string line = fmt::format(
      "{}:{:02}  {} of about {:.0f} trials  {}", seconds / 60, seconds % 60, status.n_completed,
      expected_trials, status.screen ? name_of(status.screen->screen) : "nothing shown yet");
  line += tracking_words(status);
  line += fmt::format("  {} dropped, {} late", status.n_dropped, status.n_late);
  if (status.paused) line += "  PAUSED";
  if (status.plan) {
    line += fmt::format("  [{}", status.plan->condition);
    for (const double mass_g : status.plan->masses_g) line += fmt::format(" {:g} g", mass_g);
    line += "]";
  }
  return line;
}

TerminalConsole::TerminalConsole(double expected_trials, bool unblind)
    : is_terminal_(isatty(STDIN_FILENO) == 1 && isatty(STDERR_FILENO) == 1),
      expected_trials_(expected_trials) {
  if (unblind) commands_.push_back({ConsoleCommandKind::unblind, {}});
  if (!is_terminal_) return;
  tcgetattr(STDIN_FILENO, &before_);
  termios raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // single keys; Ctrl-C stays a signal
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
}

TerminalConsole::~TerminalConsole() {
  if (!is_terminal_) return;
  tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  draw("\r\033[K");
}

std::optional<ConsoleCommand> TerminalConsole::command() {
  if (is_terminal_) take_keys();
  if (commands_.empty()) return std::nullopt;
  ConsoleCommand next = std::move(commands_.front());
  commands_.pop_front();
  return next;
}

void TerminalConsole::take_keys() {
  while (const auto key = next_key()) {
    if (*key == escape && key_waits())
      swallow_sequence();  // an arrow or function key
    else
      take_key(*key);
  }
}

void TerminalConsole::take_key(char key) {
  drawn_ = {};
  if (asking_ == Asking::go_on) return take_answer(key);
  if (asking_ == Asking::note) return take_note_key(key);
  if (asking_ != Asking::nothing) return take_choice(key);
  switch (key) {
    case 'p':
      return give(paused_ ? ConsoleCommandKind::go_on : ConsoleCommandKind::pause);
    case 'v':
      return ask(Asking::veto_reason);
    case 'n':
      return ask(Asking::note);
    case 'b':
      return give(ConsoleCommandKind::rest);
    case 'e':
      return ask(Asking::end);
    case 'u':
      return ask(Asking::unblind);
    default:
      return;
  }
}

// Yes or no; any other key is neither.
void TerminalConsole::take_answer(char key) {
  if (key != 'y' && key != 'n') return;
  asking_ = Asking::nothing;
  give(key == 'y' ? ConsoleCommandKind::go_on : ConsoleCommandKind::end);
}

// A veto's reason, or yes to what can't be undone; any other key takes the question back.
void TerminalConsole::take_choice(char key) {
  const Asking asked = std::exchange(asking_, Asking::nothing);
  if (asked == Asking::veto_reason) return choose_veto(key);
  if (key != 'y') return;
  give(asked == Asking::end ? ConsoleCommandKind::end : ConsoleCommandKind::unblind);
}

void TerminalConsole::choose_veto(char key) {
  for (const auto& [code, reason] : veto_reasons)
    if (code == key) give(ConsoleCommandKind::veto, std::string(reason));
}

void TerminalConsole::take_note_key(char key) {
  if (key == '\n' || key == '\r' || key == escape) {
    if (key != escape && !note_.empty()) give(ConsoleCommandKind::note, note_);
    note_.clear();
    asking_ = Asking::nothing;
  } else if (key == backspace) {
    // A letter of several bytes goes as a whole.
    while (!note_.empty() && (note_.back() & 0xC0) == 0x80) note_.pop_back();
    if (!note_.empty()) note_.pop_back();
  } else if (static_cast<unsigned char>(key) >= ' ') {
    note_ += key;
  }
}

void TerminalConsole::give(ConsoleCommandKind kind, const std::string& text) {
  commands_.push_back({kind, text});
}

std::string TerminalConsole::prompt() const {
  switch (asking_) {
    case Asking::go_on:
      return question_;
    case Asking::veto_reason: {
      std::string text = "void this trial because of:";
      for (const auto& [code, reason] : veto_reasons) text += fmt::format(" {} {}", code, reason);
      return text;
    }
    case Asking::note:
      return "note: " + note_ + "_  (Enter keeps it, Esc drops it)";
    case Asking::end:
      return "leave the session? everything is saved; heft resume goes on. y/n";
    case Asking::unblind:
      return "show masses and condition from now on? it is logged. y/n";
    case Asking::nothing:
      break;
  }
  return paused_ ? "p go on  v veto  n note  e end"
                 : "p pause  v veto  n note  b break  e end  u unblind";
}

void TerminalConsole::show(const ConsoleStatus& status) {
  paused_ = status.paused;
  const auto now = std::chrono::steady_clock::now();
  if (!is_terminal_ || now - drawn_ < redraw_every) return;
  drawn_ = now;
  draw(fmt::format("\r\033[K{}\n\r\033[K{}\033[A\r",
                   escaped_line(status_line(status, expected_trials_)), escaped_line(prompt())));
}

bool TerminalConsole::ask_to_go_on(const std::string& question) {
  if (!is_terminal_) return false;
  tcflush(STDIN_FILENO, TCIFLUSH);  // what was typed before is no answer to this
  question_ = question;
  ask(Asking::go_on);
  return true;
}

void TerminalConsole::say(const std::string& text) {
  if (is_terminal_) draw("\r\033[K");
  cli::say("{}\n", text);
}

}  // namespace heft::cli
