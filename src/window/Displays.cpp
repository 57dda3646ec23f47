#include <SDL_opengl.h>
#include <fmt/format.h>

#include "base/Error.h"
#include "base/Names.h"
#include "view/text/Typeface.h"
#include "window/GlWindow.h"

namespace heft {

namespace {
constexpr const char* no_desktop =
    "none: sessions with a window need a desktop (DISPLAY or WAYLAND_DISPLAY set)";

std::string described(const DisplayFacts& display) {
  const std::string refresh =
      display.refresh_hz ? fmt::format(" at {:g} Hz", *display.refresh_hz) : "";
  return fmt::format("{} ({}), {} x {} pixels{}", display.number, display.name, display.w_px,
                     display.h_px, refresh);
}

// Does not need a display.
CheckResult check_typeface(const ScreenTexts& texts) try {
  const Typeface typeface(texts);
  return {CheckVerdict::ok, "typeface", "has every character of the participant's texts"};
} catch (const Error& error) {
  return {CheckVerdict::failed, "typeface", error.what()};
}

// Opens a hidden window for a moment.
CheckResult check_graphics() try {
  const GlWindow window("Heft", {.hidden = true});
  const std::string renderer = window.renderer();
  const bool software = renderer.find("llvmpipe") != std::string::npos ||
                        renderer.find("softpipe") != std::string::npos;
  return {software ? CheckVerdict::warning : CheckVerdict::ok, "graphics",
          software ? renderer + ", without a graphics card: frames may be late" : renderer};
} catch (const Error& error) {
  return {CheckVerdict::failed, "graphics", error.what()};
}

CheckResult check_touch() {
  const int n = SDL_GetNumTouchDevices();
  if (n == 0) return {CheckVerdict::ok, "touch", "no touch screen; a mouse works, too"};
  return {CheckVerdict::ok, "touch", counted(n, "touch device")};
}
}  // namespace

std::vector<CheckResult> check_displays(const ScreenTexts& texts) {
  std::vector<CheckResult> results;
  for (const DisplayFacts& display : displays())
    results.push_back({CheckVerdict::ok, "display", described(display)});
  if (results.empty())
    results.push_back({CheckVerdict::warning, "display", no_desktop});
  else
    results.push_back(check_graphics());
  results.push_back(check_typeface(texts));
  if (results.size() > 2) results.push_back(check_touch());
  return results;
}

}  // namespace heft
