// Board and effector files: which printed tags are on a body, and where. Lengths in these files are
// as they were sent to the printer; `ruler_measured_m` says how long the sheet's 150 mm ruler came
// out, and everything is scaled by it.
#pragma once

#include <string>

#include "tracking/MarkerBody.h"

namespace heft {

/// @param text contents  @param file its name, for messages
/// @throws InvalidFile with every mistake at its line and column
MarkerBody parse_board(const std::string& text, const std::string& file);
/// As parse_board; tags must face away from the effector's center.
MarkerBody parse_effector(const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_board
MarkerBody load_board(const std::string& path);
MarkerBody load_effector(const std::string& path);

/// The board and the effector are told apart by their tags alone.
/// @throws Error naming the tags that both have
void require_different_tags(const MarkerBody& board, const MarkerBody& effector);

/// An effector file with a [[tag]] for each tag, which parse_effector reads back to 1e-9 m.
/// @param comment put on top, may be empty
std::string effector_to_toml(const MarkerBody& effector, const std::string& comment);

/// What a body has, for people: "24 tags of tag36h11, 40 mm, ids 0-23, 280 x 184 mm".
std::string described(const MarkerBody& body);

}  // namespace heft
