// Comma-separated text as spreadsheets write it (RFC 4180): quoted cells that may hold commas, line
// ends and doubled quotes; LF or CRLF; a byte order mark. Spaces around a cell don't belong to it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/Error.h"

namespace heft {

struct CsvCell {
  std::string text;
  int line = 0, column = 0;  ///< where it begins, with its quote; bytes of the line, from 1
};

class CsvReader {
 public:
  /// @param text must outlive the reader
  CsvReader(std::string_view text, std::string file);

  /// The next row that is not blank; no cells: the end.
  /// @throws InvalidFile for a quote that nothing closes, or text after a closing one
  std::vector<CsvCell> next();

  /// A mistake in this cell, for InvalidFile.
  Mistake mistake(const CsvCell& cell, std::string message) const;

 private:
  CsvCell cell();
  std::string quoted(const CsvCell& begin);
  std::string plain();
  bool at_line_end() const;
  void skip_spaces();
  void skip_line_end();
  int column() const { return static_cast<int>(at_ - line_begin_) + 1; }

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0, line_begin_ = 0;
  int line_ = 1;
};

/// RFC 4180: in quotes where it needs them.
std::string csv_cell(std::string_view text);

/// A text that a spreadsheet would take for a formula or a command (it begins with = + - @ or a
/// control character) with a ' before it; one that begins with ' too, so that it can be undone.
std::string without_formula(std::string_view text);

}  // namespace heft
