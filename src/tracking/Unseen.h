// Why a board or an effector was found in no picture: what one of them shows instead.
#pragma once

#include <string>

#include "base/Image.h"
#include "tracking/MarkerBody.h"

namespace heft {

/// A picture in which the body was not found, in words: dark, white, mirrored, with other tags,
/// without any. Takes as long as several detections.
/// @param what the body is called  @param beside may be in the picture, too: the other body
std::string why_unseen(const Image& picture, const MarkerBody& body, const std::string& what,
                       const MarkerBody& beside = {});

}  // namespace heft
