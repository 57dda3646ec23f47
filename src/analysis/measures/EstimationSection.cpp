// Magnitude estimation: the numbers given to single cubes by mass and condition, and the exponent
// of the power function between mass and number (Stevens 1957), of each participant and over them.
#include <cmath>

#include "analysis/Section.h"

namespace heft {

namespace {
constexpr Measure geometric_mean{
    "estimation_geometric_mean", "", "geometric mean",
    "number given to a mass: exp of the mean over participants of each "
    "one's mean logarithm, Student's t interval on the logarithms; of "
    "numbers above 0"};
constexpr Measure mean_value{"estimation_mean", "", "mean",
                             "number given to a mass: mean over participants of each one's mean"};
constexpr Measure exponent{
    "estimation_exponent", "", "exponent",
    "slope of the logarithm of the number on the logarithm of the mass, by "
    "least squares for each participant: mean over participants, Student's t "
    "interval; 1: the numbers are proportional to the mass"};

// One participant's numbers in one condition.
struct Numbers {
  std::map<double, std::vector<double>> by_mass, logs_by_mass;

  std::optional<double> slope() const {
    double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (const auto& [mass_g, logs] : logs_by_mass)
      for (const double y : logs) {
        const double x = std::log(mass_g);
        n += 1;
        sum_x += x;
        sum_y += y;
        sum_xx += x * x;
        sum_xy += x * y;
      }
    if (logs_by_mass.size() < 2) return std::nullopt;
    return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
  }
};

// The mean over participants, with its interval.
StudyEstimate over_people(const Measure& measure, const std::vector<double>& values) {
  StudyEstimate estimate{&measure};
  estimate.value = mean(values);
  estimate.sd = sample_sd(values);
  estimate.set(student_t_interval(values));
  estimate.n = static_cast<int>(values.size());
  estimate.method = "Student's t";
  return estimate;
}

class EstimationSection final : public Section {
 public:
  void add(const SessionData& data) override {
    for (const Attempt& attempt : data.attempts) {
      const TrialRow& trial = attempt.trial;
      if (!attempt.completed() || !trial.value || !std::isfinite(*trial.value) ||
          trial.plan.is_practice || attempt.cubes.size() != 1)
        continue;
      const double mass_g = attempt.cubes.front().mass_g;
      task_ = trial.plan.task;
      Numbers& numbers = conditions_[trial.plan.condition][data.participant()];
      numbers.by_mass[mass_g].push_back(*trial.value);
      if (*trial.value > 0) numbers.logs_by_mass[mass_g].push_back(std::log(*trial.value));
    }
  }

  void put(Summary& summary) override {
    for (Estimates all = everything(); StudyEstimate & estimate : all)
      if (estimate.participant.empty()) summary.estimates.push_back(std::move(estimate));
  }

  Estimates of_participants(const Summary&) const override {
    Estimates all = everything();
    std::erase_if(all, [](const StudyEstimate& estimate) { return estimate.participant.empty(); });
    return all;
  }

  std::vector<EstimateTable> tables() const override {
    std::vector<EstimateColumn> columns{
        key_column("condition", "condition"), key_column("mass_g", "mass g"),
        column(mean_value, Field::n, "n_participants", "n"),
        column(mean_value, Field::n_trials, "n_trials", "trials"),
        column(geometric_mean, Field::value, "geometric_mean", "geometric mean", 2)};
    add_interval(columns, geometric_mean, "low", "high");
    columns.push_back(column(mean_value, Field::value, "mean", "mean", 2));
    columns.push_back(column(mean_value, Field::sd, "sd", "SD", 2));
    EstimateTable by_mass{"estimation",
                          "Magnitude estimation: numbers by mass",
                          std::move(columns),
                          "over participants, each of whom counts once; the interval is the "
                          "geometric mean's",
                          TablePlace::results,
                          "estimation[]"};
    std::vector<EstimateColumn> slopes{key_column("condition", "condition"),
                                       column(exponent, Field::n, "n", "n"),
                                       column(exponent, Field::value, "exponent", "exponent", 3),
                                       column(exponent, Field::sd, "sd", "SD", 3)};
    add_interval(slopes, exponent, "low", "high");
    EstimateTable exponents{"estimation_exponent",
                            "Magnitude estimation: exponent of the power law",
                            std::move(slopes),
                            "slope of log number on log mass of each participant; 1: proportional",
                            TablePlace::results,
                            "estimation_exponent[]"};
    EstimateTable people{
        "estimation_by_participant",
        "Each participant's exponent",
        {key_column("condition", "condition"), key_column("participant", "participant"),
         column(exponent, Field::value, "exponent", "exponent", 3),
         column(exponent, Field::n_trials, "n_trials", "trials")},
        "",
        TablePlace::csv};
    people.participants = true;
    return {by_mass, exponents, people};
  }

  std::vector<ChartSpec> charts() const override {
    ChartSpec numbers{
        "estimation", "Magnitude estimation: numbers by mass, 95 % intervals",
        "Geometric mean over participants of the numbers given to each mass, with "
        "Student's t interval on the logarithms; small points: each participant. Both "
        "axes are logarithmic: a power function is a straight line.",
        "estimation.csv"};
    numbers.importance = 36;
    numbers.series = {{&geometric_mean, "", {}}};
    numbers.x = "mass_g";
    numbers.split = {"condition"};
    numbers.participants = true;
    numbers.x_label = "mass (g)";
    numbers.y_label = "number";
    numbers.axes = "set logscale x\nset logscale y\n";
    ChartSpec exponents{"estimation_exponent", "Exponents of magnitude estimation, 95 % intervals",
                        "Slope of the logarithm of the number on the logarithm of the mass: mean "
                        "over participants, and each participant's.",
                        "estimation_exponent.csv"};
    exponents.importance = 37;
    exponents.series = {{&exponent, "exponent", {}}};
    exponents.x = "condition";
    exponents.participants = true;
    exponents.y_label = "exponent";
    return {numbers, exponents};
  }

 private:
  using People = std::map<std::string, Numbers>;

  Estimates everything() const {
    Estimates all;
    for (const auto& [condition, people] : conditions_) {
      put_by_mass(all, condition, people, mean_value, &Numbers::by_mass);
      put_by_mass(all, condition, people, geometric_mean, &Numbers::logs_by_mass);
      put_exponents(all, condition, people);
    }
    return all;
  }

  StudyEstimate placed(StudyEstimate estimate, const std::string& condition) const {
    estimate.task = task_;
    estimate.condition = condition;
    return estimate;
  }

  // Of logarithms what they are of.
  void put_by_mass(Estimates& all, const std::string& condition, const People& people,
                   const Measure& measure,
                   std::map<double, std::vector<double>> Numbers::*numbers) const {
    const bool of_logs = &measure == &geometric_mean;
    const auto back = [of_logs](std::optional<double>& value) {
      if (value && of_logs) value = std::exp(*value);
    };
    std::map<double, std::vector<double>> means;
    std::map<double, int> n_trials;
    const auto put = [&](StudyEstimate estimate, double mass_g) {
      estimate = placed(std::move(estimate), condition);
      estimate.by = {at("mass_g", mass_g)};
      for (auto* value : {&estimate.value, &estimate.low, &estimate.high}) back(*value);
      if (of_logs) estimate.sd.reset();
      all.push_back(std::move(estimate));
    };
    for (const auto& [participant, theirs] : people)
      for (const auto& [mass_g, values] : theirs.*numbers) {
        StudyEstimate own{&measure};
        own.participant = participant;
        own.value = mean(values);
        own.n = 1;
        own.n_trials = static_cast<int>(values.size());
        means[mass_g].push_back(*own.value);
        n_trials[mass_g] += own.n_trials;
        put(std::move(own), mass_g);
      }
    for (const auto& [mass_g, values] : means) {
      StudyEstimate estimate = over_people(measure, values);
      estimate.n_trials = n_trials[mass_g];
      put(std::move(estimate), mass_g);
    }
  }

  void put_exponents(Estimates& all, const std::string& condition, const People& people) const {
    std::vector<double> slopes;
    for (const auto& [participant, numbers] : people) {
      StudyEstimate own = placed({&exponent}, condition);
      own.participant = participant;
      own.value = numbers.slope();
      own.n = 1;
      for (const auto& [mass_g, logs] : numbers.logs_by_mass)
        own.n_trials += static_cast<int>(logs.size());
      if (own.value)
        slopes.push_back(*own.value);
      else
        own.why = "numbers above 0 at fewer than two masses";
      all.push_back(std::move(own));
    }
    StudyEstimate estimate = placed(over_people(exponent, slopes), condition);
    if (slopes.empty()) estimate.why = "nobody gave numbers above 0 at two masses";
    all.push_back(std::move(estimate));
  }

  std::string task_;
  std::map<std::string, People> conditions_;
};
}  // namespace

std::shared_ptr<Section> estimation_section() {
  return std::make_shared<EstimationSection>();
}

}  // namespace heft
