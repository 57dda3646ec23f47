// The Python module heft._heft: procedures, fits and the data dictionary, as plain values. The
// package beside it (heft/) makes the classes of them that programs use.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/report/Report.h"
#include "base/Error.h"
#include "base/Names.h"
#include "inference/AnswerData.h"
#include "protocol/readers/Files.h"
#include "psychophysics/Interleaving.h"
#include "record/export/Export.h"

namespace py = pybind11;

namespace heft {

namespace {
py::dict values(const Reversal& reversal) {
  using namespace py::literals;
  return py::dict("number"_a = reversal.number, "level"_a = reversal.level,
                  "step_before"_a = reversal.step_before, "step_after"_a = reversal.step_after);
}

py::dict values(const Estimate& estimate) {
  using namespace py::literals;
  return py::dict("method"_a = estimate.method, "value"_a = estimate.value, "low"_a = estimate.low,
                  "high"_a = estimate.high, "sd"_a = estimate.sd,
                  "censored"_a = name_of(estimate.censored), "n_trials"_a = estimate.n_trials,
                  "n_reversals"_a = estimate.n_reversals, "n_floor"_a = estimate.n_floor,
                  "n_ceiling"_a = estimate.n_ceiling);
}

py::dict values(const ParameterPosterior& posterior) {
  using namespace py::literals;
  return py::dict("mean"_a = posterior.mean, "sd"_a = posterior.sd, "mode"_a = posterior.mode,
                  "low"_a = posterior.low, "high"_a = posterior.high);
}

/// A run of procedures whose mistakes of use are errors with a message.
class Run {
 public:
  /// @throws InvalidFile as parse_procedure
  Run(const std::string& text, const std::string& file) : run_(parse_procedure(text, file)) {}

  bool finished() const { return run_.finished(); }
  int trial() const { return open().trial(); }
  double level() const { return open().level(); }
  std::string staircase() const { return open().staircase().name(); }

  /// @param answer whether it is positive, or the choice: "comparison", "reference" or "none"
  /// @return the reversal, or None
  std::optional<py::dict> respond(const std::variant<bool, std::string>& answer,
                                  std::optional<double> level);
  void void_trial() {
    open();
    run_.void_trial();
  }

  std::vector<std::string> names() const;
  int n_trials(const std::string& name) const { return procedure(name).n_trials(); }
  std::optional<std::string> stopped_by(const std::string& name) const;
  py::list estimates(const std::string& name) const;
  py::dict posterior(const std::string& name) const;

 private:
  const InterleavedRun& open() const;
  const Procedure& procedure(const std::string& name) const;

  InterleavedRun run_;
};

const InterleavedRun& Run::open() const {
  if (run_.finished()) throw Error("all staircases are finished, there is no further trial");
  return run_;
}

const Procedure& Run::procedure(const std::string& name) const {
  const auto& all = run_.staircases();
  const auto found = std::ranges::find(all, name, &Procedure::name);
  if (found != all.end()) return *found;
  const std::vector<std::string> known = names();
  throw unknown_name("staircase", name, std::vector<std::string_view>(known.begin(), known.end()));
}

Response response_from(const std::variant<bool, std::string>& answer) {
  if (const bool* const positive = std::get_if<bool>(&answer)) return {*positive};
  const std::string& name = std::get<std::string>(answer);
  const auto choice = named<Choice>(name);
  if (!choice) throw unknown_name("answer", name, EnumNames<Choice>::names);
  return response_of(*choice);
}

std::optional<py::dict> Run::respond(const std::variant<bool, std::string>& answer,
                                     std::optional<double> level) {
  open();
  const Response response = response_from(answer);
  if (level && !(std::abs(*level) <= largest_level))
    throw Error(
        fmt::format("the level is {}, expected a number within +-{}", *level, largest_level));
  const Update update = run_.respond(response, level);
  return update.reversal ? std::optional(values(*update.reversal)) : std::nullopt;
}

std::vector<std::string> Run::names() const {
  std::vector<std::string> names;
  for (const Procedure& one : run_.staircases()) names.push_back(one.name());
  return names;
}

std::optional<std::string> Run::stopped_by(const std::string& name) const {
  const auto reason = procedure(name).finish();
  return reason ? std::optional(std::string(name_of(*reason))) : std::nullopt;
}

py::list Run::estimates(const std::string& name) const {
  py::list list;
  for (const Estimate& estimate : procedure(name).estimates()) list.append(values(estimate));
  return list;
}

py::dict Run::posterior(const std::string& name) const {
  py::dict parameters;
  for (const ParameterPosterior& one : procedure(name).posterior())
    parameters[py::str(one.name)] = values(one);
  return parameters;
}

using Text = std::optional<std::string>;

/// Fits as JSON, and a warning or "".
std::pair<std::string, std::string> fit(const std::string& text, const std::string& file,
                                        const std::string& model, const Text& function,
                                        const Text& scale, const Text& guess, const Text& lapse,
                                        const Text& by, const Text& person) {
  const py::gil_scoped_release others_run;
  const FittedAnswers fitted =
      fit_answers(text, file, {model, function, scale, guess, lapse, by, person});
  return {fits_as_json(fitted.fits), fitted.warning};
}

py::dict column_units() {
  py::dict units;
  for (const auto& [name, unit] : units_of_columns()) units[py::str(name)] = unit;
  return units;
}
}  // namespace

}  // namespace heft

PYBIND11_MODULE(_heft, module) {
  using namespace heft;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    }
  });
  module.attr("version") = HEFT_VERSION;
  module.def("fit", &fit, py::arg("text"), py::arg("file"), py::arg("model"), py::arg("function"),
             py::arg("scale"), py::arg("guess"), py::arg("lapse"), py::arg("by"),
             py::arg("person"));
  module.def("column_units", &column_units);
  py::class_<Run>(module, "Run")
      .def(py::init<const std::string&, const std::string&>(), py::arg("text"), py::arg("file"))
      .def_property_readonly("finished", &Run::finished)
      .def_property_readonly("trial", &Run::trial)
      .def_property_readonly("level", &Run::level)
      .def_property_readonly("staircase", &Run::staircase)
      .def("respond", &Run::respond, py::arg("answer"), py::arg("level") = py::none())
      .def("void_trial", &Run::void_trial)
      .def("names", &Run::names)
      .def("n_trials", &Run::n_trials, py::arg("name"))
      .def("stopped_by", &Run::stopped_by, py::arg("name"))
      .def("estimates", &Run::estimates, py::arg("name"))
      .def("posterior", &Run::posterior, py::arg("name"));
}
