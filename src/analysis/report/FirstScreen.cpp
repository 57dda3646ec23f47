#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/display/Phrases.h"
#include "analysis/display/Table.h"
#include "analysis/report/Notes.h"
#include "analysis/report/Report.h"
#include "analysis/report/Tables.h"
#include "base/Names.h"
#include "base/files/Printable.h"

namespace heft {

namespace {
constexpr std::size_t screen_width = 80;
constexpr std::size_t min_attention_lines = 5;  // where the results leave no more
constexpr std::size_t max_item_lines = 4;

using Lines = std::vector<std::string>;

// The sentence, if it is not too long.
Lines item_lines(const std::string& sentence) {
  Lines lines = wrapped(escaped_line(sentence), screen_width - 2);
  if (lines.size() > max_item_lines) {
    lines.resize(max_item_lines);
    lines.back() = wrapped(lines.back(), screen_width - 6).front() + " ...";
  }
  return as_item(std::move(lines));
}

// As many sentences as fit, and how many more there are.
Lines list_lines(const std::vector<std::string>& sentences, std::size_t max_lines) {
  Lines lines;
  for (std::size_t i = 0; i < sentences.size(); ++i) {
    const Lines item = item_lines(sentences[i]);
    const bool is_last = i + 1 == sentences.size();
    if (lines.size() + item.size() + (is_last ? 0 : 1) > max_lines) {
      lines.push_back(fmt::format("- {} more: see the tables", sentences.size() - i));
      break;
    }
    lines.insert(lines.end(), item.begin(), item.end());
  }
  return lines;
}

// A command is broken before an option only, so that it can be pasted into a shell.
Lines step_lines(const NextStep& step, std::size_t label_width) {
  Lines lines{fmt::format("  {:<{}} ", step.label + ":", label_width + 1)};
  std::string rest = step.what;
  while (!rest.empty()) {
    const auto option = rest.find(" --");
    const std::string part = rest.substr(0, option);
    rest = option == std::string::npos ? "" : rest.substr(option + 1);
    if (lines.back().size() + part.size() + (rest.empty() ? 0 : 2) > screen_width) {
      lines.back() += "\\";
      lines.push_back("    ");
    }
    lines.back() += part + (rest.empty() ? "" : " ");
  }
  return lines;
}

// @param done what else was done, and the log's integrity
std::string trials_in_words(const Summary& summary, std::string done) {
  const std::string& integrity = summary.integrity.words;
  if (!integrity.empty()) done += (done.empty() ? "" : "; ") + integrity;
  std::map<Task, int, InTaskOrder> by_task;
  int n_completed = 0;
  for (const LossRow& row : summary.quality.losses)
    if (row.n_completed > 0) {
      by_task[row.task] += row.n_completed;
      n_completed += row.n_completed;
    }
  if (n_completed == 0) return "No trial was completed.";
  std::vector<std::string> counts;
  for (const auto& [task, n] : by_task) counts.push_back(fmt::format("{} {}", n, name_of(task)));
  const std::string text =
      fmt::format("{} completed: {}", counted(n_completed, "trial"), fmt::join(counts, ", "));
  return text + (done.empty() ? "" : "; " + done) + '.';
}

// States who answered if the results could be taken for more general than they are.
std::string generality_sentence(const Summary& summary) {
  if (summary.sessions.empty()) return "";
  const bool is_one = summary.n_participants == 1;
  if (summary.data == "human and simulated")
    return "Participants and models are mixed: nothing here is about people alone.";
  if (summary.data == "simulated")
    return is_one ? "One simulated participant: nothing here is about people."
                  : "A model answered: nothing here is about people.";
  return is_one ? "One participant: intervals are over trials and say nothing about others." : "";
}

std::string void_sentence(const Summary& summary) {
  int n_void = 0, n_attempts = 0;
  for (const LossRow& row : summary.quality.losses) {
    n_void += row.n_void;
    n_attempts += row.n_attempts;
  }
  if (n_void == 0) return "";
  std::vector<std::string> reasons;
  for (const StudyEstimate* one : estimates_of(summary.estimates, "void_attempts"))
    reasons.push_back(fmt::format("{} ({:.0f})", one->text_at("reason"), *one->value));
  return fmt::format("{} of {} attempts {} void and presented again: {}.", n_void, n_attempts,
                     n_void == 1 ? "was" : "were", some_of(reasons, 3));
}

std::string tracking_sentence(const Summary& summary) {
  int n_lost = 0, n_attempts = 0;
  double lost_s = 0;
  for (const LossRow& row : summary.quality.losses) {
    n_lost += row.n_lost;
    n_attempts += row.n_attempts;
    lost_s += row.lost_s;
  }
  if (n_lost == 0) return "";
  return fmt::format("Tracking was lost in {} of {} attempts, for {:.1f} s in all.", n_lost,
                     n_attempts, lost_s);
}

std::string anticipatory_sentence(const Summary& summary) {
  int n = 0, n_completed = 0;
  for (const LossRow& row : summary.quality.losses) {
    n += row.n_anticipatory;
    n_completed += row.n_completed;
  }
  if (n == 0) return "";
  return fmt::format("{} of {} responses {} anticipatory (too early, or without contact).", n,
                     n_completed, n == 1 ? "was" : "were");
}

std::string staircase_sentence(const Summary& summary) {
  const auto& results = summary.shared->staircases.results();
  std::map<std::string, int> censored;
  int n_censored = 0;
  for (const StaircaseResult& result : results)
    if (!result.why.empty()) {
      n_censored += 1;
      censored[result.why] += 1;
    }
  double n_unfinished = 0;
  for (const StudyEstimate* one : estimates_of(summary.estimates, "staircases_unfinished"))
    n_unfinished += one->value.value_or(0);
  std::string text;
  if (n_censored > 0) {
    std::vector<std::string> reasons;
    for (const auto& [why, n] : censored) reasons.push_back(fmt::format("{} ({})", why, n));
    text = fmt::format("{} of {} finished staircases {} a censored JND or none: {}.", n_censored,
                       results.size(), n_censored == 1 ? "has" : "have", some_of(reasons, 3));
  }
  if (n_unfinished > 0)
    text += fmt::format("{}{} did not finish.", text.empty() ? "" : " ",
                        counted(std::lround(n_unfinished), "staircase"));
  return text;
}

// One sentence for each reason: "The threshold is not identifiable at 200 g in C2 (complete
// separation)."
std::string threshold_sentence(const Summary& summary) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_reason;
  for (const StudyEstimate* one : estimates_of(summary.estimates, "threshold_75")) {
    if (one->value) continue;
    const std::string why = one->why.substr(0, one->why.find_first_of(":,"));
    auto found = std::ranges::find(by_reason, why, [](const auto& row) { return row.first; });
    if (found == by_reason.end()) found = by_reason.insert(found, {why, {}});
    found->second.push_back(fmt::format("{:g} g in {}", *one->reference_g, one->condition));
  }
  std::vector<std::string> parts;
  for (const auto& [why, places] : by_reason)
    parts.push_back(fmt::format("{} ({})", some_of(places, 3), why));
  if (parts.empty()) return "";
  return fmt::format("The threshold is not identifiable at {}.", some_of(parts, 4));
}

std::string incident_sentence(const Summary& summary) {
  std::map<std::string_view, int> kinds;
  for (const Incident& incident : summary.incidents)
    if (incident.noted.kind != event_kind<Note>) kinds[name_of(incident.noted.kind)] += 1;
  if (kinds.empty()) return "";
  std::vector<std::string> counts;
  for (const auto& [kind, n] : kinds) counts.push_back(fmt::format("{} ({})", kind, n));
  return fmt::format("The log has events to read: {}.", fmt::join(counts, ", "));
}
}  // namespace

std::vector<std::string> attention_sentences(const Summary& summary) {
  std::vector<std::string> sentences{generality_sentence(summary)};
  for (const std::string& note : summary.notes)
    if (note != simulated_note(summary)) sentences.push_back(note);
  for (const auto sentence :
       {void_sentence, tracking_sentence, anticipatory_sentence, incident_sentence})
    sentences.push_back(sentence(summary));
  for (const auto sentence : {threshold_sentence, staircase_sentence, inconclusive_sentence})
    sentences.push_back(sentence(summary));
  std::erase(sentences, "");
  return sentences;
}

std::string first_screen(const Summary& summary, const FirstScreenOptions& options) {
  Lines lines = wrapped(escaped_line(headline(summary)), screen_width);
  if (lines.size() > 2) lines.resize(2);
  if (!summary.sessions.empty())
    for (std::string& line : wrapped(trials_in_words(summary, options.done), screen_width))
      lines.push_back(std::move(line));

  std::vector<std::string> attention = options.attention;
  for (std::string& sentence : attention_sentences(summary))
    attention.push_back(std::move(sentence));

  Lines steps;
  std::size_t label_width = 0;
  for (const NextStep& step : options.next) label_width = std::max(label_width, step.label.size());
  for (const NextStep& step : options.next)
    for (std::string& line : step_lines(step, label_width)) steps.push_back(std::move(line));

  // Attention gets the lines that the results leave, but at least a few.
  const std::vector<std::string> findings = findings_of(summary);
  const std::size_t headings = 2 * (std::size_t{!findings.empty()} +
                                    std::size_t{!attention.empty()} + std::size_t{!steps.empty()});
  const std::size_t taken = lines.size() + steps.size() + headings;
  const std::size_t available = options.max_lines > taken ? options.max_lines - taken : 2;
  const std::size_t wanted = list_lines(findings, available).size();
  const Lines remarks =
      list_lines(attention, std::max(available - std::min(wanted, available),
                                     std::min(min_attention_lines, available / 2)));
  const auto append = [&](const std::string& heading, const Lines& more) {
    if (more.empty()) return;
    lines.push_back("");
    lines.push_back(heading);
    lines.insert(lines.end(), more.begin(), more.end());
  };
  append("Results (95 % intervals in brackets)", list_lines(findings, available - remarks.size()));
  append("Attention", remarks);
  append("Next", steps);
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace heft
