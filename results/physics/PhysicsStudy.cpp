#include "results/physics/PhysicsStudy.h"

#include <array>
#include <utility>

#include "base/SimulationChoices.h"
#include "results/physics/Stability.h"
#include "results/physics/scenes/Measurements.h"

namespace heft {

std::string color_of(std::string_view simulator) {
  using Look = std::pair<std::string_view, const char*>;
  constexpr std::array<Look, 15> looks{{{"boxes", "#0b5fb4"},
                                        {"push", "#2aa1c9"},
                                        {"quasi_static", "#7cc4dd"},
                                        {"bullet-lx", "#1b7f3b"},
                                        {"bullet-x", "#55a845"},
                                        {"bullet-ea", "#98b92f"},
                                        {"bullet-stable-pd", "#d95f02"},
                                        {"bullet-exact-velocity", "#e6a100"},
                                        {"bullet-spring2", "#8e44ad"},
                                        {"bullet-soft-rows", "#c2407e"},
                                        {"bullet-explicit", "#c00000"},
                                        {"bullet-explicit-held", "#7a0019"},
                                        {"gain", "#b5651d"},
                                        {"speed_limit", "#c2407e"},
                                        {coupled_technique, "#555555"}}};
  for (const auto& [name, color] : looks)
    if (name == simulator) return color;
  return "#888888";
}

void run_physics_study(const StudyOptions& options) {
  const Measurements measurements = measure(options);
  write_tables(options, measurements);
  draw_work_precision(options);
  study_hands(options);
  study_promise(options);
  study_growth(options);
  study_lag(options);
  study_input(options);
  study_stability(options);
}

}  // namespace heft
