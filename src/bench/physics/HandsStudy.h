// Random scenes of hands as they are: what each rate keeps in nearly all of them; and scenes that
// grow.
#pragma once

#include "bench/StudyFiles.h"

namespace heft {

/// hands.csv and hands.svg
void study_hands(const StudyOptions& options);

/// growth.csv and growth.svg: the cost of a step against the number of cubes.
void study_growth(const StudyOptions& options);

}  // namespace heft
