#include "analysis/report/Tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"
#include "analysis/report/Notes.h"
#include "analysis/report/Report.h"
#include "base/Names.h"

namespace heft {

namespace {
constexpr std::size_t text_width = 102;

// A sentence if comparisons have no JND.
std::string absences(const Summary& summary) {
  const bool compared =
      std::ranges::any_of(estimates_of(summary.estimates, "comparisons"),
                          [](const StudyEstimate* one) { return one->n_trials > 0; });
  return compared && !find_estimate(summary.estimates, "jnd")
             ? "JND: no staircases that estimate one.\n"
             : "";
}

std::string attention_text(const Summary& summary) {
  std::string text;
  for (const std::string& sentence : attention_sentences(summary))
    for (const std::string& line : as_item(wrapped(sentence, text_width - 2))) text += line + '\n';
  return text.empty() ? "" : "\nAttention\n" + text;
}

std::string hypotheses_text(const Summary& summary) {
  std::string text = titled("The paper's hypotheses, and what these data say of them", summary);
  for (const Hypothesis& hypothesis : summary.hypotheses) {
    if (!hypothesis.applies()) continue;
    text +=
        fmt::format("\n  {}: {}\n    {} ({}): {}", hypothesis.name, hypothesis.statement,
                    name_of(hypothesis.verdict),
                    hypothesis.declared ? "declared beforehand" : "exploratory", hypothesis.why);
    for (const std::string& figure : hypothesis.figures) text += fmt::format("\n    {}", figure);
  }
  return text + '\n';
}
}  // namespace

std::vector<Table> tables_at(const Summary& summary, const std::vector<TablePlace>& places) {
  std::vector<Table> tables;
  const auto put = [&](TablePlace place, Table table) {
    table.place = place;
    table.title = titled(table.title, summary);
    tables.push_back(std::move(table));
  };
  for (const TablePlace place : places) {
    for (const RecordTable& record : record_tables())
      if (record.place == place) put(place, record.make(summary));
    for (const auto& section : summary.sections)
      for (const EstimateTable& declared : section->tables())
        if (declared.place == place)
          put(place, table_of(declared, declared.participants ? section->of_participants(summary)
                                                              : summary.estimates));
    if (place == TablePlace::run_only) put(place, measures_in(all_estimates(summary)));
    if (place == TablePlace::csv) put(place, list_of(all_estimates(summary)));
  }
  return tables;
}

Estimates all_estimates(const Summary& summary) {
  Estimates all = summary.estimates;
  for (const auto& section : summary.sections)
    std::ranges::move(section->of_participants(summary), std::back_inserter(all));
  return all;
}

std::vector<Table> filled(std::vector<Table> tables) {
  std::erase_if(tables, [](const Table& table) { return table.rows.empty(); });
  return tables;
}

std::string headline(const Summary& summary) {
  const auto n_people = static_cast<int>(summary.participants.size());
  const std::string analyzed =
      summary.n_participants == n_people
          ? ""
          : fmt::format(", {} of them in the figures,", summary.n_participants);
  const std::string text =
      fmt::format("heft {}: {} of {}{} in {}", HEFT_VERSION,
                  counted(static_cast<std::int64_t>(summary.sessions.size()), "session"),
                  counted(n_people, "participant"), analyzed, summary.database);
  return titled(text, summary);
}

std::string readable(const Summary& summary) {
  std::string text = headline(summary) + '\n';
  if (!summary.sessions.empty())
    for (const std::string& sentence : leading_sentences(summary))
      for (const std::string& line : wrapped(sentence, text_width)) text += line + '\n';
  text += absences(summary);
  text += attention_text(summary);
  for (const Table& table :
       filled(tables_at(summary, {TablePlace::first, TablePlace::results, TablePlace::run})))
    text += '\n' + as_text(table);
  if (std::ranges::any_of(summary.hypotheses, &Hypothesis::applies))
    text += '\n' + hypotheses_text(summary);
  return text;
}

}  // namespace heft
