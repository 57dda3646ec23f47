// What a model says to a questionnaire: any of the answers, and none that owes anything to what it
// went through. Enough to have the pages turned and the answers logged.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiment/ScreenTexts.h"

namespace heft {

/// Each answer equally likely; of a number's range the whole ones. None to what is told to the
/// experimenter.
/// @param seed the responder's  @param key of the log: every question has draws of its own
std::optional<std::string> any_answer_to(const FormQuestion& question, std::uint64_t seed,
                                         const std::string& key);

}  // namespace heft
