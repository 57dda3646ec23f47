// heft procedure: procedures for programs in any language, by a conversation: trials out and
// answers in, a JSON object a line. The formats are shown by its --help.
#include "psychophysics/Procedure.h"

#include <fmt/format.h>

#include <csignal>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/Error.h"
#include "cli/AnswerLine.h"
#include "cli/Commands.h"
#include "protocol/Files.h"
#include "psychophysics/Interleaving.h"

namespace heft::cli {

namespace {
// Far above any answer; a line without end must not eat the memory.
constexpr std::size_t longest_line = 4096;

std::string json_text(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

struct InputLine {
  std::string text;
  bool too_long = false;
};

// None at the end of the input. Of a line that is too long only the beginning is kept.
std::optional<InputLine> read_line(std::istream& in) {
  constexpr int end = std::char_traits<char>::eof();
  if (in.peek() == end) return std::nullopt;
  InputLine line;
  for (int c = in.get(); c != end && c != '\n'; c = in.get()) {
    if (line.text.size() < longest_line)
      line.text += static_cast<char>(c);
    else
      line.too_long = true;
  }
  return line;
}

bool is_blank(const std::string& text) {
  return text.find_first_not_of(" \t\r") == std::string::npos;
}

std::string error_event(int line_number, std::string_view message) {
  return fmt::format(R"({{"event":"error","line":{},"message":{}}})", line_number,
                     json_text(message));
}

std::string trial_event(int trial, const std::string& staircase, double level) {
  return fmt::format(R"({{"event":"trial","trial":{},"staircase":{},"level":{}}})", trial,
                     json_text(staircase), level);
}

std::string reversal_event(int trial, const std::string& staircase, const Reversal& reversal) {
  return fmt::format(
      R"({{"event":"reversal","staircase":{},"trial":{},"number":{},"level":{},"step_before":{},)"
      R"("step_after":{}}})",
      json_text(staircase), trial, reversal.number, reversal.level, reversal.step_before,
      reversal.step_after);
}

std::string finished_event(const Procedure& staircase, Finish reason) {
  const std::optional<double> estimate = staircase.estimates().front().value;
  return fmt::format(
      R"({{"event":"finished","staircase":{},"reason":{},"estimate":{},"n_trials":{}}})",
      json_text(staircase.name()), json_text(name_of(reason)),
      estimate ? fmt::to_string(*estimate) : "null", staircase.n_trials());
}

class ProcedureDialog {
 public:
  /// @param out every line is flushed
  ProcedureDialog(const InterleavedProcedures& config, std::ostream& out);

  /// Holds the conversation until every staircase is finished or the input ends.
  /// @throws Error when a line can't be written
  void run(std::istream& in);

 private:
  void take(const std::string& line, int line_number);
  void respond(const AnswerLine& answer);
  void next_trial();
  void write(const std::string& json);

  InterleavedProcedures config_;
  std::ostream& out_;
  std::vector<Procedure> staircases_;
  std::optional<std::size_t> current_;   ///< staircase of the open trial; none: all are finished
  std::optional<std::size_t> previous_;  ///< of the last completed trial
  int trial_ = 0;                        ///< number of the open trial
  double level_ = 0;                     ///< that it presents
};

ProcedureDialog::ProcedureDialog(const InterleavedProcedures& config, std::ostream& out)
    : config_(config), out_(out), staircases_(config.staircases.begin(), config.staircases.end()) {}

void ProcedureDialog::run(std::istream& in) {
  next_trial();
  for (int line_number = 1; current_; ++line_number) {
    const std::optional<InputLine> line = read_line(in);
    if (!line) return;
    if (line->too_long)
      write(error_event(line_number, fmt::format("the line is longer than {} bytes; expected one "
                                                 "answer a line, such as {{\"response\":true}}",
                                                 longest_line)));
    else if (!is_blank(line->text))
      take(line->text, line_number);
  }
}

void ProcedureDialog::take(const std::string& line, int line_number) {
  AnswerLine answer;
  try {
    answer = parse_answer(line);
  } catch (const Error& error) {
    write(error_event(line_number, error.what()));
    return;
  }
  if (!answer.is_void) respond(answer);
  next_trial();
}

void ProcedureDialog::respond(const AnswerLine& answer) {
  Procedure& staircase = staircases_[*current_];
  const Update update = staircase.respond(answer.response, answer.level.value_or(level_));
  previous_ = current_;
  if (update.reversal) write(reversal_event(trial_, staircase.name(), *update.reversal));
  if (update.finish) write(finished_event(staircase, *update.finish));
}

void ProcedureDialog::next_trial() {
  ++trial_;
  RandomStream stream(config_.seed, "interleave", static_cast<std::uint64_t>(trial_));
  current_ = next_staircase(staircases_, config_.interleaving, previous_, stream);
  if (!current_) return write(R"({"event":"done"})");
  const Procedure& staircase = staircases_[*current_];
  level_ = staircase.next_level(level_stream(config_.seed, staircase.name()));
  write(trial_event(trial_, staircase.name(), level_));
}

void ProcedureDialog::write(const std::string& json) {
  out_ << json << '\n' << std::flush;
  if (!out_)
    throw Error(
        fmt::format("can't write to the standard output any more, in trial {}: its reader "
                    "has gone or its disk is full; the session ends here",
                    trial_));
}

void converse(const std::string& file) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader that has gone is an error to report, not a kill
  std::ios::sync_with_stdio(false);
  ProcedureDialog(load_procedure(file), std::cout).run(std::cin);
}
}  // namespace

void add_procedure(Command& app) {
  Command command = app.add_command(
      "procedure", "drive psychophysical procedures over JSON lines on stdin and stdout",
      {"heft procedure staircases.toml",
       "",
       "A session (> is written by heft, < is your program's answer, a line a trial):",
       R"(  > {"event":"trial","trial":1,"staircase":"15g","level":175})",
       R"(  < {"response":true}                 perceived, correct: the level goes down)",
       R"(  > {"event":"trial","trial":2,"staircase":"15g","level":125})",
       R"(  < {"void":true}                     the staircase is untouched, a new trial is drawn)",
       R"(  > {"event":"trial","trial":3,"staircase":"15g","level":125})",
       R"(  < {"response":false,"level":124.5}  the level really shown, where it was another)",
       R"(  > {"event":"reversal","staircase":"15g","trial":3,"number":1,"level":124.5,)"
       R"("step_before":50,"step_after":50})",
       R"(  > {"event":"trial","trial":4,"staircase":"15g","level":175})",
       "  ...",
       R"(  > {"event":"finished","staircase":"15g","reason":"reversals","estimate":112.5,)"
       R"("n_trials":19})",
       R"(  > {"event":"done"})",
       "",
       R"(Where two stimuli are compared, {"answer":"comparison"|"reference"|"none"} says which was)",
       "more. Every kind takes it as a response: any choice is true, none is false.",
       R"(Kind "constant" (levels, n_per_level, order) ends by "trials" and estimates null.)",
       R"(Input it can't use is answered by {"event":"error","line":N,"message":...}; the trial)",
       "stays open. It ends, with exit code 0, when all staircases are done or its input ends."});
  const auto file = std::make_shared<std::string>();
  command
      .add_option("FILE", file.get(), "procedure file (TOML): seed, interleave, [[staircase]]...")
      .required();
  command.does([file] { converse(*file); });
}

}  // namespace heft::cli
