#include "cli/commands/ProcedureDialog.h"

#include <fmt/format.h>

#include <istream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/Error.h"

namespace heft::cli {

namespace {
// Far above any answer; bounds the memory for an endless line.
constexpr std::size_t longest_line = 4096;

std::string json_text(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

struct InputLine {
  std::string text;
  bool too_long = false;
};

// None at the end of the input. A line that is too long is truncated.
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

std::string json_number(const std::optional<double>& number) {
  return number ? fmt::to_string(*number) : "null";
}

// With the first of its estimates.
std::string finished_event(const Procedure& staircase, StopReason reason) {
  const Estimate estimate = staircase.estimates().front();
  return fmt::format(
      R"({{"event":"finished","staircase":{},"reason":{},"estimate":{},"low":{},"high":{},)"
      R"("n_trials":{}}})",
      json_text(staircase.name()), json_text(name_of(reason)), json_number(estimate.value),
      json_number(estimate.low), json_number(estimate.high), staircase.n_trials());
}
}  // namespace

ProcedureDialog::ProcedureDialog(InterleavedProcedures procedures, std::ostream& out)
    : procedures_(std::move(procedures)), out_(out) {}

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
  Procedure& staircase = procedures_.staircases[*current_];
  const Update update = staircase.respond(answer.response, answer.level.value_or(level_));
  previous_ = current_;
  if (update.reversal) write(reversal_event(trial_, staircase.name(), *update.reversal));
  if (update.finish) write(finished_event(staircase, *update.finish));
}

void ProcedureDialog::next_trial() {
  ++trial_;
  RandomStream stream(procedures_.seed, "interleave", static_cast<std::uint64_t>(trial_));
  current_ = next_staircase(procedures_.staircases, procedures_.interleaving, previous_, stream);
  if (!current_) return write(R"({"event":"done"})");
  const Procedure& staircase = procedures_.staircases[*current_];
  level_ = staircase.next_level(level_stream(procedures_.seed, staircase.name()));
  write(trial_event(trial_, staircase.name(), level_));
}

void ProcedureDialog::write(const std::string& json) {
  out_ << json << '\n' << std::flush;
  if (!out_)
    throw Error(
        fmt::format("cannot write to the standard output, in trial {}: its reader "
                    "has closed it or its disk is full; the session ends here",
                    trial_));
}

}  // namespace heft::cli
