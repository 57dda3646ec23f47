#include "analysis/display/Table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/files/Csv.h"

namespace heft {

namespace {
constexpr std::string_view missing = "-";
constexpr std::size_t note_width = 100;

std::string_view shown(const Cell& cell) {
  return cell.text.empty() ? missing : std::string_view(cell.text);
}

// Characters on the screen: every UTF-8 byte but those that continue one.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::vector<std::size_t> shown_columns(const Table& table) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (!table.columns[i].heading.empty()) places.push_back(i);
  return places;
}

struct TextColumn {
  std::size_t place = 0, width = 0;
  bool words = false;
};

TextColumn text_column(const Table& table, std::size_t place) {
  TextColumn column{place, width_of(table.columns[place].heading), false};
  for (const auto& row : table.rows) {
    column.width = std::max(column.width, width_of(shown(row[place])));
    column.words = column.words || (!row[place].text.empty() && !row[place].value);
  }
  return column;
}

std::string padded(std::string_view text, const TextColumn& column) {
  const std::string space(column.width - width_of(text), ' ');
  return column.words ? fmt::format("{}{}", text, space) : fmt::format("{}{}", space, text);
}
}  // namespace

Cell word(std::string text) {
  return {std::move(text), std::nullopt};
}

Cell number(std::optional<double> value, int decimals) {
  if (!value || !std::isfinite(*value)) return {};
  return {fmt::format("{:.{}f}", *value, decimals), value};
}

Cell count(int value) {
  return {fmt::format("{}", value), value, true};
}

Cell flag(bool value) {
  return {value ? "yes" : "no", std::nullopt, false, true};
}

std::string as_text(const Table& table) {
  std::vector<TextColumn> columns;
  for (std::size_t i : shown_columns(table)) columns.push_back(text_column(table, i));
  const auto line = [&](auto text_at) {
    std::string text;
    for (const TextColumn& column : columns) text += "  " + padded(text_at(column.place), column);
    text.erase(text.find_last_not_of(' ') + 1);
    return text + '\n';
  };
  std::string text = table.title + '\n';
  text += line([&](std::size_t i) -> std::string_view { return table.columns[i].heading; });
  for (const auto& row : table.rows) text += line([&](std::size_t i) { return shown(row[i]); });
  for (const std::string& note_line : wrapped(table.note, note_width))
    text += fmt::format("  {}\n", note_line);
  return text;
}

std::string as_csv(const Table& table, std::string_view data) {
  std::string text = "data";
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (!table.columns[i].name.empty()) places.push_back(i);
  for (std::size_t i : places) text += fmt::format(",{}", csv_cell(table.columns[i].name));
  text += '\n';
  for (const auto& row : table.rows) {
    text += csv_cell(data);
    for (std::size_t i : places)
      text += row[i].value ? fmt::format(",{}", *row[i].value)
                           : fmt::format(",{}", csv_cell(without_formula(row[i].text)));
    text += '\n';
  }
  return text;
}

std::string as_html(const Table& table) {
  const std::vector<std::size_t> columns = shown_columns(table);
  std::string html = fmt::format("<h3>{}</h3>\n<table>\n<tr>", html_escaped(table.title));
  for (std::size_t i : columns)
    html += fmt::format("<th>{}</th>", html_escaped(table.columns[i].heading));
  html += "</tr>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t i : columns)
      html += fmt::format("<td{}>{}</td>", row[i].value ? " class=\"n\"" : "",
                          html_escaped(shown(row[i])));
    html += "</tr>\n";
  }
  html += "</table>\n";
  if (!table.note.empty())
    html += fmt::format("<p class=\"note\">{}</p>\n", html_escaped(table.note));
  return html;
}

std::vector<std::string> as_item(std::vector<std::string> lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i].insert(0, i == 0 ? "- " : "  ");
  return lines;
}

std::string html_escaped(std::string_view text) {
  std::string escaped;
  for (char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
      escaped += "\uFFFD";
    else
      escaped += c;
  }
  return escaped;
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  while (text.size() > width) {
    const auto space = text.rfind(' ', width);
    std::size_t end = space == std::string_view::npos || space == 0 ? width : space;
    while (end > 1 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // in a letter
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(text[end] == ' ' ? end + 1 : end);
  }
  if (!text.empty()) lines.emplace_back(text);
  return lines;
}

}  // namespace heft
