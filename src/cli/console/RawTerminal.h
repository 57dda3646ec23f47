// The keyboard key by key: the terminal without line editing and echo while this lives, and as it
// was before whenever the program is stopped (Ctrl-Z) or ends.
#pragma once

namespace heft::cli {

class RawTerminal {
 public:
  /// Does nothing where stdin and stderr are not both a terminal. One at a time.
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  bool is_there() const { return is_there_; }

  /// Whether keys can be read now: not while the program runs in the background. Puts the terminal
  /// right where somebody else had it meanwhile.
  bool listens();

  /// Columns of the terminal as it is now; 80 where it does not say.
  static int width();

 private:
  bool is_there_;
};

}  // namespace heft::cli
