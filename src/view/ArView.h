// The plug for what shows the session: a window, a video file, or nothing. A view draws what it is
// given and reports what was touched; it decides nothing. One table, in ArView.cpp, names them all.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/Action.h"
#include "experiment/DisplayedFrame.h"
#include "experiment/ScreenState.h"

namespace heft {

class ArView {
 public:
  virtual ~ArView() = default;

  /// Presents one picture and the screen around it.
  /// @return the session time at which it was presented; a view without a display returns `now_s`
  virtual double present(const DisplayedFrame& frame, const ScreenState& screen, double now_s) = 0;
};

/// A row of the table of views.
struct ViewEntry {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<ArView> (*make)();
};

std::span<const ViewEntry> views();

/// @throws Error (usage) naming the nearest view when there is none of that name
std::unique_ptr<ArView> make_view(std::string_view name);

}  // namespace heft
