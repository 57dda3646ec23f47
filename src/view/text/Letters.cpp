#include "view/text/Letters.h"

#include <fribidi.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace heft {

namespace {
template <auto Free>
struct Freed {
  template <typename T>
  void operator()(T* thing) const {
    Free(thing);
  }
};
template <typename T>
using Object = std::unique_ptr<T, Freed<g_object_unref>>;

// The preferred typeface. Its letters extend from 0.928 em above the baseline to 0.236 em below;
// lines of all fonts are aligned to it.
constexpr const char* family = "DejaVu Sans";
constexpr double above_em = 0.928, below_em = 0.236;

double em_px(float size_px) {
  return static_cast<double>(size_px) / (above_em + below_em);
}

double baseline_px(float size_px) {
  return em_px(size_px) * above_em;
}

PangoDirection pango(Direction direction) {
  return direction == Direction::right_to_left ? PANGO_DIRECTION_RTL : PANGO_DIRECTION_LTR;
}

// Widths are proportional to size, so that measured and drawn texts agree.
Object<PangoContext> context_of(PangoFontMap* fonts, const std::string& language) {
  Object<PangoContext> context(pango_font_map_create_context(fonts));
  pango_context_set_language(context.get(), pango_language_from_string(language.c_str()));
  pango_context_set_round_glyph_positions(context.get(), FALSE);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_SLIGHT);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  pango_cairo_context_set_font_options(context.get(), options);
  cairo_font_options_destroy(options);
  return context;
}

// Characters without ink: spaces, and marks that join or direct letters.
bool has_no_ink(gunichar c) {
  if (g_unichar_isspace(c)) return true;
  const GUnicodeType type = g_unichar_type(c);
  return type == G_UNICODE_CONTROL || type == G_UNICODE_FORMAT || (c >= 0xFE00 && c <= 0xFE0F);
}

std::vector<gunichar> characters_of(const std::string& text) {
  std::vector<gunichar> all;
  const char* end = text.c_str() + text.size();
  for (const char* at = text.c_str(); at < end; at = g_utf8_next_char(at))
    all.push_back(g_utf8_get_char(at));
  return all;
}

std::string without_last_spaces(std::string line) {
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

class PangoLetters final : public Letters {
 public:
  explicit PangoLetters(const std::string& language)
      : fonts_(pango_cairo_font_map_new()), context_(context_of(fonts_.get(), language)) {}

  float width_px(const WrittenLine& line) const override {
    int width = 0;
    pango_layout_get_size(layout(line).get(), &width, nullptr);
    return static_cast<float>(pango_units_to_double(width));
  }

  std::vector<std::string> lines_of(const WrittenLine& paragraph, float width_px) const override {
    const Object<PangoLayout> all = layout(paragraph);
    pango_layout_set_wrap(all.get(), PANGO_WRAP_WORD);
    pango_layout_set_width(all.get(), pango_units_from_double(static_cast<double>(width_px)));
    std::vector<std::string> lines;
    for (GSList* at = pango_layout_get_lines_readonly(all.get()); at != nullptr; at = at->next) {
      const auto* line = static_cast<const PangoLayoutLine*>(at->data);
      lines.push_back(without_last_spaces(paragraph.text.substr(
          static_cast<std::size_t>(line->start_index), static_cast<std::size_t>(line->length))));
    }
    return lines;
  }

  Ink ink(const WrittenLine& line) const override {
    constexpr int around_px = 1;  // smoothing extends beyond
    const Object<PangoLayout> drawn = layout(line);
    PangoRectangle inked;
    pango_layout_get_pixel_extents(drawn.get(), &inked, nullptr);
    const int baseline = static_cast<int>(std::lround(baseline_px(line.size_px)));
    const double down = baseline - pango_units_to_double(pango_layout_get_baseline(drawn.get()));
    const int raised = static_cast<int>(std::floor(down));
    Ink ink{inked.x - around_px,
            inked.y + raised - around_px,
            inked.width + 2 * around_px,
            inked.height + 2 * around_px + 1,
            {}};
    if (inked.width > 0 && inked.height > 0) paint(*drawn, down, ink);
    return ink;
  }

  Runs runs(const std::string& text) const override {
    Runs runs;
    for (const gunichar c : characters_of(text)) {
      const FriBidiCharType type = fribidi_get_bidi_type(c);
      if (!FRIBIDI_IS_STRONG(type)) continue;
      const bool right_to_left = FRIBIDI_IS_RTL(type);
      if (right_to_left && !runs.left_to_right) runs.first = Direction::right_to_left;
      (right_to_left ? runs.right_to_left : runs.left_to_right) = true;
    }
    return runs;
  }

  std::vector<char32_t> without_font(const std::string& text) const override {
    constexpr float any_size_px = 20;
    std::vector<char32_t> missing;
    for (const gunichar c : characters_of(text)) {
      if (has_no_ink(c) || !checked_.insert(c).second) continue;
      char letter[7] = {};
      g_unichar_to_utf8(c, letter);
      const Object<PangoLayout> one = layout({letter, any_size_px, {}});
      if (pango_layout_get_unknown_glyphs_count(one.get()) > 0) missing_.insert(c);
    }
    for (const gunichar c : characters_of(text))
      if (missing_.contains(c) && std::ranges::find(missing, char32_t{c}) == missing.end())
        missing.push_back(c);
    return missing;
  }

 private:
  Object<PangoLayout> layout(const WrittenLine& line) const {
    pango_context_set_base_dir(context_.get(), pango(line.direction));
    Object<PangoLayout> made(pango_layout_new(context_.get()));
    pango_layout_set_auto_dir(made.get(), FALSE);
    pango_layout_set_text(made.get(), line.text.c_str(), static_cast<int>(line.text.size()));
    PangoFontDescription* font = pango_font_description_new();
    pango_font_description_set_family_static(font, family);
    pango_font_description_set_absolute_size(font, em_px(line.size_px) * PANGO_SCALE);
    pango_layout_set_font_description(made.get(), font);
    pango_font_description_free(font);
    return made;
  }

  static void paint(PangoLayout& drawn, double down, Ink& ink) {
    cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, ink.width, ink.height);
    cairo_t* pen = cairo_create(surface);
    cairo_move_to(pen, -ink.left, down - ink.top);
    pango_cairo_show_layout(pen, &drawn);
    cairo_destroy(pen);
    cairo_surface_flush(surface);
    const unsigned char* rows = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; rows != nullptr && y < ink.height; ++y)
      ink.coverage.insert(ink.coverage.end(), rows + y * stride, rows + y * stride + ink.width);
    cairo_surface_destroy(surface);
  }

  Object<PangoFontMap> fonts_;
  Object<PangoContext> context_;
  mutable std::set<gunichar> checked_, missing_;
};
}  // namespace

std::unique_ptr<Letters> make_letters(const std::string& language) {
  return std::make_unique<PangoLetters>(language);
}

}  // namespace heft
