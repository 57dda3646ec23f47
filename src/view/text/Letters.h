// Text in any script whose fonts are installed, by Pango: shaped, in both directions, with suitable
// fonts.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace heft {

enum class Direction { left_to_right, right_to_left };

/// A line of text. Its size is from a letter's top to the bottom of descenders.
struct WrittenLine {
  std::string text;
  float size_px = 0;
  Direction direction = Direction::left_to_right;

  auto operator<=>(const WrittenLine&) const = default;
};

/// Coverage of each pixel by a line's ink, 0...255, row by row. Positioned relative to the line's
/// left end at the top of its size.
struct Ink {
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<std::uint8_t> coverage;
};

/// Directions of a text's letters; digits and marks have none.
struct Runs {
  bool left_to_right = false, right_to_left = false;
  Direction first = Direction::left_to_right;
};

class Letters {
 public:
  virtual ~Letters() = default;

  virtual float width_px(const WrittenLine& line) const = 0;
  /// Breaks a paragraph into lines no wider than width_px, where its script allows (what cannot be
  /// broken extends beyond).
  virtual std::vector<std::string> lines_of(const WrittenLine& paragraph, float width_px) const = 0;
  virtual Ink ink(const WrittenLine& line) const = 0;
  virtual Runs runs(const std::string& text) const = 0;
  /// Its characters that no installed font has, each once.
  virtual std::vector<char32_t> without_font(const std::string& text) const = 0;
};

/// @param language of the texts ("ja"): selects the regional forms of characters
std::unique_ptr<Letters> make_letters(const std::string& language);

}  // namespace heft
