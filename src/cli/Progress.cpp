#include "cli/Progress.h"

#include <unistd.h>

#include <algorithm>

#include "cli/Talk.h"

namespace heft::cli {

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), shown_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (shown_) draw("\r\033[K");
}

void ProgressBar::update(double share, const std::string& text) {
  constexpr int width = 30;
  const auto now = std::chrono::steady_clock::now();
  if (!shown_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  const int filled = static_cast<int>(width * std::clamp(share, 0.0, 1.0));
  draw(fmt::format("\r\033[K{} [{:=<{}}{:{}}] {}", label_, "", filled, "", width - filled,
                   escaped_line(text)));
}

}  // namespace heft::cli
