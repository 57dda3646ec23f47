// Comma-separated values (RFC 4180): quoted cells with commas, line ends and doubled quotes; LF or
// CRLF; an optional byte-order mark. Spaces around a cell are ignored.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/Error.h"

namespace heft {

struct CsvCell {
  std::string text;
  int line = 0, column = 0;  ///< of its first byte or opening quote; columns are bytes, from 1
};

class CsvReader {
 public:
  /// @param text must outlive the reader
  CsvReader(std::string_view text, std::string file);

  /// The next row that is not blank; empty at the end of the text.
  /// @throws InvalidFile for an unclosed quote or text after a closing quote
  std::vector<CsvCell> next();

  /// A mistake at this cell, for InvalidFile.
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

/// A cell as RFC 4180 writes it, quoted where necessary.
std::string csv_cell(std::string_view text);

/// Prefixes ' to texts that a spreadsheet would evaluate (first character = + - @ or a control
/// character) and to texts that begin with ', so that readers can remove the prefix.
std::string without_formula(std::string_view text);

}  // namespace heft
