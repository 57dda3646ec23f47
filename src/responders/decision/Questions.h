// A model's answers to questionnaires: random, independent of its trials. Enough to complete the
// pages and to log answers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiment/ScreenTexts.h"

namespace heft {

/// Each answer equally likely; whole numbers of a number's range. None for questions that are
/// answered to the experimenter.
/// @param seed the responder's  @param key in the log: every question has its own draws
std::optional<std::string> any_answer_to(const FormQuestion& question, std::uint64_t seed,
                                         const std::string& key);

}  // namespace heft
