#include "analysis/report/Report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/charts/Charts.h"
#include "analysis/charts/Plot.h"
#include "analysis/display/Phrases.h"
#include "analysis/report/Methods.h"
#include "analysis/report/Notes.h"
#include "analysis/report/Tables.h"
#include "base/Error.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"

namespace heft {

namespace {
namespace fs = std::filesystem;
constexpr std::string_view summary_file = "summary.json";
constexpr std::string_view files_key = "files";
constexpr std::string_view unfinished_file = "report_unfinished.txt";

// The summary.json that an earlier analysis left; null where there is none.
nlohmann::json earlier_summary(const fs::path& folder) {
  const fs::path file = folder / summary_file;
  if (!fs::is_regular_file(file)) return nullptr;
  const auto json = nlohmann::json::parse(read_text_file(file), nullptr, false);
  const bool ours = json.is_object() && json.value("made_by", nlohmann::json()) == "heft analyse";
  return ours ? json : nlohmann::json();
}

// Stale charts and tables of an earlier analysis.
void remove_earlier_files(const fs::path& folder) {
  const nlohmann::json earlier = earlier_summary(folder);
  if (!earlier.is_object() || !earlier.contains(files_key)) return;
  for (const auto& name : earlier[files_key])
    if (name.is_string()) fs::remove(folder / fs::path(name.get<std::string>()).filename());
}

class Folder {
 public:
  explicit Folder(fs::path path) : path_(std::move(path)) {}

  void write(const std::string& name, const std::string& text) {
    std::ofstream file(path_ / name, std::ios::binary);
    file << text;
    file.close();
    if (!file)
      throw Error(
          fmt::format("can't write {}: {}. The log is untouched; run it again with "
                      "another --out.",
                      (path_ / name).string(), std::strerror(errno)));
    files_.push_back(name);
  }

  /// @return the drawn SVG; none without gnuplot
  std::optional<std::string> draw(const Chart& chart) {
    write(chart.name + ".gp", fmt::format("# {}\n", escaped_line(chart.title)) + chart.script);
    if (!run_gnuplot(path_.string(), chart.name + ".gp")) return std::nullopt;
    files_.push_back(chart.name + ".svg");
    return read_text_file(path_ / files_.back());
  }

  // Until finish() the folder is marked, so that an interrupted report is not taken for a whole.
  void begin() {
    write(std::string(unfinished_file),
          "heft analyse is writing to this folder or was interrupted; the files are incomplete. If "
          "no analysis is running, delete the folder and analyse again.\n");
    files_.clear();
  }

  void finish() { fs::remove(path_ / unfinished_file); }

  const std::vector<std::string>& files() const { return files_; }

 private:
  fs::path path_;
  std::vector<std::string> files_;
};

// One session at a time: for a thousand sessions the cells would dominate memory.
void write_tracks(Folder& folder, const Summary& summary) {
  std::string csv;
  std::string name;
  for (const SessionTracks& session : summary.all_tracks) {
    const Table table = track_table(session);
    const std::string of_session = as_csv(table, marked(summary.data, summary));
    csv += csv.empty() ? of_session : of_session.substr(of_session.find('\n') + 1);
    name = table.name;
  }
  if (!csv.empty()) folder.write(name + ".csv", csv);
}

void write_tables(Folder& folder, const Summary& summary) {
  write_tracks(folder, summary);
  for (const Table& table : filled(tables_at(summary, all_csv_places)))
    folder.write(table.name + ".csv", as_csv(table, marked(summary.data, summary)));
}

struct DrawnChart {
  Chart chart;
  std::string svg;  ///< the whole file
};

constexpr std::string_view style = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 72rem; margin: 2rem auto;
       padding: 0 1rem; }
table { border-collapse: collapse; font-size: 0.85rem; display: block; overflow-x: auto; }
th, td { padding: 0.2rem 0.6rem; border-bottom: 1px solid #ddd; text-align: left; }
td.n { text-align: right; font-variant-numeric: tabular-nums; }
.note, .made { color: #666; font-size: 0.85rem; }
.unverified { background: #fbdcdc; border: 2px solid #b00020; padding: 0.2rem 0.8rem;
       position: sticky; top: 0; }
.attention { background: #fff3d6; border-left: 4px solid #d79b00; padding: 0.4rem 0.8rem 0.4rem 2rem; }
svg { max-width: 100%; height: auto; }
.first { border: 1px solid #bbb; padding: 0.2rem 1.2rem; font-size: 1.1rem; }
.answer b { font-size: 1.3rem; display: block; }
figure { margin: 1.5rem 0; break-inside: avoid; }
figcaption { font-size: 0.9rem; max-width: 60rem; }
nav ul { columns: 2; font-size: 0.9rem; }
h2, h3 { break-after: avoid; }
@media print { html { font-size: 10px; } body { max-width: none; margin: 0; font-size: 1.1rem; }
  .unverified { position: fixed; top: 0; right: 0; margin: 0; } nav { display: none; }
  table { display: table; } th, td { padding: 0.1rem 0.4rem; }
  td { overflow-wrap: anywhere; } td.n { white-space: nowrap; overflow-wrap: normal; }
  a { color: inherit; text-decoration: none; } }
@page { size: A4; margin: 15mm; }
)";

// An SVG from its element on: what precedes it is not allowed inside HTML.
std::string_view svg_element(std::string_view svg) {
  const auto start = svg.find("<svg");
  return start == std::string_view::npos ? std::string_view() : svg.substr(start);
}

std::string hypotheses_html(const Summary& summary) {
  if (std::ranges::none_of(summary.hypotheses, &Hypothesis::applies)) return "";
  std::string html = "<h2 id=\"hypotheses\">The paper's hypotheses</h2>\n<dl>\n";
  for (const Hypothesis& hypothesis : summary.hypotheses) {
    if (!hypothesis.applies()) continue;
    html += fmt::format(
        "<dt><b>{}</b>: {}</dt>\n<dd><b>{}</b> ({}): {}</dd>\n", hypothesis.name,
        html_escaped(hypothesis.statement), html_escaped(name_of(hypothesis.verdict)),
        hypothesis.declared ? "declared beforehand" : "exploratory", html_escaped(hypothesis.why));
    for (const std::string& figure : hypothesis.figures)
      html += fmt::format("<dd>{}</dd>\n", html_escaped(figure));
  }
  return html + "</dl>\n";
}

// Text for the author's paper.
std::string methods_html(const Methods& methods) {
  if (methods.paragraphs.empty()) return "";
  std::string html = "<h2 id=\"methods\">Methods</h2>\n";
  for (const std::string& paragraph : methods.paragraphs)
    html += fmt::format("<p>{}</p>\n", html_escaped(paragraph));
  html += "<ul class=\"note\">\n";
  for (const std::string& reference : methods.references)
    html += fmt::format("<li>{}</li>\n", html_escaped(reference));
  return html + "</ul>\n";
}

std::string figure_html(const DrawnChart& drawn, int number) {
  const Chart& chart = drawn.chart;
  std::string html =
      fmt::format("<figure id=\"{}\">\n{}\n<figcaption><b>Figure {}.</b> {}", chart.name,
                  svg_element(drawn.svg), number, html_escaped(chart.caption));
  if (chart.least_n > 0 && chart.least_n < chart.n)
    html += fmt::format(" n = {} to {}.", chart.least_n, chart.n);
  else if (chart.n > 0)
    html += fmt::format(" n = {}.", chart.n);
  if (!chart.csv.empty())
    html += fmt::format(" Figures: <a href=\"{0}\">{0}</a>.", html_escaped(chart.csv));
  return html + "</figcaption>\n</figure>\n";
}

std::string table_html(const Table& table) {
  return fmt::format(
      "<section id=\"table_{0}\">\n{1}<p class=\"note\"><a href=\"{0}.csv\">{0}.csv"
      "</a></p>\n</section>\n",
      table.name, as_html(table));
}

// The main result, first: whether masses were discriminated with the paper's technique.
std::string answer_html(const Summary& summary) {
  const auto found = std::ranges::find(summary.hypotheses, "E1-H2", &Hypothesis::name);
  if (found == summary.hypotheses.end() || found->condition.empty()) return "";
  const std::string_view whom = summary.data == "simulated" ? ", for the model that answered" : "";
  const std::string condition = html_escaped(found->condition);
  std::string answer = "These data are inconclusive.";
  if (found->verdict == HypothesisVerdict::supported)
    answer = fmt::format("Yes{}: masses are discriminated in {}.", whom, condition);
  if (found->verdict == HypothesisVerdict::not_supported)
    answer = fmt::format("No{}: masses are hardly or not discriminated in {}.", whom, condition);
  return fmt::format(
      "<p class=\"answer\"><b>Did {0} work? {1}</b> {0} is decoupling, where a heavy cube pushes "
      "the clone back.</p>\n",
      condition, answer);
}

std::string integrity(const Summary& summary) {
  const std::string& words = summary.integrity.words;
  return words.empty() ? "" : "The log: " + words + ".";
}

std::string head_html(const Summary& summary) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<title>Heft report</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<h1>Heft report</h1>\n<p>{}</p>\n<p class=\"{}\">{}</p>\n",
      style, html_escaped(headline(summary)), summary.integrity.is_verified ? "note" : "unverified",
      html_escaped(integrity(summary)));
  const std::string answer = answer_html(summary);
  html += "<div class=\"first\">\n" + answer;
  for (const std::string& sentence : leading_sentences(summary)) {
    const std::string shown = html_escaped(sentence);
    const bool is_answer = shown.size() > 1 && answer.find(shown.substr(1)) != std::string::npos;
    if (!is_answer) html += fmt::format("<p>{}</p>\n", shown);
  }
  html += "</div>\n";
  const std::vector<std::string> attention = attention_sentences(summary);
  if (attention.empty()) return html;
  html += "<h2 id=\"attention\">Attention</h2>\n<ul class=\"attention\">\n";
  for (const std::string& sentence : attention)
    html += fmt::format("<li>{}</li>\n", html_escaped(sentence));
  return html + "</ul>\n";
}

struct ReportSection {
  std::string id, title;
  std::vector<Table> tables;
};

// Data quality, results, and configuration.
struct ReportSections {
  ReportSection first, results, run;
};

ReportSections sections_of(const Summary& summary) {
  return {
      {"first", "Data quality",
       filled(tables_at(summary, {TablePlace::report_first, TablePlace::first}))},
      {"results", "Tables", filled(tables_at(summary, {TablePlace::results, TablePlace::report}))},
      {"run", "Configuration and definitions",
       filled(tables_at(summary, {TablePlace::run, TablePlace::run_only}))}};
}

std::string section_html(const ReportSection& section) {
  std::string html = fmt::format("<h2 id=\"{}\">{}</h2>\n", section.id, section.title);
  for (const Table& table : section.tables) html += table_html(table);
  return html;
}

std::string contents_html(const std::vector<DrawnChart>& charts, const ReportSections& sections,
                          bool with_hypotheses) {
  std::string html = "<nav>\n<h2>Contents</h2>\n<ul>\n";
  const auto link = [&](std::string_view id, std::string_view text) {
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", id, text);
  };
  const auto tables = [&](const ReportSection& section) {
    for (const Table& table : section.tables)
      link("table_" + table.name, html_escaped(table.title));
  };
  if (with_hypotheses) link("hypotheses", "The paper's hypotheses");
  link("methods", "Methods");
  tables(sections.first);
  for (std::size_t i = 0; i < charts.size(); ++i)
    link(charts[i].chart.name,
         fmt::format("Figure {}: {}", i + 1, html_escaped(charts[i].chart.title)));
  tables(sections.results);
  tables(sections.run);
  return html + "</ul>\n</nav>\n";
}

// The report as one HTML page: main results, data quality, figures, tables.
std::string report_page(const Summary& summary, const std::vector<DrawnChart>& charts) {
  const ReportSections sections = sections_of(summary);
  const std::string hypotheses = hypotheses_html(summary);
  std::string html = head_html(summary) + contents_html(charts, sections, !hypotheses.empty());
  html += hypotheses + methods_html(methods_of(summary)) + section_html(sections.first) +
          "<h2>Figures</h2>\n";
  for (std::size_t i = 0; i < charts.size(); ++i)
    html += figure_html(charts[i], static_cast<int>(i) + 1);
  if (charts.empty()) html += "<p class=\"note\">No charts were drawn.</p>\n";
  html += section_html(sections.results) + section_html(sections.run);
  return html + fmt::format("<p class=\"made\">{}</p>\n</body>\n</html>\n",
                            html_escaped(caption_of(summary)));
}
}  // namespace

void refuse_foreign_folder(const std::string& folder) {
  const fs::path path(folder);
  if (!fs::exists(path)) return;
  if (!fs::is_directory(path))
    throw Error(fmt::format("--out {}: it is a file, expected a folder", folder));
  if (fs::exists(path / unfinished_file))
    throw Error(fmt::format(
        "--out {}: the folder holds an unfinished report. Delete it or name a new folder.",
        folder));
  if (fs::is_empty(path) || earlier_summary(path).is_object()) return;
  throw Error(
      fmt::format("--out {}: the folder holds files that heft analyse did not make, and "
                  "nothing is overwritten. Name a new or empty folder.",
                  folder));
}

ReportResult write_report(const Summary& summary, const std::string& folder) {
  refuse_foreign_folder(folder);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("can't make the folder {}: {}", folder, error.message()));
  Folder out(folder);
  out.begin();
  remove_earlier_files(folder);
  ReportResult result;
  write_tables(out, summary);
  std::vector<DrawnChart> drawn;
  for (const Chart& chart : charts_of(summary)) {
    const auto svg = out.draw(chart);
    result.charts_drawn = result.charts_drawn && svg.has_value();
    if (svg) drawn.push_back({chart, *svg});
  }
  out.write("report.html", report_page(summary, drawn));
  auto json = nlohmann::ordered_json::parse(as_json(summary));
  json[std::string(files_key)] = out.files();
  out.write(std::string(summary_file), json.dump(2) + '\n');
  out.finish();
  result.files = out.files();
  return result;
}

}  // namespace heft
