#include "tracking/PlainYaml.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/Error.h"
#include "base/TextFile.h"

namespace heft {

namespace {
constexpr std::size_t most_bytes = 4'000'000, most_indent = 40;
constexpr int most_brackets = 2;  // open at once
constexpr std::string_view matrix_tag = "!!opencv-matrix";

bool is_alphanumeric(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

bool is_one_of(std::string_view characters, char c) {
  return characters.find(c) != std::string_view::npos;
}

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t") == std::string_view::npos;
}

bool is_heading(std::string_view line) {
  return line.starts_with("%YAML:1.") || line.starts_with("%YAML 1.");
}

class YamlReader {
 public:
  explicit YamlReader(const std::string& file) : file_(file) {}

  YamlValues read(std::string_view text) {
    if (text.size() > most_bytes) refuse(fmt::format("more than {} bytes", most_bytes));
    if (text.find('\0') != std::string_view::npos) refuse("a NUL byte");
    for (const std::string_view line : lines_of(text)) {
      line_ = line;
      at_ = 0;
      if (++n_lines_ == 1 && is_heading(line)) continue;
      if (n_brackets_ > 0 || begins_value()) take_scalars();
    }
    n_lines_ = 0;
    if (n_brackets_ > 0) refuse("a list that does not end");
    return std::move(values_);
  }

 private:
  bool begins_value();
  void begin_key(std::string_view rest, std::size_t indent);
  void take_scalars();
  std::string quoted();
  std::string word();
  void add(std::string scalar) { values_[keys_.back().path].scalars.push_back(std::move(scalar)); }

  [[noreturn]] void refuse(std::string_view what) const {
    const int column = n_lines_ > 0 ? static_cast<int>(at_) + 1 : 0;
    throw InvalidFile({{{file_, n_lines_, column},
                        fmt::format("this is no plain YAML: it holds {}; expected a camera file as "
                                    "heft calibrate camera writes it",
                                    what)}});
  }

  struct Key {
    std::size_t indent;
    std::string path;
  };

  std::string file_;
  std::string_view line_;
  std::size_t at_ = 0;
  int n_lines_ = 0, n_brackets_ = 0;
  std::vector<Key> keys_;  ///< the one at hand within those before it
  YamlValues values_;
};

// Goes on to what follows a key or a dash. @return whether the line has any
bool YamlReader::begins_value() {
  const auto indent = line_.find_first_not_of(' ');
  if (indent == std::string_view::npos || line_[indent] == '#') return false;
  at_ = indent;
  const auto rest = line_.substr(indent);
  if (rest[0] == '\t') refuse("a tab at the start of a line");
  if (indent > most_indent) refuse("a key that is set in too far");
  if (rest[0] == '<') refuse("XML");
  if (rest.starts_with("---") && is_blank(rest.substr(3))) {
    if (!values_.empty()) refuse("a second document");
    return false;
  }
  if (!rest.starts_with("- ")) return begin_key(rest, indent), true;
  at_ = line_.find_first_not_of(" \t", indent + 1);
  if (at_ == std::string_view::npos) return false;
  if (line_.substr(at_).starts_with("- ")) refuse("a list in a list");
  if (keys_.empty()) refuse("a line without a key");
  return true;
}

void YamlReader::begin_key(std::string_view rest, std::size_t indent) {
  const auto name = rest.substr(0, rest.find(':'));
  const auto belongs = [](char c) { return is_alphanumeric(c) || c == '_' || c == '.'; };
  if (name.empty() || name.size() == rest.size() || !std::ranges::all_of(name, belongs))
    refuse("a line without a key");
  while (!keys_.empty() && keys_.back().indent >= indent) keys_.pop_back();
  keys_.push_back({indent, (keys_.empty() ? "" : keys_.back().path + ".") + std::string(name)});
  const YamlValue value{n_lines_, static_cast<int>(indent) + 1, {}};
  if (!values_.emplace(keys_.back().path, value).second) refuse("a key for the second time");
  at_ = indent + name.size() + 1;
}

void YamlReader::take_scalars() {
  while ((at_ = line_.find_first_not_of(" \t", at_)) < line_.size() && line_[at_] != '#') {
    const char c = line_[at_];
    const auto rest = line_.substr(at_);
    if (c == '"' || c == '\'') {
      add(quoted());
    } else if (c == '[') {
      if (++n_brackets_ > most_brackets) refuse("a list in a list in a list");
      ++at_;
    } else if (c == ']') {
      if (--n_brackets_ < 0) refuse("a bracket that nobody opened");
      ++at_;
    } else if (c == ',' && n_brackets_ > 0) {
      ++at_;
    } else if (rest.starts_with(matrix_tag) && is_blank(rest.substr(matrix_tag.size()))) {
      return;
    } else {
      add(word());
    }
  }
}

std::string YamlReader::quoted() {
  const auto end = line_.find(line_[at_], at_ + 1);
  if (end == std::string_view::npos) refuse("a quoted text that does not end");
  const auto text = line_.substr(at_, end + 1 - at_);
  if (std::ranges::any_of(text, [](char c) { return c == '\\' || (c >= 0 && c < ' '); }))
    refuse("a quoted text with something escaped");
  at_ = end + 1;
  return std::string(text);
}

// Up to what can't be in it.
std::string YamlReader::word() {
  const auto start = at_;
  for (; at_ < line_.size() && !is_one_of("[]\"'#", line_[at_]); ++at_) {
    const char c = line_[at_];
    if (c == ',' && n_brackets_ > 0) break;
    if (c == '!') refuse("a tag");
    if (c == '&' || c == '*') refuse("an anchor");
    if (c == '<') refuse("XML");
    if (!is_alphanumeric(c) && !is_one_of(" \t_.,:+-/()=;~", c))
      refuse(fmt::format("\"{}\"", c >= ' ' && c < 0x7F ? c : '?'));
    if (c == ':' && is_blank(line_.substr(at_ + 1, 1))) refuse("a key within a value");
  }
  const auto word = line_.substr(start, at_ - start);
  return std::string(word.substr(0, word.find_last_not_of(" \t") + 1));
}
}  // namespace

YamlValues parse_plain_yaml(std::string_view text, const std::string& file) {
  return YamlReader(file).read(text);
}

}  // namespace heft
