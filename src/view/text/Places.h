// Places of fitted texts on a page: on controls and over the scene; and the photodiode's patch.
#pragma once

#include <string>

#include "view/screens/Page.h"
#include "view/text/Typeface.h"

namespace heft {

/// A control's text and the note below it, fitted to their areas.
struct ControlWords {
  FittedText text, note;
  Rect text_area, note_area;  ///< the note's is empty without a note
};

ControlWords words_on(const Control& control, const Typeface& typeface, const Measures& measures);

/// A fitted notice or hint over the scene, and its plate.
struct NoticeWords {
  FittedText text;
  Rect area;
};

NoticeWords words_of_notice(const std::string& notice, const Rect& scene, const Typeface& typeface,
                            const Measures& measures, bool at_top = false);

/// A square in a lower corner for a photodiode, white or black.
struct Patch {
  bool white = false;
  bool left = true;  ///< at the left side of the screen
};

/// Twice the margin wide: 4 to 5 mm on a 7" screen; no control overlaps it.
Rect place_of(const Patch& patch, const Measures& measures);

}  // namespace heft
