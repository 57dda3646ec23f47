// The keyboard key by key: while this object exists, the terminal has no line editing and no echo.
// Restored whenever the program is stopped (Ctrl-Z) or ends.
#pragma once

namespace heft::cli {

class RawTerminal {
 public:
  /// Has no effect unless stdin and stderr are both terminals. One object at a time.
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  bool is_there() const { return is_there_; }

  /// Whether keys can be read: not while the program runs in the background. Restores the
  /// key-by-key mode if another program changed it.
  bool listens();

  /// Current number of columns of the terminal; 80 if unknown.
  static int width();

 private:
  bool is_there_;
};

}  // namespace heft::cli
