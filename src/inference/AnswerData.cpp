#include "inference/AnswerData.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Names.h"
#include "base/files/Csv.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"

namespace heft {

namespace {
using Row = std::vector<CsvCell>;

constexpr std::size_t most_mistakes = 50;  // reported together
constexpr double most_trials = 1e9;        // in a row
constexpr std::array<std::string_view, 3> answer_names{"reference", "none", "comparison"};

class AnswerReader {
 public:
  AnswerReader(std::string_view text, const std::string& file, const AnswerFormat& format)
      : csv_(text, file), format_(format) {}

  std::vector<AnswerGroup> read();

 private:
  void read_header();
  void read_row(const Row& row);
  std::optional<double> level(const CsvCell& cell);
  std::optional<std::array<double, 3>> answers(const Row& row);
  std::optional<std::array<double, 3>> counted(const Row& row);
  std::optional<std::array<double, 3>> one_answer(const CsvCell& cell);
  std::optional<double> count(const CsvCell& cell);
  AnswerGroup& group(const Row& row);
  std::optional<std::size_t> column(std::string_view name) const;
  std::optional<std::size_t> asked_for(const std::optional<std::string>& name) const;
  bool has(std::initializer_list<std::string_view> names) const;
  void refuse(const CsvCell& cell, std::string message);

  CsvReader csv_;
  AnswerFormat format_;
  Row header_;
  std::size_t level_ = 0, answer_ = 0, n_positive_ = 0, n_ = 0;
  bool is_counted_ = false;
  std::optional<std::size_t> group_by_, person_;
  std::vector<AnswerGroup> groups_;
  std::map<std::string, std::size_t> group_places_;
  std::vector<Mistake> mistakes_;
};

std::vector<AnswerGroup> AnswerReader::read() {
  read_header();
  std::size_t n_rows = 0;
  for (Row row = csv_.next(); !row.empty() && mistakes_.size() < most_mistakes; row = csv_.next()) {
    read_row(row);
    ++n_rows;
  }
  if (n_rows == 0) refuse(header_.front(), "there are no rows below the header");
  if (!mistakes_.empty()) throw InvalidFile(std::move(mistakes_));
  return std::move(groups_);
}

void AnswerReader::read_header() {
  header_ = csv_.next();
  const bool indecision = format_.model == FitModel::indecision;
  const std::string expected =
      indecision ? "level_g and answer" : "x, n_positive and n, or x and response (a row a trial)";
  if (header_.empty())
    throw InvalidFile({csv_.mistake(
        {"", 1, 1}, fmt::format("the file is empty, expected a header with {}", expected))});
  for (std::size_t i = 0; i < header_.size(); ++i)
    if (column(header_[i].text) != i)
      refuse(header_[i], fmt::format("a second column \"{}\"", printable(header_[i].text)));
  is_counted_ = !indecision && has({"x", "n_positive", "n"});
  const bool is_single = indecision ? has({"level_g", "answer"}) : has({"x", "response"});
  if (is_counted_ == is_single)
    refuse(header_.front(), fmt::format("expected a header with {}{}", expected,
                                        is_single ? ", not with both" : ""));
  if (!mistakes_.empty()) throw InvalidFile(std::move(mistakes_));
  level_ = *column(indecision ? "level_g" : "x");
  n_positive_ = column("n_positive").value_or(0);
  n_ = column("n").value_or(0);
  if (!is_counted_) answer_ = *column(indecision ? "answer" : "response");
  group_by_ = asked_for(format_.group_by);
  person_ = asked_for(format_.person);
  if (!person_) person_ = has({"person"}) ? column("person") : column("participant");
}

std::optional<std::size_t> AnswerReader::asked_for(const std::optional<std::string>& name) const {
  if (!name) return std::nullopt;
  if (const auto found = column(*name)) return found;
  std::vector<std::string_view> names;
  for (const CsvCell& cell : header_) names.push_back(cell.text);
  throw unknown_name("column", *name, names);
}

void AnswerReader::read_row(const Row& row) {
  if (row.size() != header_.size())
    return refuse(row.front(), fmt::format("{} cells, expected {} as in the header", row.size(),
                                           header_.size()));
  const std::optional<double> at = level(row[level_]);
  const std::optional<std::array<double, 3>> n = answers(row);
  if (!at || !n) return;
  AnswerGroup& its = group(row);
  if (*n == std::array<double, 3>{}) return;  // the level was not shown
  const auto add = [&](AnswersByLevel& to) {
    for (std::size_t k = 0; k < n->size(); ++k) to[*at][k] += (*n)[k];
  };
  add(its.answers);
  if (person_) add(its.people[row[*person_].text]);
}

std::optional<double> AnswerReader::level(const CsvCell& cell) {
  const std::optional<double> value = number_in(cell.text);
  if (!value || std::abs(*value) > 1e100)
    refuse(cell, fmt::format("{} is \"{}\", expected a finite number", header_[level_].text,
                             printable(cell.text)));
  else if (format_.takes_logarithm && *value < 0)
    refuse(cell, fmt::format("{} is {}, expected 0 or more for Weibull's function; levels that are "
                             "logarithms have --scale log10 or db",
                             header_[level_].text, *value));
  else
    return value;
  return std::nullopt;
}

std::optional<std::array<double, 3>> AnswerReader::answers(const Row& row) {
  return is_counted_ ? counted(row) : one_answer(row[answer_]);
}

std::optional<std::array<double, 3>> AnswerReader::counted(const Row& row) {
  const std::optional<double> n_positive = count(row[n_positive_]), n = count(row[n_]);
  if (!n_positive || !n) return std::nullopt;
  if (*n_positive <= *n) return std::array<double, 3>{*n - *n_positive, *n_positive, 0};
  refuse(row[n_positive_], fmt::format("n_positive is {}, more than n, {}", *n_positive, *n));
  return std::nullopt;
}

std::optional<double> AnswerReader::count(const CsvCell& cell) {
  const std::optional<double> value = number_in(cell.text);
  if (value && *value >= 0 && *value <= most_trials && *value == std::floor(*value)) return value;
  refuse(cell, fmt::format("\"{}\", expected a whole number 0...{:.0f}", printable(cell.text),
                           most_trials));
  return std::nullopt;
}

std::optional<std::array<double, 3>> AnswerReader::one_answer(const CsvCell& cell) {
  std::array<double, 3> n{};
  const std::optional<double> value = number_in(cell.text);
  if (format_.model == FitModel::indecision) {
    const auto name = std::ranges::find(answer_names, cell.text);
    if (name != answer_names.end()) {
      n[static_cast<std::size_t>(name - answer_names.begin())] = 1;
      return n;
    }
    refuse(cell, fmt::format("answer is \"{}\", expected \"comparison\", \"reference\" or \"none\"",
                             printable(cell.text)));
  } else if (value == 0.0 || value == 1.0) {
    n[*value == 1 ? 1 : 0] = 1;
    return n;
  } else {
    refuse(cell, fmt::format("response is \"{}\", expected 0 or 1", printable(cell.text)));
  }
  return std::nullopt;
}

AnswerGroup& AnswerReader::group(const Row& row) {
  const std::string name = group_by_ ? row[*group_by_].text : "";
  const auto [place, is_new] = group_places_.try_emplace(name, groups_.size());
  if (is_new) groups_.push_back({group_by_ ? std::optional(name) : std::nullopt, {}, {}});
  return groups_[place->second];
}

std::optional<std::size_t> AnswerReader::column(std::string_view name) const {
  const auto found = std::ranges::find(header_, name, &CsvCell::text);
  if (found == header_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header_.begin());
}

bool AnswerReader::has(std::initializer_list<std::string_view> names) const {
  return std::ranges::all_of(names, [this](auto name) { return column(name).has_value(); });
}

void AnswerReader::refuse(const CsvCell& cell, std::string message) {
  mistakes_.push_back(csv_.mistake(cell, std::move(message)));
}
}  // namespace

std::vector<AnswerGroup> parse_answers(std::string_view text, const std::string& file,
                                       const AnswerFormat& format) {
  return AnswerReader(text, file, format).read();
}

namespace {
template <typename Enum>
Enum named_or_refuse(std::string_view option, std::string_view name) {
  if (const auto value = named<Enum>(name)) return *value;
  throw unknown_name(option, name, EnumNames<Enum>::names);
}

// The fixed rate, 0 if it is not given; none: it is free.
std::optional<double> share(const std::string& option, const std::optional<std::string>& given) {
  if (!given) return 0;
  if (*given == "free") return std::nullopt;
  const std::optional<double> value = number_in(*given);
  if (!value || *value < 0 || *value >= 1)
    throw Error(fmt::format("{} is \"{}\", expected \"free\" or a number from 0 to below 1", option,
                            printable(*given)),
                ExitCode::usage);
  return value;
}

FitOptions options_of(const FitRequest& request, FitModel model) {
  FitOptions fit;
  fit.guess = share("guess", request.guess);
  fit.lapse = share("lapse", request.lapse);
  if (model == FitModel::indecision && (request.function || request.scale || request.guess))
    throw Error("function, scale and guess belong to the model psychometric", ExitCode::usage);
  if (request.person && (model != FitModel::indecision || request.lapse))
    throw Error("person belongs to the model indecision, with a lapse rate that is fitted",
                ExitCode::usage);
  if (fit.guess.value_or(0) + fit.lapse.value_or(0) >= 1)
    throw Error("guess and lapse add up to 1 or more, expected less than 1", ExitCode::usage);
  if (request.function)
    fit.function.shape = named_or_refuse<PsychometricShape>("function", *request.function);
  if (request.scale) fit.function.scale = named_or_refuse<LevelScale>("scale", *request.scale);
  return fit;
}

NamedFit fit_people(const AnswerGroup& group) {
  const MixedFit mixed = fit_mixed_indecision(group.people);
  NamedFit named{group.name, mixed.summary(), {}};
  named.fit.n_levels = group.answers.size();
  for (const auto& [person, answers] : group.people)
    named.people[person] = own_threshold(answers, mixed.own(person));
  named.goodness.why = "people differ: heft analyse checks what the mixed model predicts";
  return named;
}

NamedFit fit_one(const AnswerGroup& group, FitModel model, const FitOptions& options) {
  const AnswersByLevel& answers = group.answers;
  if (model == FitModel::indecision) {
    const Fit fit = fit_indecision(answers, options);
    return {group.name, fit, {}, check_indecision(answers, options, fit)};
  }
  const Fit fit = fit_psychometric(answers, options);
  return {group.name, fit, {}, check_psychometric(answers, options, fit)};
}

// Staircases show larger levels to less sensitive people, so pooling overestimates the threshold.
std::string warning_of_pooled(const std::vector<AnswerGroup>& groups, FitModel model) {
  const auto most = std::ranges::max_element(
      groups, {}, [](const AnswerGroup& group) { return group.people.size(); });
  if (most == groups.end() || most->people.size() < 2) return "";
  return fmt::format(
      "{}trials of {} people are pooled into one fit. If staircases chose the levels, the "
      "threshold is overestimated (1.4 to 2.4 times in simulations), because insensitive people "
      "see larger levels. {}",
      most->name ? *most->name + ": " : "", most->people.size(),
      model == FitModel::indecision ? "Name the column of people with the option person."
                                    : "Fit one person at a time with the option by.");
}
}  // namespace

FittedAnswers fit_answers(std::string_view text, const std::string& file,
                          const FitRequest& request) {
  const auto model = named_or_refuse<FitModel>("model", request.model);
  const FitOptions options = options_of(request, model);
  const std::vector<AnswerGroup> groups = parse_answers(
      text, file, {model, request.group_by, options.function.takes_logarithm(), request.person});
  FittedAnswers fitted;
  if (!request.person) fitted.warning = warning_of_pooled(groups, model);
  for (const AnswerGroup& group : groups)
    fitted.fits.push_back(request.person ? fit_people(group) : fit_one(group, model, options));
  return fitted;
}

}  // namespace heft
