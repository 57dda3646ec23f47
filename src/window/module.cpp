// heft-window.so, loaded by view/Window.h.
#include "base/Program.h"
#include "view/Window.h"
#include "window/GlWindow.h"
#include "window/WindowView.h"

extern "C" __attribute__((visibility("default"))) const heft::WindowModule heft_window{
    [](const heft::ViewSetup& setup) -> std::unique_ptr<heft::ArView> {
      return std::make_unique<heft::WindowView>(setup);
    },
    heft::displays, heft::check_displays, heft::measure_card, heft::touch_delays_s};
extern "C" __attribute__((visibility("default"))) const char* const heft_window_edition =
    heft::module_edition;
