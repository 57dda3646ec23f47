// Reads the line as a stream of tokens, so that nested, repeated or unknown parts are refused at
// their place, however long or deep.
#include "cli/commands/AnswerLine.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "base/Names.h"

namespace heft::cli {

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
