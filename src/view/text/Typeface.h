// How the participant's texts are written: measures and wraps them, and makes their ink. Any script
// whose fonts are installed; each line in the direction that its language reads.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "view/text/Letters.h"

namespace heft {

/// Text that was made to fit: perhaps smaller than wished for.
struct FittedText {
  float size_px = 0;
  std::vector<std::string> lines;
};

/// A character that no installed font has, and the first text that it is in ("welcome.title").
struct LackingCharacter {
  char32_t code = 0;
  std::string text;
};

class Typeface {
 public:
  /// @throws Error (invalid_file) naming the characters of the texts that no installed font has
  explicit Typeface(const ScreenTexts& texts);

  /// To measure with: a character without a font is as wide as the box that stands for it.
  static Typeface whatever_lacks(const ScreenTexts& texts);

  float width_px(const std::string& line, float size_px) const;
  static float line_height_px(float size_px) { return 1.3f * size_px; }

  /// Lines no wider than a width, broken where their script may be (what can't be broken sticks
  /// out). A single line end counts as a space; an empty line starts a paragraph and comes out
  /// empty.
  std::vector<std::string> wrapped(const std::string& text, float size_px, float width_px) const;

  /// The text wrapped at the largest of a few sizes from size_px down at which it fits, or else at
  /// the least.
  /// @param least_px at most size_px
  FittedText fitted(const std::string& text, float size_px, float width_px, float height_px,
                    float least_px) const;

  /// The texts' language does.
  bool reads_right_to_left() const { return direction_ == Direction::right_to_left; }
  /// A line goes with its language, unless all of its letters go the other way.
  WrittenLine written(const std::string& line, float size_px) const;
  Ink ink(const WrittenLine& line) const { return letters_->ink(line); }

 private:
  Typeface(const ScreenTexts& texts, std::shared_ptr<const Letters> letters);

  std::shared_ptr<const Letters> letters_;
  Direction direction_;
  // Pages are laid out each frame, with the same few texts.
  mutable std::map<WrittenLine, float> widths_px_;
  mutable std::map<std::pair<WrittenLine, float>, std::vector<std::string>> wrapped_;
};

/// Which they are, and what can be done.
std::string without_font(const std::vector<LackingCharacter>& characters);

/// In the texts' order, each once.
std::vector<LackingCharacter> characters_without_font(const ScreenTexts& texts);

}  // namespace heft
