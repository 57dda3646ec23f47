#include "analysis/Tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "analysis/Notes.h"
#include "analysis/Table.h"
#include "analysis/TableParts.h"

namespace heft {

namespace {
constexpr std::size_t text_width = 102;

void add_filled(std::vector<Table>& tables, std::vector<Table> more) {
  std::erase_if(more, [](const Table& table) { return table.rows.empty(); });
  std::ranges::move(more, std::back_inserter(tables));
}

// Where there is nothing to show, say so rather than leave it out.
std::string absences(const Summary& summary) {
  std::string text;
  if (summary.sorting[0].n_trials + summary.sorting[1].n_trials == 0)
    text += "Sorting: no completed trials.\n";
  if (summary.jnd.empty()) text += "JND: no staircases that estimate one.\n";
  return text;
}

std::string hypotheses_text(const Summary& summary) {
  std::string text = titled("The paper's hypotheses, and what these data say of them", summary);
  for (const Hypothesis& hypothesis : summary.hypotheses) {
    text +=
        fmt::format("\n  {}: {}\n    {} ({}): {}", hypothesis.name, hypothesis.statement,
                    name_of(hypothesis.verdict),
                    hypothesis.declared ? "declared beforehand" : "exploratory", hypothesis.why);
    for (const std::string& figure : hypothesis.figures) text += fmt::format("\n    {}", figure);
  }
  return text + '\n';
}

std::string counted(std::size_t n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}
}  // namespace

Cell low(const std::optional<Interval>& interval) {
  return number(interval ? std::optional(interval->low) : std::nullopt);
}

Cell high(const std::optional<Interval>& interval) {
  return number(interval ? std::optional(interval->high) : std::nullopt);
}

Cell mass(double mass_g) {
  return {fmt::format("{:g}", mass_g), mass_g};
}

std::string titled(std::string_view title, const Summary& summary) {
  return summary.simulated() ? fmt::format("{} ({})", title, summary.data) : std::string(title);
}

std::vector<Table> tables_of(const Summary& summary) {
  std::vector<Table> tables;
  add_filled(tables, quality_tables(summary));
  add_filled(tables, sorting_tables(summary));
  add_filled(tables, sensitivity_tables(summary));
  add_filled(tables, comparison_tables(summary));
  add_filled(tables, session_tables(summary));
  return tables;
}

std::vector<Table> lists_of(const Summary& summary) {
  std::vector<Table> lists;
  add_filled(lists, {participant_list(summary), published_table(summary), flow_table(summary),
                     threshold_list(summary), tracking_table(summary), session_list(summary),
                     staircase_list(summary), level_list(summary), setup_table(summary),
                     incident_table(summary), dictionary_table(summary)});
  add_filled(lists, point_lists(summary));
  return lists;
}

std::string headline(const Summary& summary) {
  const std::string text = fmt::format(
      "heft {}: {} of {} in {}", HEFT_VERSION, counted(summary.sessions.size(), "session"),
      counted(static_cast<std::size_t>(summary.n_participants), "participant"), summary.database);
  return titled(text, summary);
}

std::string readable(const Summary& summary) {
  std::string text = headline(summary) + '\n';
  if (!summary.sessions.empty())
    for (const std::string& sentence : three_sentences(summary))
      for (const std::string& line : wrapped(sentence, text_width)) text += line + '\n';
  for (const std::string& note : summary.notes)
    for (const std::string& line : wrapped(note, text_width)) text += line + '\n';
  text += absences(summary);
  for (const Table& table : tables_of(summary)) text += '\n' + as_text(table);
  if (!summary.sessions.empty()) text += '\n' + hypotheses_text(summary);
  return text;
}

}  // namespace heft
