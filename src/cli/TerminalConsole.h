// The experimenter's console on a terminal: one line that tells how the session goes and keeps them
// blind, and single keys to act on it. Without a terminal it shows and hears nothing.
#pragma once

#include <termios.h>

#include <chrono>
#include <deque>
#include <string>

#include "session/Console.h"

namespace heft::cli {

class TerminalConsole final : public Console {
 public:
  /// @param expected_trials of the session  @param unblind from the start
  TerminalConsole(double expected_trials, bool unblind);
  ~TerminalConsole() override;
  TerminalConsole(const TerminalConsole&) = delete;
  TerminalConsole& operator=(const TerminalConsole&) = delete;

  std::optional<ConsoleCommand> command() override;
  void show(const ConsoleStatus& status) override;
  bool ask_to_go_on(const std::string& question) override;
  void say(const std::string& text) override;

 private:
  enum class Asking { nothing, go_on, veto_reason, note, end, unblind };

  void take_keys();
  void take_key(char key);
  void take_answer(char key);
  void take_choice(char key);
  void take_note_key(char key);
  void choose_veto(char key);
  void ask(Asking what) { asking_ = what; }
  void give(ConsoleCommandKind kind, const std::string& text = {});
  std::string prompt() const;

  bool is_terminal_;
  termios before_{};
  double expected_trials_;
  std::deque<ConsoleCommand> commands_;
  Asking asking_ = Asking::nothing;
  std::string question_, note_;
  bool paused_ = false;
  std::chrono::steady_clock::time_point drawn_{};
};

/// The status in one line; for the terminal and for tests.
std::string status_line(const ConsoleStatus& status, double expected_trials);

}  // namespace heft::cli
