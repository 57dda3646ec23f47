#include "tracking/PlainYaml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/TextFile.h"

namespace heft {

namespace {
constexpr std::size_t most_bytes = 4'000'000, most_indent = 40;
constexpr int most_brackets = 2, most_colons = 4;  // open at once; in a line
constexpr std::string_view matrix_tag = "!!opencv-matrix";
constexpr std::string_view marks = " \t_.,:+-[]/()=;~";

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         marks.find(c) != std::string_view::npos;
}

bool is_heading(std::string_view line) {
  return line.starts_with("%YAML:1.") || line.starts_with("%YAML 1.");
}

bool ends_in_spaces(std::string_view rest) {
  return rest.find_first_not_of(" \t") == std::string_view::npos;
}

// OpenCV's reader never ends on some lines that have none.
bool has_key(std::string_view line) {
  const auto key = line.substr(0, line.find(':'));
  return !key.empty() && key.size() < line.size() && std::ranges::all_of(key, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
  });
}

class Scan {
 public:
  std::optional<std::string> fault_in(std::string_view line);
  std::size_t column() const { return at_ + 1; }
  bool is_open() const { return n_brackets_ > 0; }

 private:
  std::optional<std::string> fault_at_start();
  std::optional<std::string> fault_here();
  std::optional<std::string> skip_quoted(char quote);
  bool follows_key() const;

  std::string_view line_;
  std::size_t at_ = 0;
  int n_brackets_ = 0, n_colons_ = 0;
  bool has_content_ = false;
};

std::optional<std::string> Scan::fault_in(std::string_view line) {
  line_ = line;
  at_ = 0;
  n_colons_ = 0;
  if (auto fault = fault_at_start()) return fault;
  while (at_ < line_.size() && line_[at_] != '#') {
    if (auto fault = fault_here()) return fault;
    ++at_;
  }
  return std::nullopt;
}

std::optional<std::string> Scan::fault_at_start() {
  const auto indent = line_.find_first_not_of(' ');
  if (indent == std::string_view::npos) return std::nullopt;
  if (indent > most_indent) return "a key that is set in too far";
  if (line_[indent] == '\t' && !is_open()) return "a tab at the start of a line";
  const auto rest = line_.substr(indent);
  if (rest.starts_with("- -") || rest.starts_with("-  ") || rest.starts_with("-\t"))
    return "a list in a list";
  if (is_open() || rest.starts_with('#')) return std::nullopt;
  const bool is_mark = rest.starts_with("---") && ends_in_spaces(rest.substr(3));
  if (is_mark) return has_content_ ? std::optional("a second document") : std::nullopt;
  has_content_ = true;
  if (rest.starts_with('<')) return "XML";
  if (rest.starts_with("- ") || has_key(rest)) return std::nullopt;
  return "a line without a key";
}

std::optional<std::string> Scan::fault_here() {
  const char c = line_[at_];
  if (c == '"' || c == '\'') return skip_quoted(c);
  if (line_.substr(at_).starts_with(matrix_tag) &&
      ends_in_spaces(line_.substr(at_ + matrix_tag.size()))) {
    at_ = line_.size() - 1;
    return std::nullopt;
  }
  if (c == '!') return "a tag";
  if (c == '&' || c == '*') return "an anchor";
  if (c == '<') return "XML";
  if (!is_plain(c)) return fmt::format("\"{}\"", c >= ' ' && c < 0x7F ? std::string(1, c) : "?");
  if (c == '[' && ++n_brackets_ > most_brackets) return "a list in a list in a list";
  if (c == ']' && --n_brackets_ < 0) return "a bracket that nobody opened";
  if (c == ':' && !follows_key()) return "a colon without a key";
  if (c == ':' && (is_open() || ++n_colons_ > most_colons)) return "a key within a value";
  return std::nullopt;
}

bool Scan::follows_key() const {
  const char before = at_ > 0 ? line_[at_ - 1] : ' ';
  return std::isalnum(static_cast<unsigned char>(before)) != 0 ||
         std::string_view("_\"'").find(before) != std::string_view::npos;
}

std::optional<std::string> Scan::skip_quoted(char quote) {
  const auto end = line_.find(quote, at_ + 1);
  const auto text = line_.substr(at_, end - at_);
  if (end == std::string_view::npos) return "a quoted text that does not end";
  if (std::ranges::any_of(text, [](char c) { return c == '\\' || (c >= 0 && c < ' '); }))
    return "a quoted text with something escaped";
  at_ = end;
  return std::nullopt;
}
}  // namespace

std::optional<YamlFault> fault_in_plain_yaml(std::string_view text) {
  if (text.size() > most_bytes)
    return YamlFault{0, 0, fmt::format("more than {} bytes", most_bytes)};
  if (text.find('\0') != std::string_view::npos) return YamlFault{0, 0, "a NUL byte"};
  Scan scan;
  const auto lines = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i == 0 && is_heading(lines[i])) continue;
    if (auto fault = scan.fault_in(lines[i]))
      return YamlFault{static_cast<int>(i) + 1, static_cast<int>(scan.column()), *fault};
  }
  if (scan.is_open()) return YamlFault{0, 0, "a list that does not end"};
  return std::nullopt;
}

}  // namespace heft
