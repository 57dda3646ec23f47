// `heft bench physics`: what the simulators cost, how far off they are, and where they fail.
#pragma once

#include <string>
#include <string_view>

#include "results/Study.h"

namespace heft {

void run_physics_study(const StudyOptions& options);

// Random scenes of hands as they are: what each rate keeps in nearly all of them; and scenes that
// grow.

/// hands.csv and hands.svg
void study_hands(const StudyOptions& options);

/// growth.csv and growth.svg: the cost of a step against the number of cubes.
void study_growth(const StudyOptions& options);

// What the way from camera poses to a target costs, against a hand that is known at all times.

/// input.csv and input.svg
void study_input(const StudyOptions& options);

// How far the clone stays behind the effector for cubes of all masses: what people perceive.

/// lag_vs_mass.csv and lag_vs_mass.svg
void study_lag(const StudyOptions& options);

// The color of a simulator in every chart of the physics study.

/// A color for gnuplot: one family of hues for ours, one for our schemes on Bullet, one for other
/// people's set-ups.
std::string color_of(std::string_view simulator);

}  // namespace heft
