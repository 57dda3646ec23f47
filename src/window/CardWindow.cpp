#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "window/GlWindow.h"
#include "window/Painter.h"

namespace heft {

namespace {
constexpr double start_fraction = 0.4;  // of the display's width
constexpr int wait_ms = 100;

enum class Response { none, accept, cancel };

struct Card {
  double w_px, most_px;

  void set(double wanted_px) { w_px = std::clamp(wanted_px, 50.0, most_px); }
  void change(double by_px) { set(w_px + by_px); }
};

Response key(const SDL_Keysym& pressed, Card& card) {
  const double step = (pressed.mod & KMOD_SHIFT) != 0 ? 10 : 1;
  switch (pressed.sym) {
    case SDLK_RETURN:
    case SDLK_KP_ENTER:
      return Response::accept;
    case SDLK_ESCAPE:
      return Response::cancel;
    case SDLK_RIGHT:
    case SDLK_UP:
      card.change(step);
      return Response::none;
    case SDLK_LEFT:
    case SDLK_DOWN:
      card.change(-step);
      return Response::none;
    default:
      return Response::none;
  }
}

Response handle(const SDL_Event& event, float scale, const Measures& window, Card& card) {
  switch (event.type) {
    case SDL_KEYDOWN:
      return key(event.key.keysym, card);
    case SDL_MOUSEWHEEL:
      card.change(event.wheel.y);
      return Response::none;
    case SDL_MOUSEMOTION:
      if ((event.motion.state & SDL_BUTTON_LMASK) != 0)
        card.set(2 * std::abs(static_cast<double>(static_cast<float>(event.motion.x) * scale -
                                                  window.width / 2)));
      return Response::none;
    case SDL_QUIT:
      return Response::cancel;
    default:
      return Response::none;
  }
}

// The instructions, above the card.
Page instructions(const std::string& how, const Typeface& typeface, const Measures& m) {
  Page page;
  const FittedText words =
      typeface.fitted(how, m.body, m.width - 2 * m.margin, m.height / 4, m.least_px(m.body));
  float y = m.margin;
  for (const std::string& line : words.lines) {
    page.lines.push_back({line, m.margin, y, words.size_px});
    y += Typeface::line_height_px(words.size_px);
  }
  return page;
}

void draw(GlWindow& window, const Card& card, const std::string& how, const Typeface& typeface) {
  const Measures m = window.measures();
  const auto w = static_cast<float>(card.w_px);
  const auto h = static_cast<float>(card.w_px * card_h_mm / card_w_mm);
  ImDrawList& list = window.begin_frame();
  paint_page(list, instructions(how, typeface, m), {typeface, m, window.written(), {}, {}, {}, {}});
  list.AddRectFilled({(m.width - w) / 2, (m.height - h) / 2},
                     {(m.width + w) / 2, (m.height + h) / 2}, IM_COL32(94, 177, 255, 255));
  window.end_frame();
}
}  // namespace

std::optional<MeasuredCard> measure_card(int display, const std::string& how) {
  GlWindow window("Heft", {display});
  const Measures m = window.measures();
  const Typeface typeface({"en", {}});
  Card card{start_fraction * static_cast<double>(m.width), static_cast<double>(m.width)};
  for (;;) {
    draw(window, card, how, typeface);
    SDL_Event event;
    if (SDL_WaitEventTimeout(&event, wait_ms) == 0) continue;
    const Response response = handle(event, window.scale(), m, card);
    if (response == Response::cancel) return std::nullopt;
    if (response == Response::accept) return MeasuredCard{window.display(), card.w_px};
  }
}

}  // namespace heft
