// What models that judged a log made of its answers: tables and JSON.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "base/Names.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"

namespace heft::cli {

namespace {
using nlohmann::ordered_json;

constexpr std::size_t name_width = 23;

// Files differ in the end of their names.
std::string short_name(const std::string& name, std::size_t width = name_width) {
  return name.size() <= width ? name : fmt::format("..{}", name.substr(name.size() - width + 2));
}

std::string text_of(const MeanOverPeople& mean, int decimals = 2) {
  if (!mean.interval) return fmt::format("{:.{}f}", mean.value, decimals);
  return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", mean.value, decimals, mean.interval->low,
                     decimals, mean.interval->high, decimals);
}

std::string percent_of(const MeanOverPeople& mean) {
  return fmt::format("{:.1f} %", 100 * mean.value);
}

std::string name_of(const GroupScores& group) {
  std::string text = fmt::format("{} {}", group.task, group.condition);
  if (group.reference_g) text += fmt::format(", {:g} g", *group.reference_g);
  if (group.level_g) text += fmt::format(" {:+g}", *group.level_g);
  return text;
}

// In order of first appearance.
using NamesByReason = std::vector<std::pair<std::string, std::vector<LeftOutTrial>>>;

NamesByReason left_out_by_reason(const Judgments& judgments) {
  NamesByReason reasons;
  for (const LeftOutTrial& trial : judgments.left_out) {
    auto of = std::ranges::find(reasons, trial.why, &NamesByReason::value_type::first);
    if (of == reasons.end()) of = reasons.insert(of, {trial.why, {}});
    of->second.push_back(trial);
  }
  return reasons;
}

// @return how many lines
int print_left_out(const Judgments& judgments) {
  const NamesByReason reasons = left_out_by_reason(judgments);
  for (const auto& [why, trials] : reasons)
    print("left out: {} {}\n", counted(std::ssize(trials), "trial"), short_name(why, 54));
  return static_cast<int>(reasons.size());
}

// "1-3, 7": numbers in ascending order.
std::string ranges_of(const std::vector<int>& numbers) {
  std::vector<std::string> ranges;
  for (std::size_t first = 0; first < numbers.size();) {
    std::size_t last = first;
    while (last + 1 < numbers.size() && numbers[last + 1] <= numbers[last] + 1) ++last;
    ranges.push_back(numbers[first] == numbers[last]
                         ? fmt::format("{}", numbers[first])
                         : fmt::format("{}-{}", numbers[first], numbers[last]));
    first = last + 1;
  }
  return fmt::to_string(fmt::join(ranges, ", "));
}

void print_names_of_left_out(const Judgments& judgments) {
  for (const auto& [why, trials] : left_out_by_reason(judgments)) {
    std::map<std::int64_t, std::vector<int>> by_session;
    for (const LeftOutTrial& trial : trials)
      by_session[trial.session_id].push_back(trial.trial_number);
    print("\nleft out, {}\n", why);
    for (const auto& [session_id, numbers] : by_session)
      print("  session {}: trials {}\n", session_id, ranges_of(numbers));
  }
}

constexpr std::size_t column_width = 16;

void print_models(const JudgedLog& log, const GroupScores& all) {
  const bool several = log.names.size() > 1;
  print("\n{:<{}} {:<21} {:>5} {:>11}  {}\n", "", column_width, "log score a trial", "own",
        "% agreement", several ? "minus " + short_name(log.names[0], 13) : "");
  for (std::size_t i = 0; i < log.names.size(); ++i) {
    const ModelScores& model = all.models[i];
    print(
        "{:<{}} {:<21} {:>5.2f} {:>11}{}\n", short_name(log.names[i], column_width), column_width,
        text_of(model.log_score), model.own_log_score.value,
        fmt::format("{:.1f}/{:.1f}", 100 * model.agreement.value, 100 * model.own_agreement.value),
        i == 0 ? "" : "  " + text_of(model.difference));
  }
  print("{:<{}} {}\n", "shares", column_width, text_of(all.shares));
  print("{:<{}} {:.2f}\n", "chance", column_width, all.chance.value);
}

void print_groups(const JudgedLog& log, const std::vector<GroupScores>& groups, int most_lines) {
  constexpr std::size_t most_models = 3, group_width = 22;
  const int heading = 2;
  const auto n_groups = static_cast<int>(groups.size());
  if (most_lines < heading + 2) return;
  const int n_shown = n_groups + heading <= most_lines ? n_groups : most_lines - heading - 1;
  const std::size_t n = std::min(log.names.size(), most_models);
  print("\n{:<{}} {:>5}", "log score by task", group_width, "n");
  for (std::size_t i = 0; i < n; ++i) print(" {:>14}", short_name(log.names[i], 14));
  print(" {:>6}\n", "shares");
  for (const GroupScores& group : std::span(groups).first(static_cast<std::size_t>(n_shown))) {
    print("{:<{}} {:>5}", short_name(name_of(group), group_width), group_width, group.n_trials);
    for (std::size_t i = 0; i < n; ++i) print(" {:>14.2f}", group.models[i].log_score.value);
    print(" {:>6.2f}\n", group.shares.value);
  }
  if (n_shown < n_groups) print("and {} more: --tables\n", n_groups - n_shown);
}

void print_from_frames(const JudgedLog& log, const GroupScores& all) {
  print(
      "\nfrom frames: log score minus that of the answers to the person's other trials;\n"
      "0: the model predicts no trial better than another\n");
  for (std::size_t i = 0; i < log.names.size(); ++i)
    if (const auto& mean = all.models[i].from_frames)
      print("  {:<{}} {}\n", short_name(log.names[i]), name_width, text_of(*mean));
}

void print_differences(const JudgedLog& log, const GroupScores& all) {
  if (log.names.size() > 1) print("\n");
  for (std::size_t i = 1; i < log.names.size(); ++i)
    print("{} - {}: {}, better for {} of {} people\n", log.names[i], log.names[0],
          text_of(all.models[i].difference), all.models[i].n_people_better, all.n_people);
}

std::string text_of(double value, const std::optional<Interval>& interval) {
  return text_of(MeanOverPeople{value, interval});
}

void print_detection(const std::string& whose, const std::optional<DetectionOverPeople>& found) {
  if (!found) return;
  print("  {:<{}} d' {}, criterion {}\n", short_name(whose), name_width,
        text_of(found->d_prime, found->d_prime_interval),
        text_of(found->criterion, found->criterion_interval));
}

void print_confusion(const Confusion& confusion, const std::string& name) {
  if (confusion.empty()) return;
  std::set<std::string> rows, columns;
  for (const auto& [pair, n] : confusion) {
    rows.insert(pair.first);
    columns.insert(pair.second);
  }
  print("  {:<{}}", "logged \\ " + short_name(name, name_width - 9), name_width);
  for (const std::string& column : columns) print(" {:>12}", column);
  print("\n");
  for (const std::string& row : rows) {
    print("  {:<{}}", "  " + row, name_width);
    for (const std::string& column : columns) {
      const auto n = confusion.find({row, column});
      print(" {:>12.1f}", n == confusion.end() ? 0 : n->second);
    }
    print("\n");
  }
}

void print_tables(const JudgedLog& log, const std::vector<GroupScores>& groups) {
  for (const GroupScores& group : groups) {
    print("\n{}: {} of {}\n", name_of(group), counted(group.n_trials, "trial"),
          fmt::format("{} {}", group.n_people, group.n_people == 1 ? "person" : "people"));
    print_detection("the people", group.person);
    for (std::size_t i = 0; i < log.names.size(); ++i) {
      const ModelScores& model = group.models[i];
      print("  {:<{}} log score {}, agreement {}\n", short_name(log.names[i]), name_width,
            text_of(model.log_score), percent_of(model.agreement));
      print_detection("", model.detection);
      print_confusion(model.answers, log.names[i]);
      print_confusion(model.labels, log.names[i]);
    }
  }
  constexpr int least_trials = 10;
  print("\nlevels of {} trials or more (all: --json)\n", least_trials);
  print("{:<30} {:>6} {:>10}", "d' by level", "trials", "people");
  for (const std::string& name : log.names) print(" {:>16}", short_name(name, 16));
  print("\n");
  const auto d_prime = [](const std::optional<DetectionOverPeople>& found) {
    return found ? fmt::format("{:.2f}", found->d_prime) : std::string("-");
  };
  for (const GroupScores& group :
       scores_of(log.judgments.trials, log.names.size(), ScoreGroups::levels)) {
    if (!group.person || group.n_trials < least_trials) continue;
    print("{:<30} {:>6} {:>10}", name_of(group), group.n_trials, d_prime(group.person));
    for (const ModelScores& model : group.models) print(" {:>16}", d_prime(model.detection));
    print("\n");
  }
}

// JSON.

ordered_json object_of(const std::optional<Interval>& interval) {
  if (!interval) return nullptr;
  return ordered_json::array({interval->low, interval->high});
}

ordered_json object_of(const MeanOverPeople& mean) {
  return {{"value", mean.value}, {"interval", object_of(mean.interval)}};
}

ordered_json object_of(const std::optional<DetectionOverPeople>& found) {
  if (!found) return nullptr;
  return {{"d_prime", found->d_prime},
          {"d_prime_interval", object_of(found->d_prime_interval)},
          {"criterion", found->criterion},
          {"criterion_interval", object_of(found->criterion_interval)}};
}

ordered_json object_of(const Confusion& confusion) {
  ordered_json rows = ordered_json::array();
  for (const auto& [pair, n] : confusion)
    rows.push_back({{"logged", pair.first}, {"judged", pair.second}, {"n", n}});
  return rows;
}

ordered_json object_of(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json object_of(const GroupScores& group, const std::vector<std::string>& names) {
  ordered_json models = ordered_json::array();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ModelScores& model = group.models[i];
    models.push_back(
        {{"responder", names[i]},
         {"log_score", object_of(model.log_score)},
         {"own_log_score", object_of(model.own_log_score)},
         {"agreement", object_of(model.agreement)},
         {"own_agreement", object_of(model.own_agreement)},
         {"difference", object_of(model.difference)},
         {"n_people_better", model.n_people_better},
         {"from_frames", model.from_frames ? object_of(*model.from_frames) : ordered_json(nullptr)},
         {"detection", object_of(model.detection)},
         {"answers", object_of(model.answers)},
         {"labels", object_of(model.labels)}});
  }
  return {{"task", group.task},
          {"condition", group.condition},
          {"reference_g", object_of(group.reference_g)},
          {"level_g", object_of(group.level_g)},
          {"n_trials", group.n_trials},
          {"n_people", group.n_people},
          {"chance", group.chance.value},
          {"shares", object_of(group.shares)},
          {"person", object_of(group.person)},
          {"responders", models}};
}

ordered_json object_of(const JudgedTrial& trial, const std::vector<std::string>& names) {
  ordered_json probabilities;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (const auto& [answer, n] : trial.models[i].n_by_answer)
      probabilities[names[i]][answer] = probability_of(trial.models[i], answer, trial.n_answers);
  return {{"participant", trial.person},         {"session", trial.session_id},
          {"trial_number", trial.trial_number},  {"task", trial.task},
          {"condition", trial.condition},        {"reference_g", object_of(trial.reference_g)},
          {"level_g", object_of(trial.level_g)}, {"answer", trial.answer},
          {"probabilities", probabilities}};
}

double times_real_time(const JudgedLog& log) {
  return log.judgments.shown_s / std::max(log.took_s, 1e-9);
}

}  // namespace

void print_judged(const JudgedLog& log, bool tables) {
  const std::vector<JudgedTrial>& trials = log.judgments.trials;
  print("{}: {} judged, {} draws of each answer (--seed {})\n", counted(log.n_sessions, "session"),
        counted(std::ssize(trials), "trial"), log.repeats, log.seed);
  const int n_left_out = print_left_out(log.judgments);
  if (trials.empty()) {
    print("no trial was judged\n");
    if (tables) print_names_of_left_out(log.judgments);
    return;
  }
  const std::size_t n = log.names.size();
  const auto groups = scores_of(trials, n, ScoreGroups::references);
  const GroupScores all = scores_of(trials, n, ScoreGroups::all).front();
  constexpr int screen_lines = 24, other_lines = 10;  // a chart's name follows
  const int room = screen_lines - other_lines - n_left_out - static_cast<int>(n);
  print_models(log, all);
  print_groups(log, groups, tables ? std::numeric_limits<int>::max() : room);
  if (tables) {
    print_from_frames(log, all);
    print_differences(log, all);
    print_tables(log, groups);
    print_names_of_left_out(log.judgments);
  }
  print(
      "\nlog score: mean log of the probability that a model gives to the logged answer;\n"
      "0 is best. own, and agreement after /: had the model answered itself.\n"
      "95 % intervals over people. {:.0f} times real time{}\n",
      times_real_time(log), tables ? "" : "; d', answers: --tables");
}

std::string as_json(const JudgedLog& log) {
  const Judgments& judgments = log.judgments;
  const std::size_t n = log.names.size();
  ordered_json groups = ordered_json::array(), trials = groups, levels = groups;
  for (const GroupScores& group : scores_of(judgments.trials, n, ScoreGroups::references))
    groups.push_back(object_of(group, log.names));
  for (const GroupScores& group : scores_of(judgments.trials, n, ScoreGroups::levels))
    if (group.level_g) levels.push_back(object_of(group, log.names));
  for (const JudgedTrial& trial : judgments.trials) trials.push_back(object_of(trial, log.names));
  ordered_json left_out = ordered_json::array();
  for (const LeftOutTrial& trial : judgments.left_out)
    left_out.push_back(
        {{"session", trial.session_id}, {"trial_number", trial.trial_number}, {"why", trial.why}});
  ordered_json all = nullptr;
  if (!judgments.trials.empty())
    all = object_of(scores_of(judgments.trials, n, ScoreGroups::all).front(), log.names);
  return ordered_json{{"repeats", log.repeats},
                      {"seed", log.seed},
                      {"n_sessions", log.n_sessions},
                      {"left_out", left_out},
                      {"times_real_time", times_real_time(log)},
                      {"all", all},
                      {"groups", groups},
                      {"levels", levels},
                      {"trials", trials}}
             .dump(2, ' ', false, ordered_json::error_handler_t::replace) +
         "\n";
}

}  // namespace heft::cli
