// The experimenter's console on a terminal: a status line without masses or conditions, and single
// keys as commands. Without a terminal it does nothing.
#pragma once

#include <chrono>
#include <deque>
#include <string>

#include "cli/console/Terminal.h"
#include "session/Console.h"

namespace heft::cli {

class TerminalConsole final : public Console {
 public:
  /// @param expected_trials of the session  @param unblind from the start
  /// @param place of the participant in a study, "7 of 24"; empty: none
  TerminalConsole(double expected_trials, bool unblind, std::string place = {});
  ~TerminalConsole() override;
  TerminalConsole(const TerminalConsole&) = delete;
  TerminalConsole& operator=(const TerminalConsole&) = delete;

  std::optional<ConsoleCommand> command() override;
  void show(const ConsoleStatus& status) override;
  bool ask_to_continue(const std::string& question) override;
  void say(const std::string& text) override;

 private:
  enum class Asking {
    nothing,
    whether_to_continue,
    veto_reason,
    answer_reason,
    note,
    end,
    unblind
  };

  void take_keys();
  void take_key(char key);
  void take_answer(char key);
  void take_choice(char key);
  void take_text_key(char key);
  void take_text();
  void sound(const ConsoleStatus& status);
  void ask(Asking what) { asking_ = what; }
  void give(ConsoleCommandKind kind, const std::string& text = {});
  bool asks_for_text() const;
  std::string prompt(int width) const;

  RawTerminal terminal_;
  double expected_trials_;
  std::string place_;
  std::deque<ConsoleCommand> commands_;
  Asking asking_ = Asking::nothing;
  std::string question_, text_;
  bool paused_ = false;
  std::chrono::steady_clock::time_point drawn_{}, sounded_{};
};

/// The status in one line of a terminal: abbreviated if necessary, then truncated.
/// @param place as TerminalConsole has it
std::string status_line(const ConsoleStatus& status, double expected_trials, int width,
                        const std::string& place = {});

/// Truncates a line to a number of columns: keeps its end if `keep_end`, else its beginning.
std::string cut_to(const std::string& text, int width, bool keep_end = false);

}  // namespace heft::cli
