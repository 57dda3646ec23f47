#include "view/text/Typeface.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "base/Error.h"

namespace heft {

namespace {
constexpr std::size_t most_remembered = 4096;

// With single spaces instead of white space and line ends.
std::string in_one_line(const std::string& paragraph) {
  std::istringstream stream(paragraph);
  std::string line;
  for (std::string word; stream >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

// The direction in which most texts begin: one may begin with a foreign name.
Direction direction_of(const ScreenTexts& texts, const Letters& letters) {
  int balance = 0;
  for (const auto& [page, keys] : texts.pages)
    for (const auto& [key, text] : keys)
      if (const Runs runs = letters.runs(text); runs.left_to_right || runs.right_to_left)
        balance += runs.first == Direction::right_to_left ? 1 : -1;
  return balance > 0 ? Direction::right_to_left : Direction::left_to_right;
}

std::vector<MissingCharacter> find_missing(const ScreenTexts& texts, const Letters& letters) {
  std::vector<MissingCharacter> all;
  std::set<char32_t> reported;
  for (const auto& [page, keys] : texts.pages)
    for (const auto& [key, text] : keys)
      for (const char32_t code : letters.without_font(text))
        if (reported.insert(code).second) all.push_back({code, page + '.' + key});
  return all;
}

std::string listed(const std::vector<MissingCharacter>& characters) {
  constexpr std::size_t most_listed = 6;
  std::string list;
  for (std::size_t i = 0; i < std::min(most_listed, characters.size()); ++i)
    list += fmt::format("{}U+{:04X} in {}", i > 0 ? ", " : "",
                        static_cast<unsigned>(characters[i].code), characters[i].text);
  if (characters.size() > most_listed)
    list += fmt::format(" and {} more", characters.size() - most_listed);
  return list;
}

template <typename Key, typename Value, typename Make>
const Value& remembered(std::map<Key, Value>& memory, const Key& key, const Make& make) {
  if (const auto found = memory.find(key); found != memory.end()) return found->second;
  if (memory.size() >= most_remembered) memory.clear();
  return memory.emplace(key, make()).first->second;
}
}  // namespace

std::vector<std::string> paragraphs_of(const std::string& text) {
  std::vector<std::string> paragraphs;
  std::size_t from = 0;
  for (std::size_t end; (end = text.find("\n\n", from)) != std::string::npos; from = end + 2)
    paragraphs.push_back(in_one_line(text.substr(from, end - from)));
  paragraphs.push_back(in_one_line(text.substr(from)));
  return paragraphs;
}

Typeface::Typeface(const ScreenTexts& texts, std::shared_ptr<const Letters> letters)
    : letters_(std::move(letters)), direction_(direction_of(texts, *letters_)) {}

Typeface::Typeface(const ScreenTexts& texts) : Typeface(for_measuring(texts)) {
  const auto missing = find_missing(texts, *letters_);
  if (missing.empty()) return;
  throw Error(fmt::format("the text file in the language \"{}\" has {}", texts.language,
                          missing_characters_message(missing)),
              ExitCode::invalid_file);
}

Typeface Typeface::for_measuring(const ScreenTexts& texts) {
  return {texts, make_letters(texts.language)};
}

WrittenLine Typeface::written(const std::string& line, float size_px) const {
  const Runs runs = letters_->runs(line);
  const bool one_way = runs.left_to_right != runs.right_to_left;
  return {line, size_px, one_way ? runs.first : direction_};
}

float Typeface::width_px(const std::string& line, float size_px) const {
  const WrittenLine written_line = written(line, size_px);
  return remembered(widths_px_, written_line, [&] { return letters_->width_px(written_line); });
}

std::vector<std::string> Typeface::wrapped(const std::string& text, float size_px,
                                           float width) const {
  const auto wrap = [&] {
    std::vector<std::string> lines;
    for (const std::string& paragraph : paragraphs_of(text)) {
      if (!lines.empty()) lines.emplace_back();
      for (std::string& line : letters_->lines_of(written(paragraph, size_px), width))
        lines.push_back(std::move(line));
    }
    return lines;
  };
  return remembered(wrapped_, std::pair(WrittenLine{text, size_px, direction_}, width), wrap);
}

FittedText Typeface::fitted(const std::string& text, float size_px, float width, float height,
                            float least_px) const {
  FittedText fit;
  for (float scale = 1; scale * size_px >= least_px; scale -= 0.05f) {
    fit = {scale * size_px, wrapped(text, scale * size_px, width)};
    const float lines_px = static_cast<float>(fit.lines.size()) * line_height_px(fit.size_px);
    const bool narrow = std::ranges::all_of(
        fit.lines, [&](const std::string& line) { return width_px(line, fit.size_px) <= width; });
    if (narrow && lines_px <= height) break;
  }
  return fit;
}

std::string missing_characters_message(const std::vector<MissingCharacter>& characters) {
  return fmt::format(
      "characters that no installed font has: {}; install a font with them (Debian: apt-get "
      "install fonts-dejavu-core, fonts-noto-core or fonts-noto-cjk), or use other characters",
      listed(characters));
}

std::vector<MissingCharacter> missing_characters(const ScreenTexts& texts) {
  return find_missing(texts, *make_letters(texts.language));
}

}  // namespace heft
