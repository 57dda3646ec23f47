#include "view/Window.h"

#include "base/Program.h"

namespace heft {

const WindowModule& window_module() {
  static const auto& module = *static_cast<const WindowModule*>(
      from_module("heft-window.so", "heft_window", "finds displays and shows windows"));
  return module;
}

}  // namespace heft
