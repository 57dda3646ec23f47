// Measures, wraps and renders the participant's texts, in any script whose fonts are installed,
// each line in its language's direction.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "view/text/Letters.h"

namespace heft {

/// A text fitted to an area, perhaps smaller than requested.
struct FittedText {
  float size_px = 0;
  std::vector<std::string> lines;
};

/// A character that no installed font has, and the first text with it ("welcome.title").
struct MissingCharacter {
  char32_t code = 0;
  std::string text;
};

class Typeface {
 public:
  /// @throws Error (invalid_file) naming the characters that no installed font has
  explicit Typeface(const ScreenTexts& texts);

  /// For measuring only: a character without a font is as wide as its replacement box.
  static Typeface for_measuring(const ScreenTexts& texts);

  float width_px(const std::string& line, float size_px) const;
  static float line_height_px(float size_px) { return 1.3f * size_px; }

  /// Lines no wider than a width, broken where their script allows (what cannot be broken extends
  /// beyond). A single line end counts as a space; an empty line starts a paragraph and is returned
  /// as an empty line.
  std::vector<std::string> wrapped(const std::string& text, float size_px, float width_px) const;

  /// The text wrapped at the largest of a few sizes from size_px down at which it fits, else at the
  /// smallest.
  /// @param least_px at most size_px
  FittedText fitted(const std::string& text, float size_px, float width_px, float height_px,
                    float least_px) const;

  /// Whether the texts' language is read from right to left.
  bool reads_right_to_left() const { return direction_ == Direction::right_to_left; }
  /// A line in its language's direction, unless all of its letters have the other one.
  WrittenLine written(const std::string& line, float size_px) const;
  Ink ink(const WrittenLine& line) const { return letters_->ink(line); }

 private:
  Typeface(const ScreenTexts& texts, std::shared_ptr<const Letters> letters);

  std::shared_ptr<const Letters> letters_;
  Direction direction_;
  // Pages are laid out for each frame, with the same few texts.
  mutable std::map<WrittenLine, float> widths_px_;
  mutable std::map<std::pair<WrittenLine, float>, std::vector<std::string>> wrapped_;
};

/// Paragraphs of a text, which empty lines separate; each in one line, with single spaces.
std::vector<std::string> paragraphs_of(const std::string& text);

/// Lists the characters and what to do about them.
std::string missing_characters_message(const std::vector<MissingCharacter>& characters);

/// Characters that no installed font has, in the texts' order, each once.
std::vector<MissingCharacter> missing_characters(const ScreenTexts& texts);

}  // namespace heft
