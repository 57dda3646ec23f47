// Scene files: physics alone, for `heft scene`.
#pragma once

#include <string>

#include "physics/Scene.h"

namespace heft {

/// @throws InvalidFile with every mistake at its line and column
Scene parse_scene(const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_scene
Scene load_scene(const std::string& path);

}  // namespace heft
