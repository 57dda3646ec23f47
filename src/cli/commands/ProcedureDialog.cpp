#include "cli/commands/ProcedureDialog.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/Error.h"
#include "base/Names.h"

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

std::string trial_event(int trial, const std::string& staircase, double level, bool recommended) {
  return fmt::format(R"({{"event":"trial","trial":{},"staircase":{},"level":{}{}}})", trial,
                     json_text(staircase), level,
                     recommended ? fmt::format(R"(,"recommended":{})", level) : "");
}

std::string json_parameters(const std::vector<ParameterPosterior>& posterior) {
  std::string parameters;
  for (const ParameterPosterior& one : posterior)
    parameters += fmt::format(R"({}{}:{{"mean":{},"sd":{},"mode":{},"low":{},"high":{}}})",
                              parameters.empty() ? "" : ",", json_text(one.name), one.mean, one.sd,
                              one.mode, one.low, one.high);
  return fmt::format("{{{}}}", parameters);
}

std::string posterior_event(int trial, const Procedure& staircase) {
  return fmt::format(R"({{"event":"posterior","staircase":{},"trial":{},"parameters":{}}})",
                     json_text(staircase.name()), trial, json_parameters(staircase.posterior()));
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

// The event with the first estimate; of a Bayesian kind also with all parameters, or the reason
// that there is no estimate, and then none of a parameter either.
std::string finished_event(const Procedure& staircase, StopReason reason) {
  const Estimate estimate = staircase.estimates().front();
  std::string bayesian;
  if (staircase.is_bayesian())
    bayesian = fmt::format(R"("sd":{},"censored":{},"parameters":{},)", json_number(estimate.sd),
                           json_text(name_of(estimate.censored)),
                           estimate.value ? json_parameters(staircase.posterior()) : "null");
  return fmt::format(
      R"({{"event":"finished","staircase":{},"reason":{},"estimate":{},"low":{},"high":{},)"
      R"({}"n_trials":{}}})",
      json_text(staircase.name()), json_text(name_of(reason)), json_number(estimate.value),
      json_number(estimate.low), json_number(estimate.high), bayesian, staircase.n_trials());
}
}  // namespace

ProcedureDialog::ProcedureDialog(InterleavedProcedures procedures, std::ostream& out,
                                 bool with_posterior)
    : run_(std::move(procedures)), out_(out), with_posterior_(with_posterior) {}

void ProcedureDialog::run(std::istream& in) {
  write_trial();
  for (int line_number = 1; !run_.finished(); ++line_number) {
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
  if (answer.is_void)
    run_.void_trial();
  else
    respond(answer);
  write_trial();
}

void ProcedureDialog::respond(const AnswerLine& answer) {
  const int trial = run_.trial();
  const Procedure& staircase = run_.staircase();
  const Update update = run_.respond(answer.response, answer.level);
  if (update.reversal) write(reversal_event(trial, staircase.name(), *update.reversal));
  if (with_posterior_ && staircase.is_bayesian()) write(posterior_event(trial, staircase));
  if (update.finish) write(finished_event(staircase, *update.finish));
}

void ProcedureDialog::write_trial() {
  if (run_.finished()) return write(R"({"event":"done"})");
  const bool recommended = with_posterior_ && run_.staircase().is_bayesian();
  write(trial_event(run_.trial(), run_.staircase().name(), run_.level(), recommended));
}

void ProcedureDialog::write(const std::string& json) {
  out_ << json << '\n' << std::flush;
  if (!out_)
    throw Error(
        fmt::format("cannot write to the standard output, in trial {}: its reader "
                    "has closed it or its disk is full; the session ends here",
                    run_.trial()));
}

namespace {
constexpr std::string_view forms =
    R"({"response":true|false} or {"answer":"comparison"|"reference"|"none"}, with "level":X beside )"
    R"(it or without, or {"void":true})";

class AnswerReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  AnswerLine answer() const;
  const std::string& problem() const { return problem_; }

  bool boolean(bool value) override;
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool null() override { return wrong("null"); }
  bool string(string_t& text) override;
  bool binary(binary_t&) override { return wrong("binary data"); }
  bool start_array(std::size_t) override { return wrong("an array"); }
  bool end_array() override { return true; }
  bool start_object(std::size_t) override;
  bool end_object() override { return true; }
  bool key(string_t& name) override;
  bool parse_error(std::size_t column, const std::string&,
                   const nlohmann::json::exception& error) override;

 private:
  bool number(double value);
  bool refuse(std::string problem);
  bool wrong(std::string_view got);

  bool in_object_ = false;
  std::string key_;
  std::optional<bool> response_, void_;
  std::optional<Choice> choice_;
  std::optional<double> level_;
  std::string problem_;
};

bool AnswerReader::refuse(std::string problem) {
  problem_ = std::move(problem);
  return false;
}

bool AnswerReader::wrong(std::string_view got) {
  if (!in_object_) return refuse(fmt::format("expected an object, got {}", got));
  return refuse(fmt::format("\"{}\" must be {}, got {}", key_,
                            key_ == "level"    ? "a number"
                            : key_ == "void"   ? "true"
                            : key_ == "answer" ? quoted_list(EnumNames<Choice>::names)
                                               : "true or false",
                            got));
}

bool AnswerReader::start_object(std::size_t) {
  if (in_object_) return wrong("an object");
  return in_object_ = true;
}

bool AnswerReader::key(string_t& name) {
  constexpr std::array<std::string_view, 4> keys{"response", "answer", "level", "void"};
  if (std::find(keys.begin(), keys.end(), name) == keys.end()) {
    const auto nearest = nearest_name(name, keys);
    return refuse(fmt::format("unknown key \"{}\"{}", name,
                              nearest ? fmt::format(" (did you mean \"{}\"?)", *nearest) : ""));
  }
  if ((name == "response" && response_) || (name == "answer" && choice_) ||
      (name == "level" && level_) || (name == "void" && void_))
    return refuse(fmt::format("\"{}\" is given twice", name));
  key_ = name;
  return true;
}

bool AnswerReader::boolean(bool value) {
  const std::string_view text = value ? "true" : "false";
  const bool takes = key_ == "response" || (key_ == "void" && value);
  if (!in_object_ || !takes) return wrong(text);
  (key_ == "void" ? void_ : response_) = value;
  return true;
}

bool AnswerReader::string(string_t& text) {
  if (!in_object_ || key_ != "answer") return wrong("a text");
  choice_ = named<Choice>(text);
  return choice_ ? true : wrong(fmt::format("\"{}\"", text));
}

bool AnswerReader::number(double value) {
  if (!in_object_ || key_ != "level") return wrong("a number");
  if (std::abs(value) > largest_level)
    return refuse(fmt::format("the level {} is too large", value));
  level_ = value;
  return true;
}

bool AnswerReader::parse_error(std::size_t column, const std::string&,
                               const nlohmann::json::exception& error) {
  constexpr int number_out_of_range = 406;
  return refuse(error.id == number_out_of_range
                    ? fmt::format("the number at column {} is too large", column)
                    : fmt::format("not valid JSON at column {}", column));
}

AnswerLine AnswerReader::answer() const {
  const int n_given =
      int{response_.has_value()} + int{choice_.has_value()} + int{void_.has_value()};
  if (n_given > 1)
    throw Error("a trial has one of \"response\", \"answer\" and \"void\", not several");
  if (void_ && level_) throw Error("\"level\" goes with an answer, not with \"void\"");
  if (n_given == 0) throw Error("none of \"response\", \"answer\" and \"void\" is given");
  if (choice_) return {false, response_of(*choice_), level_};
  return {void_.has_value(), {response_.value_or(false)}, level_};
}
}  // namespace

AnswerLine parse_answer(const std::string& line) {
  AnswerReader reader;
  try {
    // The JSON library ends a text at a NUL byte and would ignore the rest.
    if (line.find('\0') != std::string::npos) throw Error("there is a NUL byte in the line");
    if (!nlohmann::json::sax_parse(line, &reader)) throw Error(reader.problem());
    return reader.answer();
  } catch (const Error& error) {
    throw Error(fmt::format("{}; expected {}", error.what(), forms));
  }
}

}  // namespace heft::cli
