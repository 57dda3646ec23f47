// The films that the goals and the filters are judged on: our tracker as it comes, and what most
// people build, on the same pictures.
#pragma once

#include "bench/Study.h"
#include "bench/StudyFiles.h"
#include "bench/tracking/Filming.h"

namespace heft {

struct Headline {
  int width_px = 0;
  struct Pair {
    MethodFilm ours, plain;
  };
  Pair strokes, swipes, holds;
};

inline constexpr int headline_parts = 3;  ///< of progress, a picture size
Headline film_headline(int width_px, bool quick, StudyProgress& progress);

/// Swipes count while they are this fast.
inline constexpr double swiping_m_s = 0.45;

}  // namespace heft
