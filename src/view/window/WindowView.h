// The participant's window: SDL2 and OpenGL, full screen, for touch at arm's length. Fingers and
// mouse are equal: a tap is going down and up on the same control, or on the same cube in the
// scene, which is as good as its button. Targets' sizes: Measures.h. F11 changes between full
// screen and a window.
//
// Keyboard: 1...9 a cube or a form's choice; L, I, H lightest, intermediate, heaviest (whatever the
// language); Enter goes on, agrees, validates; D "I don't know"; N "No difference", "I do not
// agree"; Backspace puts the cubes back, or goes back in a form or a text.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view/ArView.h"
#include "view/window/Page.h"

namespace heft {

class WindowView final : public ArView {
 public:
  /// @throws Error (device_missing) without a display or the typeface, (invalid_file) when the
  /// typeface lacks a character of the texts
  explicit WindowView(const ViewSetup& setup);
  ~WindowView() override;

  std::optional<double> present(const ViewPicture& shown, const ScreenState& screen) override;
  std::vector<Touch> wait(double seconds) override;

  /// The controls as last shown, in pixels of the window: for tests, and for scripts that tap.
  const std::vector<Control>& controls() const;
  /// The name of the enabled control that a tap at this pixel is for; a cube in the scene goes by
  /// its button's name.
  std::optional<std::string> target_at(float x, float y) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heft
