// Magnitude estimation: the numbers given to single cubes by mass, friction and condition, and the
// exponents of number as a power function of mass and friction (Stevens 1957).
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "analysis/display/Phrases.h"
#include "analysis/measures/Section.h"

namespace heft {

namespace {
constexpr Measure geometric_mean{
    "estimation_geometric_mean", "", "geometric mean",
    "number given to a mass: exp of the mean over participants of each one's mean logarithm, "
    "Student's t interval on the logarithms; of numbers above 0"};
constexpr Measure mean_value{"estimation_mean", "", "mean",
                             "number given to a mass: mean over participants of each one's mean"};
constexpr Measure left_out{"estimation_left_out", "", "not above 0",
                           "numbers that have no logarithm; geometric mean and exponent are of the "
                           "others"};
constexpr Measure exponent{
    "estimation_exponent", "", "exponent",
    "slope of the logarithm of the number on the logarithm of the mass, by least squares for each "
    "participant: mean over participants, Student's t interval; 1: the numbers are proportional to "
    "the mass"};
constexpr Measure friction_exponent{
    "estimation_friction_exponent", "", "exponent of friction",
    "where cubes have their own friction on the table: slope of the logarithm of the number on the "
    "logarithm of that friction, by least squares together with the mass: mean over participants, "
    "Student's t interval; equal to the exponent of mass: only mass times friction counts"};

struct CubeKind {
  double mass_g = 0;
  std::optional<double> table_friction;
  auto operator<=>(const CubeKind&) const = default;
};

struct Exponents {
  std::optional<double> mass, friction;
  std::string why;  // reason if they are missing
};

// One participant's numbers in one condition.
struct Numbers {
  std::map<CubeKind, std::vector<double>> by_cube;
  std::map<CubeKind, std::vector<double>> logs_by_cube;  // of the numbers above 0

  // Least squares of y on x, the logarithm of mass, and z, that of friction where it varies.
  Exponents exponents() const {
    double n = 0, x_sum = 0, y_sum = 0, z_sum = 0;
    double xx_sum = 0, xy_sum = 0, zz_sum = 0, xz_sum = 0, zy_sum = 0;
    std::set<double> masses, frictions;
    for (const auto& [cube, logs] : logs_by_cube) {
      if (logs.empty()) continue;
      const double x = std::log(cube.mass_g), z = std::log(cube.table_friction.value_or(1));
      masses.insert(cube.mass_g);
      frictions.insert(cube.table_friction.value_or(1));
      for (const double y : logs) {
        n += 1;
        x_sum += x;
        y_sum += y;
        z_sum += z;
        xx_sum += x * x;
        xy_sum += x * y;
        zz_sum += z * z;
        xz_sum += x * z;
        zy_sum += z * y;
      }
    }
    if (masses.size() < 2) return {{}, {}, "numbers above 0 at fewer than two masses"};
    const double xx = n * xx_sum - x_sum * x_sum, xy = n * xy_sum - x_sum * y_sum;
    if (frictions.size() < 2) return {xy / xx, {}, {}};
    const double zz = n * zz_sum - z_sum * z_sum, zy = n * zy_sum - z_sum * y_sum;
    const double xz = n * xz_sum - x_sum * z_sum, determinant = xx * zz - xz * xz;
    if (determinant < 1e-9 * xx * zz)
      return {{}, {}, "mass and friction varied together: their effects are not identifiable"};
    return {(zz * xy - xz * zy) / determinant, (xx * zy - xz * xy) / determinant, {}};
  }
};

StudyEstimate sum_over_people(const std::vector<const StudyEstimate*>& people) {
  StudyEstimate sum = *people.front();
  sum.participant.clear();
  sum.n = static_cast<int>(people.size());
  for (const StudyEstimate* own : std::span(people).subspan(1)) {
    *sum.value += *own->value;
    sum.n_trials += own->n_trials;
  }
  return sum;
}

class EstimationSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const Attempt& attempt : data.attempts) {
      const TrialRow& trial = attempt.trial;
      if (!attempt.completed() || !trial.value || !std::isfinite(*trial.value) ||
          trial.plan.task != "estimation" || attempt.cubes.size() != 1)
        continue;
      const CubeRow& shown = attempt.cubes.front();
      const CubeKind cube{shown.mass_g, shown.table_friction};
      has_friction_ = has_friction_ || cube.table_friction.has_value();
      Numbers& numbers = people_[{trial.plan.condition, data.participant()}];
      numbers.by_cube[cube].push_back(*trial.value);
      std::vector<double>& logs = numbers.logs_by_cube[cube];
      if (*trial.value > 0) logs.push_back(std::log(*trial.value));
    }
  }

  Estimates of_participants(const Summary&) const override {
    Estimates all;
    for (const auto& [key, numbers] : people_) {
      const auto put = [&, &condition = key.first, &participant = key.second](
                           const Measure& measure, std::optional<double> value,
                           std::size_t n_trials) -> StudyEstimate& {
        StudyEstimate& own = all.emplace_back(StudyEstimate{&measure, "estimation", condition});
        own.participant = participant;
        own.value = value;
        own.n = 1;
        own.n_trials = static_cast<int>(n_trials);
        return own;
      };
      std::size_t n_logs = 0;
      for (const auto& [cube, values] : numbers.by_cube) {
        const std::vector<double>& logs = numbers.logs_by_cube.at(cube);
        const auto mean_log = mean(logs);
        n_logs += logs.size();
        std::vector<Coordinate> by{at("mass_g", cube.mass_g)};
        if (cube.table_friction) by.push_back(at("table_friction", *cube.table_friction));
        put(mean_value, mean(values), values.size()).by = by;
        put(left_out, static_cast<double>(values.size() - logs.size()), values.size()).by = by;
        StudyEstimate& geometric =
            put(geometric_mean, mean_log ? std::optional(std::exp(*mean_log)) : std::nullopt,
                logs.size());
        geometric.by = by;
        if (!mean_log) geometric.why = "no number above 0";
      }
      const Exponents exponents = numbers.exponents();
      put(exponent, exponents.mass, n_logs).why = exponents.why;
      if (has_friction_) {
        StudyEstimate& of_friction = put(friction_exponent, exponents.friction, n_logs);
        of_friction.why = exponents.why;
        if (!of_friction.value && of_friction.why.empty())
          of_friction.why = "numbers above 0 at one friction only";
      }
    }
    return all;
  }

  void put(Summary& summary) override {
    const Estimates own = of_participants(summary);
    using Value = std::optional<double>;
    std::map<std::tuple<std::string, Value, Value, std::string_view>,
             std::vector<const StudyEstimate*>>
        groups;
    const auto value_at = [](const StudyEstimate& one, std::string_view name) {
      const Coordinate* found = one.at(name);
      return found ? found->value : std::nullopt;
    };
    for (const StudyEstimate& one : own)
      groups[{one.condition, value_at(one, "mass_g"), value_at(one, "table_friction"),
              one.measure->name}]
          .push_back(&one);
    for (const auto& [key, people] : groups)
      summary.estimates.push_back(
          people.front()->measure == &left_out
              ? sum_over_people(people)
              : mean_over_people(people, people.front()->measure == &geometric_mean));
  }

  std::vector<std::string> findings(const Summary& summary) const override {
    std::vector<std::string> parts;
    for (const StudyEstimate* one : estimates_of(summary.estimates, exponent.name)) {
      std::string where = in_condition(summary, one->condition);
      const StudyEstimate* friction =
          find_estimate(summary.estimates, friction_exponent.name, {{"condition", one->condition}});
      if (friction && friction->value)
        where += fmt::format(" (of friction: {:.2f})", *friction->value);
      if (!one->value)
        parts.push_back("none " + where);
      else if (!one->low)
        parts.push_back(fmt::format("{:.2f} {}", *one->value, where));
      else
        parts.push_back(
            fmt::format("{:.2f} [{:.2f}, {:.2f}] {}", *one->value, *one->low, *one->high, where));
    }
    if (parts.empty()) return {};
    return {
        fmt::format("Magnitude estimation: the exponent of the power law is {} (1: numbers "
                    "proportional to mass).",
                    some_of(parts, 4))};
  }

  std::vector<EstimateTable> tables() const override {
    EstimateTable by_mass{
        "estimation",
        "Magnitude estimation: numbers by mass",
        {key_column("condition", "condition"), key_column("mass_g", "mass g"),
         column(mean_value, Field::n, "n_participants", "n"),
         column(mean_value, Field::n_trials, "n_trials", "trials"),
         column(mean_value, Field::value, "mean", "mean", 2),
         column(mean_value, Field::sd, "sd", "SD", 2),
         column(left_out, Field::value, "n_left_out", "not above 0", 0),
         column(geometric_mean, Field::n, "n_geometric_mean", "n above 0"),
         column(geometric_mean, Field::value, "geometric_mean", "geometric mean", 2)},
        "over participants, each of whom counts once. A number that is not above 0 has no "
        "logarithm: it is counted, and the geometric mean and its interval are of the others",
        TablePlace::results,
        "estimation[]"};
    add_interval(by_mass.columns, geometric_mean, "low", "high", 2);
    by_mass.columns.push_back(column(geometric_mean, Field::why, "why", "no geometric mean: why"));
    if (has_friction_)
      by_mass.columns.insert(by_mass.columns.begin() + 2, key_column("table_friction", "friction"));
    EstimateTable exponents{
        "estimation_exponent",
        "Magnitude estimation: exponent of the power law",
        {key_column("condition", "condition"), column(exponent, Field::n, "n", "n"),
         column(exponent, Field::value, "exponent", "exponent", 2),
         column(exponent, Field::sd, "sd", "SD", 2)},
        "slope of log number on log mass of each participant, of numbers above 0; 1: proportional",
        TablePlace::results,
        "estimation_exponent[]"};
    add_interval(exponents.columns, exponent, "low", "high", 2);
    exponents.columns.push_back(column(exponent, Field::why, "why", "no exponent"));
    if (has_friction_) {
      exponents.columns.push_back(
          column(friction_exponent, Field::value, "friction_exponent", "of friction", 2));
      add_interval(exponents.columns, friction_exponent, "friction_low", "friction_high", 2);
    }
    EstimateTable people{
        "estimation_by_participant",
        "Each participant's exponent",
        {key_column("condition", "condition"), key_column("participant", "participant"),
         column(exponent, Field::value, "exponent", "exponent", 2),
         column(exponent, Field::n_trials, "n_trials", "trials"),
         column(exponent, Field::why, "why", "no exponent: why")},
        "",
        TablePlace::csv};
    people.participants = true;
    if (has_friction_)
      people.columns.push_back(
          column(friction_exponent, Field::value, "friction_exponent", "of friction", 2));
    return {by_mass, exponents, people};
  }

  std::vector<ChartSpec> charts() const override {
    std::vector<std::string_view> split{"condition"};
    if (has_friction_) split.push_back("table_friction");
    return {
        {.name = "estimation",
         .title = "Magnitude estimation: numbers by mass, 95 % intervals",
         .caption = "Geometric mean over participants of the numbers given to each mass, with "
                    "Student's t interval on the logarithms; small points: each participant. Both "
                    "axes are logarithmic: a power function is a straight line.",
         .csv = "estimation.csv",
         .importance = 36,
         .series = {{&geometric_mean}},
         .x = "mass_g",
         .split = split,
         .participants = true,
         .x_label = "mass (g)",
         .y_label = "number",
         .axes = "set logscale xy\n"},
        {.name = "estimation_exponent",
         .title = "Exponents of magnitude estimation, 95 % intervals",
         .caption = "Slope of the logarithm of the number on the logarithm of the mass: mean "
                    "over participants, and each participant's.",
         .csv = "estimation_exponent.csv",
         .importance = 37,
         .series = {{&exponent, "exponent"}},
         .x = "condition",
         .participants = true,
         .y_label = "exponent"}};
  }

 private:
  std::map<std::pair<std::string, std::string>, Numbers> people_;  // by condition and participant
  bool has_friction_ = false;                                      // some cube has table_friction
};
}  // namespace

std::shared_ptr<Section> estimation_section() {
  return std::make_shared<EstimationSection>();
}

}  // namespace heft
