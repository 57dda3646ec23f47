#include "cli/console/TerminalConsole.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/Clock.h"
#include "base/files/Printable.h"
#include "cli/Help.h"
#include "cli/console/Terminal.h"

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
  if (!key_waits() || ::read(STDIN_FILENO, &key, 1) != 1) return std::nullopt;
  return key;
}

// Discards the rest of a key's sequence after Esc: "[" or "O", parameters, and a letter or "~".
void swallow_sequence() {
  const auto introducer = next_key();
  if (!introducer || (*introducer != '[' && *introducer != 'O')) return;
  for (auto key = next_key(); key && (*key < '@' || *key > '~');) key = next_key();
}

std::string tracking_words(const ConsoleStatus& status, bool brief) {
  std::string words;
  const auto& tracking = status.tracking;
  if (tracking && tracking->frames_per_s > 0)
    words = fmt::format("  {:.1f}{}", tracking->frames_per_s, brief ? "/s" : " pictures/s");
  if (!status.trouble.empty()) return words + "  " + status.trouble;
  if (!tracking) return brief ? "" : "  nothing tracked";
  if (!tracking->quality) return words;
  return words + fmt::format("  {} {:.2f}", tracking->tracked ? "tracked" : "not tracked",
                             *tracking->quality);
}

std::string status_words(const ConsoleStatus& status, double expected_trials, bool brief) {
  std::string line = minutes_text(status.session_s);
  if (status.paused) line += status.paused_itself ? "  PAUSED ITSELF" : "  PAUSED";
  line += fmt::format("  {} trials  {}",
                      of_about(status.n_completed, expected_trials, brief ? "/" : " of about "),
                      status.screen ? name_of(status.screen->screen) : "nothing shown yet");
  line += tracking_words(status, brief);
  line += fmt::format("  {} dropped, {} late", status.n_dropped, status.n_late);
  if (status.plan) {
    line += fmt::format("  [{}", status.plan->condition);
    for (const double mass_g : status.plan->masses_g) line += fmt::format(" {:g} g", mass_g);
    line += "]";
  }
  return line;
}
}  // namespace

std::string cut_to(const std::string& text, int width, bool keep_end) {
  if (columns_of(text) <= width) return text;
  std::vector<std::string_view> letters = letters_of(text);
  if (keep_end) std::ranges::reverse(letters);
  std::vector<std::string_view> kept;
  int used = 1;  // of the mark
  for (const std::string_view letter : letters) {
    used += columns_of(letter);
    if (used > width) break;
    kept.push_back(letter);
  }
  if (keep_end) std::ranges::reverse(kept);
  const std::string words = fmt::format("{}", fmt::join(kept, ""));
  return keep_end ? "<" + words : words + ">";
}

std::string status_line(const ConsoleStatus& status, double expected_trials, int width,
                        const std::string& place) {
  const std::string who = place.empty() ? "" : place + "  ";
  const std::string line = escaped_line(who + status_words(status, expected_trials, false));
  if (columns_of(line) <= width) return line;
  return cut_to(escaped_line(who + status_words(status, expected_trials, true)), width);
}

TerminalConsole::TerminalConsole(double expected_trials, bool unblind, std::string place)
    : expected_trials_(expected_trials), place_(std::move(place)) {
  if (unblind) commands_.push_back({ConsoleCommandKind::unblind, {}});
}

TerminalConsole::~TerminalConsole() {
  if (terminal_.is_there()) draw("\r\033[J");
}

std::optional<ConsoleCommand> TerminalConsole::command() {
  if (terminal_.listens()) take_keys();
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
  if (asking_ == Asking::whether_to_continue) return take_answer(key);
  if (asks_for_text()) return take_text_key(key);
  if (asking_ != Asking::nothing) return take_choice(key);
  switch (key) {
    case 'p':
      return give(paused_ ? ConsoleCommandKind::proceed : ConsoleCommandKind::pause);
    case 'v':
      return ask(Asking::veto_reason);
    case 'x':
      return ask(Asking::answer_reason);
    case 'n':
      return ask(Asking::note);
    case 'r':
      return give(ConsoleCommandKind::check);
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

// Answers a question with yes, no or check; other keys are ignored.
void TerminalConsole::take_answer(char key) {
  if (key != 'y' && key != 'n' && key != 'r') return;
  asking_ = Asking::nothing;
  give(key == 'y'   ? ConsoleCommandKind::proceed
       : key == 'n' ? ConsoleCommandKind::end
                    : ConsoleCommandKind::check);
}

// Confirms what cannot be undone with yes; any other key cancels.
void TerminalConsole::take_choice(char key) {
  const Asking asked = std::exchange(asking_, Asking::nothing);
  if (key != 'y') return;
  give(asked == Asking::end ? ConsoleCommandKind::end : ConsoleCommandKind::unblind);
}

bool TerminalConsole::asks_for_text() const {
  return asking_ == Asking::note || asking_ == Asking::veto_reason ||
         asking_ == Asking::answer_reason;
}

// A digit alone selects its reason immediately.
void TerminalConsole::take_text_key(char key) {
  if (asking_ != Asking::note && text_.empty())
    for (const auto& [code, reason] : veto_reasons)
      if (code == key) {
        text_ = reason;
        return take_text();
      }
  if (key == '\n' || key == '\r') return take_text();
  if (key == escape) {
    text_.clear();
    asking_ = Asking::nothing;
  } else if (key == backspace) {
    // Removes all bytes of a character.
    while (!text_.empty() && (text_.back() & 0xC0) == 0x80) text_.pop_back();
    if (!text_.empty()) text_.pop_back();
  } else if (static_cast<unsigned char>(key) >= ' ') {
    text_ += key;
  }
}

// An empty text counts as none.
void TerminalConsole::take_text() {
  const Asking asked = std::exchange(asking_, Asking::nothing);
  const std::string text = std::exchange(text_, {});
  if (text.find_first_not_of(' ') == std::string::npos) return;
  give(asked == Asking::note          ? ConsoleCommandKind::note
       : asked == Asking::veto_reason ? ConsoleCommandKind::veto
                                      : ConsoleCommandKind::veto_answer,
       text);
}

void TerminalConsole::give(ConsoleCommandKind kind, const std::string& text) {
  commands_.push_back({kind, text});
}

namespace {
// The prompt, the typed text and the keys that end it; a long text shows its end.
std::string text_prompt(const std::string& what, const std::string& typed, const std::string& keys,
                        int width) {
  const std::string before = what + ": ", after = "_  (" + keys + ")";
  const int room = std::max(8, width - columns_of(before) - columns_of(after));
  return before + cut_to(escaped_line(typed), room, true) + after;
}

std::string reason_prompt(const std::string& what, const std::string& typed, int width) {
  if (!typed.empty()) return text_prompt(what, typed, "Enter, or Esc", width);
  std::string text = what + ":";
  for (const auto& [code, reason] : veto_reasons) text += fmt::format(" {} {}", code, reason);
  return text + ", or type why";
}
}  // namespace

std::string TerminalConsole::prompt(int width) const {
  switch (asking_) {
    case Asking::whether_to_continue:
      return question_;
    case Asking::veto_reason:
      return reason_prompt("void", text_, width);
    case Asking::answer_reason:
      return reason_prompt("undo", text_, width);
    case Asking::note:
      return text_prompt("note", text_, "Enter saves it, Esc discards it", width);
    case Asking::end:
      return "leave the session? everything is saved; heft resume continues. y/n";
    case Asking::unblind:
      return "show masses and condition from now on? it is logged. y/n";
    case Asking::nothing:
      break;
  }
  return paused_ ? "p continue  v void  x undo answer  n note  r check  e end"
                 : "p pause  v void  x undo answer  n note  b break  r check  e end  u unblind";
}

// Repeats a sound every few seconds while the session is paused and needs the experimenter.
void TerminalConsole::sound(const ConsoleStatus& status) {
  constexpr auto every = std::chrono::seconds(5);
  const auto now = std::chrono::steady_clock::now();
  if (!status.paused_itself || now - sounded_ < every) return;
  sounded_ = now;
  ring();
}

void TerminalConsole::show(const ConsoleStatus& status) {
  paused_ = status.paused;
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_.is_there() || !terminal_.listens() || now - drawn_ < redraw_every) return;
  drawn_ = now;
  sound(status);
  const int width = RawTerminal::width() - 1;  // keeps the cursor on the line
  draw(fmt::format("\r\033[J{}\n{}\033[A\r", status_line(status, expected_trials_, width, place_),
                   cut_to(prompt(width), width)));
}

bool TerminalConsole::ask_to_continue(const std::string& question) {
  if (!terminal_.is_there()) return false;
  tcflush(STDIN_FILENO, TCIFLUSH);  // discards keys typed before the question
  ring();
  question_ = question;
  ask(Asking::whether_to_continue);
  return true;
}

void TerminalConsole::say(const std::string& text) {
  if (!terminal_.is_there()) return cli::say("{}\n", text);
  constexpr std::size_t column = 2;  // of continued lines
  draw("\r\033[J");
  cli::say("{}", wrapped(text, column, static_cast<std::size_t>(RawTerminal::width()), column));
}

}  // namespace heft::cli
