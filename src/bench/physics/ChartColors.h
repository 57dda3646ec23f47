// The color of a simulator in every chart of the physics study.
#pragma once

#include <string>
#include <string_view>

namespace heft {

/// A color for gnuplot: one family of hues for ours, one for our schemes on Bullet, one for other
/// people's set-ups.
std::string color_of(std::string_view simulator);

}  // namespace heft
