#include "base/files/Csv.h"

#include <algorithm>
#include <utility>

#include "base/files/TextFile.h"

namespace heft {

CsvReader::CsvReader(std::string_view text, std::string file)
    : text_(without_byte_order_mark(text)), file_(std::move(file)) {}

std::vector<CsvCell> CsvReader::next() {
  std::vector<CsvCell> row;
  while (at_ < text_.size()) {
    row.push_back(cell());
    if (at_ < text_.size() && text_[at_] == ',') {
      ++at_;
      if (at_ == text_.size()) row.push_back({"", line_, column()});
      continue;
    }
    skip_line_end();
    const bool is_blank = row.size() == 1 && row[0].text.empty();
    if (!is_blank) return row;
    row.clear();
  }
  return row;
}

CsvCell CsvReader::cell() {
  skip_spaces();
  CsvCell cell{"", line_, column()};
  const bool has_quotes = at_ < text_.size() && text_[at_] == '"';
  cell.text = has_quotes ? quoted(cell) : plain();
  return cell;
}

std::string CsvReader::quoted(const CsvCell& begin) {
  std::string cell;
  for (++at_;; ++at_) {
    if (at_ == text_.size()) throw InvalidFile({mistake(begin, "this quote is not closed")});
    const char c = text_[at_];
    if (c == '"' && !text_.substr(at_ + 1).starts_with('"')) break;
    if (c == '"') ++at_;
    cell += c;
    if (c != '\n') continue;
    ++line_;
    line_begin_ = at_ + 1;
  }
  ++at_;
  skip_spaces();
  if (at_ < text_.size() && text_[at_] != ',' && !at_line_end())
    throw InvalidFile(
        {mistake({"", line_, column()},
                 "expected a comma or the line's end after the closing quote; write a quote "
                 "within quotes twice")});
  return cell;
}

std::string CsvReader::plain() {
  const std::size_t begin = at_;
  std::size_t end = at_;  // after the last character that is not a space
  for (; at_ < text_.size() && text_[at_] != ',' && !at_line_end(); ++at_)
    if (text_[at_] != ' ' && text_[at_] != '\t') end = at_ + 1;
  return std::string(text_.substr(begin, end - begin));
}

bool CsvReader::at_line_end() const {
  const std::string_view rest = text_.substr(at_);
  return rest.starts_with('\n') || rest.starts_with("\r\n") || rest == "\r";
}

void CsvReader::skip_spaces() {
  while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
}

void CsvReader::skip_line_end() {
  at_ = std::min(text_.size(), text_.find('\n', at_));
  if (at_ < text_.size()) ++at_;
  line_begin_ = at_;
  ++line_;
}

Mistake CsvReader::mistake(const CsvCell& cell, std::string message) const {
  return {{file_, cell.line, cell.column}, std::move(message)};
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string without_formula(std::string_view text) {
  constexpr unsigned char first_printable = 0x20, delete_key = 0x7f;
  if (text.empty()) return "";
  const auto first = static_cast<unsigned char>(text.front());
  const bool is_control = first < first_printable || first == delete_key;
  const bool is_formula = std::string_view("=+-@'").find(text.front()) != std::string_view::npos;
  std::string safe = is_control || is_formula ? "'" : "";
  return safe.append(text);
}

}  // namespace heft
