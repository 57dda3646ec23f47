// A small table and the ways to write it: aligned text, CSV, HTML.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heft {

struct Cell {
  std::string text;             ///< rounded for reading; empty: the figure does not exist
  std::optional<double> value;  ///< unrounded; none: the cell is a word
  bool is_whole = false;        ///< a count
  bool is_flag = false;         ///< written as true or false in JSON
};

Cell word(std::string text);
/// "" where there is no value.
Cell number(std::optional<double> value, int decimals = 1);
Cell count(int value);
Cell flag(bool value);

struct Column {
  std::string name;     ///< in CSV: snake_case with its unit; empty: not in CSV
  std::string heading;  ///< in text and HTML, with its unit; empty: omitted
  /// In JSON; empty: `name`; "-": omitted. A dot opens an object: "difference.low"; with "?" before
  /// the dot, an object without a figure is null.
  std::string json{};
};

/// Where a table is shown in addition to its CSV file.
enum class TablePlace {
  first,         ///< data quality: in the text, and at the report's beginning
  report_first,  ///< at the report's beginning only
  results,       ///< in the text, and in the report
  report,        ///< in the report only
  run,           ///< in the text, and at the report's end
  run_only,      ///< at the report's end only
  csv,           ///< in the CSV file only
  json_only,     ///< in JSON only, without a CSV file
};
inline const std::vector<TablePlace> all_csv_places{
    TablePlace::report_first, TablePlace::first,    TablePlace::results, TablePlace::report,
    TablePlace::run,          TablePlace::run_only, TablePlace::csv};

struct Table {
  std::string name;  ///< of the CSV file, without extension
  std::string title;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  std::string note;  ///< how to read it; may be empty
  TablePlace place = TablePlace::results;
  /// Path of the rows in JSON; empty: omitted. "voids[]" is a list; "sorting.{condition}" an object
  /// for each row, named by its cell `condition`; "jnd[reference_g,condition]" the element of a
  /// list with these cells, which several tables may fill.
  std::string json{};
};

/// Title, headings, rows: words to the left, numbers to the right, "-" for what does not exist.
std::string as_text(const Table& table);

/// RFC 4180, UTF-8, '.' decimals, unrounded; an empty cell for what does not exist. The first
/// column, "data", has the text `data` in every row.
std::string as_csv(const Table& table, std::string_view data);

std::string as_html(const Table& table);

/// Lines of at most `width` characters, broken at spaces, or anywhere where a word is longer. None
/// for an empty text. width > 0.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

/// Lines of an item of a list: "- " before the first, two spaces before the others.
std::vector<std::string> as_item(std::vector<std::string> lines);

/// Text with <, >, & and quotes as HTML entities.
std::string html_escaped(std::string_view text);

}  // namespace heft
