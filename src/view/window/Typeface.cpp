#include "view/window/Typeface.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "base/Error.h"

namespace heft {

namespace {
// Where distributions put it; Debian's package is fonts-dejavu-core.
constexpr std::array font_files{
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/local/share/fonts/dejavu/DejaVuSans.ttf"};

std::string font_file() {
  for (const char* file : font_files)
    if (std::filesystem::exists(file)) return file;
  throw Error(fmt::format("the typeface of the participant's screens is not installed: there is no "
                          "{}; install DejaVu Sans (Debian: apt-get install fonts-dejavu-core)",
                          font_files.front()),
              ExitCode::device_missing);
}

std::string all_characters(const ScreenTexts& texts) {
  std::string all;
  for (char c = ' '; c < 127; ++c) all += c;
  for (const auto& [page, keys] : texts.pages)
    for (const auto& [key, text] : keys) all += text;
  std::erase(all, '\n');
  return all;
}

ImVector<ImWchar> ranges_of(const std::string& characters) {
  ImFontGlyphRangesBuilder builder;
  builder.AddText(characters.c_str());
  ImVector<ImWchar> ranges;
  builder.BuildRanges(&ranges);
  return ranges;
}

void refuse_missing(const ImFont& font, const ImVector<ImWchar>& ranges,
                    const std::string& language) {
  for (int i = 0; ranges[i] != 0; i += 2)
    for (unsigned c = ranges[i]; c <= ranges[i + 1]; ++c)
      if (c != 0xA0 && !font.FindGlyphNoFallback(static_cast<ImWchar>(c)))
        throw Error(fmt::format("the text file in the language \"{}\" has the character U+{:04X}, "
                                "which DejaVu Sans lacks; write it in another way",
                                language, c),
                    ExitCode::invalid_file);
}

std::vector<std::string> words_of(const std::string& paragraph) {
  std::istringstream stream(paragraph);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> paragraphs_of(const std::string& text) {
  std::vector<std::string> paragraphs;
  std::size_t from = 0;
  for (std::size_t end; (end = text.find("\n\n", from)) != std::string::npos; from = end + 2)
    paragraphs.push_back(text.substr(from, end - from));
  paragraphs.push_back(text.substr(from));
  return paragraphs;
}
}  // namespace

Typeface::Typeface(const ScreenTexts& texts, const Measures& measures)
    : atlas_(std::make_shared<ImFontAtlas>()) {
  const std::string file = font_file();
  const ImVector<ImWchar> ranges = ranges_of(all_characters(texts));
  for (const float size_px : {measures.small, measures.body, measures.title})
    fonts_.push_back(atlas_->AddFontFromFileTTF(file.c_str(), std::max(6.f, std::round(size_px)),
                                                nullptr, ranges.Data));
  if (!atlas_->Build())
    throw Error(fmt::format("{} is no typeface that can be used; install DejaVu Sans again", file),
                ExitCode::device_missing);
  refuse_missing(*fonts_.front(), ranges, texts.language);
}

const ImFont& Typeface::font(float size_px) const {
  for (const ImFont* font : fonts_)
    if (font->FontSize >= size_px - 0.5f) return *font;
  return *fonts_.back();
}

float Typeface::width_px(const std::string& text, float size_px) const {
  const char* begin = text.c_str();
  return font(size_px).CalcTextSizeA(size_px, FLT_MAX, 0, begin, begin + text.size()).x;
}

std::vector<std::string> Typeface::wrapped(const std::string& text, float size_px,
                                           float width) const {
  std::vector<std::string> lines;
  for (const std::string& paragraph : paragraphs_of(text)) {
    if (!lines.empty()) lines.emplace_back();
    std::string line;
    for (const std::string& word : words_of(paragraph)) {
      const std::string longer = line.empty() ? word : line + ' ' + word;
      if (!line.empty() && width_px(longer, size_px) > width) {
        lines.push_back(line);
        line = word;
      } else {
        line = longer;
      }
    }
    lines.push_back(line);
  }
  return lines;
}

FittedText Typeface::fitted(const std::string& text, float size_px, float width,
                            float height) const {
  constexpr float smallest = 0.5f;
  FittedText fit;
  for (float scale = 1; scale >= smallest; scale -= 0.05f) {
    fit = {scale * size_px, wrapped(text, scale * size_px, width)};
    const float lines_px = static_cast<float>(fit.lines.size()) * line_height_px(fit.size_px);
    const bool narrow = std::ranges::all_of(
        fit.lines, [&](const std::string& line) { return width_px(line, fit.size_px) <= width; });
    if (narrow && lines_px <= height) break;
  }
  return fit;
}

}  // namespace heft
