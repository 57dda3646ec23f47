// The ideal observer against every other model that uses what is displayed, with the same hands.
#include <gtest/gtest.h>

#include <cmath>

#include "SourceFolder.h"
#include "base/Random.h"
#include "population/Figures.h"
#include "responders/ResponderParameters.h"
#include "tasks/Sorting.h"

namespace heft {
namespace {

// Cubes of similar masses, sorted by the surrogate.
ResolvedConfig close_masses(const std::string& technique) {
  Protocol protocol = load_protocol(source_folder() + "/protocols/sorting.toml", {});
  for (Block& block : protocol.blocks)
    if (auto* sorting = block_as<Sorting::Block>(block)) {
      sorting->masses_g = {200, 206, 212};
      sorting->trials = {{technique, 40}};
    }
  SessionOptions given;
  given.responder = Plug{"simulated"};
  given.tracker = Plug{"surrogate"};
  return resolve(given, protocol, 3);
}

double percent_correct(const ResolvedConfig& config, std::string_view name,
                       const std::vector<Parameter>& parameters) {
  constexpr int n_people = 10;
  double sum = 0;
  for (int i = 0; i < n_people; ++i) {
    const std::uint64_t seed = RandomStream(7, "hand", static_cast<std::uint64_t>(i)).bits() >> 1;
    const auto person = responder_named(name).make({seed, parameters, ""});
    const std::vector<FigurePlace> correct{{FigureKind::correct, {}, ""}};
    sum += figures_of_one(config, *person, seed, correct).front().value_or(0);
  }
  return sum / n_people;
}

// The criterion of the ideal observer with another cue.
std::vector<Parameter> without_noise(std::string_view cue) {
  std::vector<Parameter> parameters{{"cue", std::string(cue), {}},
                                    {"criterion_mm", 0.3, {}},
                                    {"criterion_mm.spread", 0.0, {}},
                                    {"criterion_fraction", 0.03, {}},
                                    {"criterion_fraction.spread", 0.0, {}}};
  for (const char* name :
       {"just_visible_mm", "localization_noise_mm", "length_noise", "integration_s", "memory_noise",
        "judgment_noise_mm", "guess_probability", "lapse_rate", "correction_probability"})
    parameters.push_back({name, 0.0, {}});
  return parameters;
}

TEST(Ideal, SortsCloseMassesBetterThanEveryModelThatLooks) {
  const ResolvedConfig config = close_masses("C2");
  const double ideal = percent_correct(config, "ideal", {});
  EXPECT_GT(ideal, 60);
  for (const std::string_view cue : EnumNames<Cue>::names) {
    const double noisy = percent_correct(config, "simulated", {{"cue", std::string(cue), {}}});
    EXPECT_LT(noisy, ideal) << cue;
    const double exact = percent_correct(config, "simulated", without_noise(cue));
    EXPECT_LE(exact, ideal) << cue << ", without noise";
  }
}

// Where the clone stays on the hand, nothing displayed depends on a mass.
TEST(Ideal, IsBlindWhereNothingIsDisplayed) {
  EXPECT_EQ(percent_correct(close_masses("C1"), "ideal", {}), 0) << "it does not guess";
}

}  // namespace
}  // namespace heft
