// A progress bar on stderr, when stderr is a terminal.
#pragma once

#include <chrono>
#include <string>

namespace heft::cli {

class ProgressBar {
 public:
  /// @param label what is going on
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param share done, 0...1  @param text beside the bar
  void update(double share, const std::string& text);

 private:
  std::string label_;
  bool shown_;
  std::chrono::steady_clock::time_point drawn_{};
};

}  // namespace heft::cli
