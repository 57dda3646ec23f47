// What may meet: who answers, what films and what shows, and all of them with the protocol. Private
// to this folder.
#pragma once

#include "apparatus/configuration/ResolvedConfig.h"

namespace heft {

/// @throws Error (usage) where a person can't see or touch the view, or drags where there is no
///   person or no window
void require_compatible_plugs(const ResolvedConfig::Parts& parts);

/// Whether the participant can give the answers that the protocol takes, and the simulator models
/// what their hand does.
/// @throws Error (usage) where answers need contact with every cube and a model's hand touches
///   none; where the simulator knows straight strokes alone and the hand does more
void require_answerable(const ResolvedConfig::Parts& parts, const Protocol& protocol);

/// @throws Error (invalid_file) where a block asks a question that the session's texts do not have
void require_questions(const Protocol& protocol);

}  // namespace heft
