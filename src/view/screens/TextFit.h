// Places of fitted texts on a page: on controls and over the scene, and the photodiode's patch; and
// the check that all texts fit.
#pragma once

#include <string>
#include <vector>

#include "experiment/ScreenTexts.h"
#include "view/screens/Page.h"
#include "view/text/Typeface.h"

namespace heft {

/// The smallest supported screen: 1024 x 600, 7".
Measures smallest_screen(double text_size = 1);

/// One sentence for each text that would be much smaller than the others, or would extend beyond
/// its place. Characters that no installed font has count as wide as their replacement boxes.
/// @return each sentence begins with the name of its page and ": "
std::vector<std::string> texts_that_do_not_fit(const ScreenTexts& texts, const Measures& measures);
/// The same for these screens only.
std::vector<std::string> texts_that_do_not_fit(const ScreenTexts& texts, const Measures& measures,
                                               const std::vector<ScreenState>& screens);

/// A control's text and the note below it, fitted to their areas.
struct ControlWords {
  FittedText text, note;
  Rect text_area, note_area;  ///< the note's is empty without a note
};

ControlWords words_on(const Control& control, const Typeface& typeface, const Measures& measures);

/// Words of all controls of a page, in their order. Controls of one size have letters of one size,
/// so that no answer is emphasized; those with a note are separate.
std::vector<ControlWords> words_on(const std::vector<Control>& controls, const Typeface& typeface,
                                   const Measures& measures);

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
