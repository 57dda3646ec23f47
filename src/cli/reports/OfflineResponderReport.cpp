#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/Names.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "inference/Statistics.h"
#include "tasks/Task.h"

namespace heft::cli {

namespace {
using nlohmann::ordered_json;

constexpr double z_95 = 1.959964;  // standard errors in a 95 % interval

double times_real_time(const AnsweredSession& session) {
  return session.judgments.shown_s / std::max(session.took_s, 1e-9);
}

std::string agreement(const Confusion& confusion) {
  const int n = confusion.n(), n_agree = confusion.n_agree();
  const Interval interval = exact_interval(n_agree, n);
  return fmt::format("{} of {} agree, {:.1f} % [{:.1f}, {:.1f}]", n_agree, n, 100.0 * n_agree / n,
                     100 * interval.low, 100 * interval.high);
}

void print_confusion(const Confusion& confusion) {
  std::vector<std::string> columns, rows;
  for (const auto& [pair, n] : confusion.n_by_pair) {
    if (std::ranges::find(rows, pair.first) == rows.end()) rows.push_back(pair.first);
    if (std::ranges::find(columns, pair.second) == columns.end()) columns.push_back(pair.second);
  }
  std::ranges::sort(columns);
  print("    {:<22}", "logged \\ judged");
  for (const std::string& column : columns) print(" {:>12}", column);
  print("\n");
  for (const std::string& row : rows) {
    print("    {:<22}", row);
    for (const std::string& column : columns) {
      const auto n = confusion.n_by_pair.find({row, column});
      print(" {:>12}", n == confusion.n_by_pair.end() ? 0 : n->second);
    }
    print("\n");
  }
}

void print_detection(const char* whose, const std::optional<Detection>& found) {
  if (!found) return;
  print("    {:<10} d' {:6.2f} +- {:.2f}, criterion {:6.2f} +- {:.2f}\n", whose, found->d_prime,
        z_95 * found->d_prime_se, found->criterion, z_95 * found->criterion_se);
}

void print_agreement(const Agreement& group, bool tables) {
  const std::string reference =
      group.reference_g ? fmt::format(", reference {:g} g", *group.reference_g) : "";
  print("  {} {}{}: {}\n", name_of(group.task), group.condition, reference,
        agreement(group.answers));
  if (tables) print_confusion(group.answers);
  if (group.labels.n() > 0) {
    print("    labels of cubes: {}\n", agreement(group.labels));
    if (tables) print_confusion(group.labels);
  }
  print_detection("logged", group.logged);
  print_detection("responder", group.judged);
  if (task_named(group.task).detects && !group.logged)
    print("    no d': it needs trials with and without a difference (catch trials)\n");
}

ordered_json table_of(const Confusion& confusion) {
  ordered_json table = ordered_json::array();
  for (const auto& [pair, n] : confusion.n_by_pair)
    table.push_back({{"logged", pair.first}, {"judged", pair.second}, {"n", n}});
  return table;
}

ordered_json object_of(const Confusion& confusion) {
  if (confusion.n() == 0) return nullptr;
  const Interval interval = exact_interval(confusion.n_agree(), confusion.n());
  return {{"n", confusion.n()},
          {"agree", confusion.n_agree()},
          {"agree_low", interval.low},
          {"agree_high", interval.high},
          {"table", table_of(confusion)}};
}

ordered_json object_of(const std::optional<Detection>& found) {
  if (!found) return nullptr;
  return {{"d_prime", found->d_prime},
          {"d_prime_se", found->d_prime_se},
          {"criterion", found->criterion},
          {"criterion_se", found->criterion_se}};
}

ordered_json object_of(const Agreement& group) {
  ordered_json object{{"task", name_of(group.task)}, {"condition", group.condition}};
  object["reference_g"] = group.reference_g ? ordered_json(*group.reference_g) : nullptr;
  object.update(object_of(group.answers));
  object["labels"] = object_of(group.labels);
  object["logged"] = object_of(group.logged);
  object["judged"] = object_of(group.judged);
  return object;
}

ordered_json object_of(const AnsweredSession& session) {
  const OfflineAnswers& judgments = session.judgments;
  ordered_json groups = ordered_json::array();
  int n_agree = 0;
  for (const Agreement& group : agreements(judgments.trials)) {
    groups.push_back(object_of(group));
    n_agree += group.answers.n_agree();
  }
  return {{"session", session.session_id},
          {"participant", session.participant},
          {"responder", session.responder},
          {"n", judgments.trials.size()},
          {"agree", n_agree},
          {"n_without_frames", judgments.n_without_frames},
          {"n_without_answer", judgments.n_without_answer},
          {"times_real_time", times_real_time(session)},
          {"groups", groups}};
}
}  // namespace

void print_offline_responder(const AnsweredSession& session, bool tables) {
  const OfflineAnswers& judgments = session.judgments;
  print("session {}, participant {}, {} judging the displayed frames:\n", session.session_id,
        session.participant, session.responder);
  for (const Agreement& group : agreements(judgments.trials)) print_agreement(group, tables);
  if (judgments.n_without_frames > 0)
    print("  not judged: {} without frames in the log\n",
          counted(judgments.n_without_frames, "trial"));
  if (judgments.n_without_answer > 0)
    print("  not judged: {} to which {} has no answer\n",
          counted(judgments.n_without_answer, "trial"), session.responder);
  if (judgments.trials.empty()) return print("  no trial was judged\n");
  print(
      "  95 % intervals: exact (Clopper-Pearson) over trials for agreement; for d' and\n"
      "  criterion 1.96 standard errors (Gourevitch & Galanter), from log-linear rates\n"
      "  {} judged, {:.0f} times real time{}\n",
      counted(std::ssize(judgments.trials), "trial"), times_real_time(session),
      tables ? "" : "; which answers differ: --tables");
}

std::string as_json(const std::vector<AnsweredSession>& sessions) {
  ordered_json all = ordered_json::array();
  for (const AnsweredSession& session : sessions) all.push_back(object_of(session));
  return ordered_json{{"sessions", all}}.dump(2, ' ', false,
                                              ordered_json::error_handler_t::replace) +
         "\n";
}

}  // namespace heft::cli
