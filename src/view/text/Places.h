// Where on a page words stand that are made to fit: on controls, on the notice over the scene; and
// the photodiode's patch.
#pragma once

#include <string>

#include "view/screens/Page.h"
#include "view/text/Typeface.h"

namespace heft {

/// A control's words and the note below them, made to fit their places on it.
struct ControlWords {
  FittedText text, note;
  Rect text_area, note_area;  ///< the note's is empty where there is none
};

ControlWords words_on(const Control& control, const Typeface& typeface, const Measures& measures);

/// A notice or hint over the scene, made to fit, and its plate.
struct NoticeWords {
  FittedText text;
  Rect area;
};

NoticeWords words_of_notice(const std::string& notice, const Rect& scene, const Typeface& typeface,
                            const Measures& measures, bool at_top = false);

/// A square in a lower corner for a photodiode, white or black.
struct Patch {
  bool white = false;
  bool left = true;  ///< of the screen's sides
};

/// Twice the margin wide: 4 to 5 mm on a 7" screen; no control reaches into it.
Rect place_of(const Patch& patch, const Measures& measures);

}  // namespace heft
