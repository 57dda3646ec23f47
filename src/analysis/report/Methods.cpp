#include "analysis/report/Methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <variant>

#include "analysis/measures/Sensitivity.h"
#include "analysis/report/Notes.h"
#include "inference/MixedIndecision.h"

namespace heft {

namespace {
struct SourceText {
  std::string_view cited, in_full;
};

constexpr std::array<SourceText, 14> sources{{
    {"Issartel et al., 2015",
     "Issartel, P., Guéniat, F., Coquillart, S., & Ammi, M. (2015). Perceiving mass in mixed "
     "reality through pseudo-haptic rendering of Newton's third law. IEEE Virtual Reality, 41–46."},
    {"Levitt, 1971",
     "Levitt, H. (1971). Transformed up-down methods in psychoacoustics. Journal of the Acoustical "
     "Society of America, 49, 467–477."},
    {"Kaernbach, 1991",
     "Kaernbach, C. (1991). Simple adaptive testing with the weighted up-down method. Perception & "
     "Psychophysics, 49, 227–229."},
    {"Watson & Pelli, 1983",
     "Watson, A. B., & Pelli, D. G. (1983). QUEST: a Bayesian adaptive psychometric method. "
     "Perception & Psychophysics, 33, 113–120."},
    {"Watson, 2017",
     "Watson, A. B. (2017). QUEST+: a general multidimensional Bayesian adaptive psychometric "
     "method. Journal of Vision, 17(3), 10."},
    {"Kontsevich & Tyler, 1999",
     "Kontsevich, L. L., & Tyler, C. W. (1999). Bayesian adaptive estimation of psychometric slope "
     "and threshold. Vision Research, 39, 2729–2737."},
    {"Christensen, Lee & Brockhoff, 2012",
     "Christensen, R. H. B., Lee, H.-S., & Brockhoff, P. B. (2012). Estimation of the Thurstonian "
     "model for the 2-AC protocol. Food Quality and Preference, 24, 119–128."},
    {"García-Pérez & Alcalá-Quintana, 2017",
     "García-Pérez, M. A., & Alcalá-Quintana, R. (2017). The indecision model of psychophysical "
     "performance in dual-presentation tasks: parameter estimation and comparative analysis of "
     "response formats. Frontiers in Psychology, 8, 1142."},
    {"Pinheiro & Bates, 1995",
     "Pinheiro, J. C., & Bates, D. M. (1995). Approximations to the log-likelihood function in the "
     "nonlinear mixed-effects model. Journal of Computational and Graphical Statistics, 4, 12–35."},
    {"Tobin, 1958",
     "Tobin, J. (1958). Estimation of relationships for limited dependent variables. Econometrica, "
     "26, 24–36."},
    {"Korn & Graubard, 1998",
     "Korn, E. L., & Graubard, B. I. (1998). Confidence intervals for proportions with small "
     "expected number of positive counts estimated from survey data. Survey Methodology, 24, "
     "193–201."},
    {"Stevens, 1957",
     "Stevens, S. S. (1957). On the psychophysical law. Psychological Review, 64, 153–181."},
    {"Thurstone, 1927",
     "Thurstone, L. L. (1927). A law of comparative judgment. Psychological Review, 34, 273–286."},
    {"Chandler & Bate, 2007",
     "Chandler, R. E., & Bate, S. (2007). Inference for clustered data using the independence "
     "loglikelihood. Biometrika, 94, 167–183."},
}};

const SourceText& text_of(Source source) {
  return sources.at(static_cast<std::size_t>(source));
}

std::string limits_of(const ExclusionRules& rules) {
  std::vector<std::string> limits;
  if (rules.unfinished) limits.emplace_back("an unfinished session");
  const auto add = [&](const std::optional<double>& most, std::string_view what) {
    if (most) limits.push_back(fmt::format("more than {:g} % {}", 100 * *most, what));
  };
  add(rules.anticipatory_responses, "anticipatory responses");
  add(rules.false_alarms, "false alarms in catch trials");
  add(rules.out_of_view, "of attempts with the effector out of view");
  return listed(limits);
}

std::string exclusions(const Summary& summary) {
  std::vector<std::string> rules, excluded;
  for (const RanProtocol& ran : summary.protocols)
    if (const std::string limits = limits_of(ran.protocol.exclusion);
        !limits.empty() && std::ranges::find(rules, limits) == rules.end())
      rules.push_back(limits);
  for (const auto& [rule, n] : summary.flow.excluded)
    excluded.push_back(fmt::format("{}: {}", rule, n));
  std::string text = rules.empty() ? "No rule of exclusion was declared"
                                   : fmt::format(
                                         "The protocol, written before the data were collected, "
                                         "excludes participants with {}",
                                         fmt::join(rules, "; or "));
  return text + (excluded.empty() ? ", and no one was excluded."
                                  : fmt::format("; {} excluded ({}).",
                                                summary.flow.n_asked - summary.n_participants,
                                                fmt::join(excluded, ", ")));
}

std::string people(int n, bool simulated) {
  if (!simulated) return fmt::format("{} {}", n, n == 1 ? "person" : "people");
  return counted(n, "simulated participant") +
         (n == 1 ? " (a model, no person)" : " (models, no people)");
}

std::string participants(const Summary& summary) {
  const ParticipantFlow& flow = summary.flow;
  std::string text = people(flow.n_started, summary.data == "simulated") + " took part";
  if (summary.data == "human and simulated") text += ", some of them models";
  text += fmt::format(" in {}.", counted(static_cast<int>(summary.sessions.size()), "session"));
  if (flow.n_declined > 0) text += fmt::format(" {} declined.", flow.n_declined);
  if (flow.n_withdrawn > 0)
    text += fmt::format(" The data of {} were withdrawn.", counted(flow.n_withdrawn, "session"));
  if (flow.n_finished < flow.n_started)
    text += fmt::format(" {} did not finish.", flow.n_started - flow.n_finished);
  return text + " " + exclusions(summary) +
         fmt::format(" The analysis has {}.", counted(summary.n_participants, "participant"));
}

struct LawInWords {
  const std::string& name;
  Citations& citations;

  std::string operator()(const Coupling& coupling) const {
    if (!coupling.decoupled) return fmt::format("In {}, the clone stayed on the effector.", name);
    return fmt::format(
        "In {}, a spring of {:g} N/m and {:g} N m/rad ({}) coupled the clone, of {:g} g, to the "
        "effector, so that heavier cubes held it back more ({}).",
        name, coupling.stiffness_n_per_m, coupling.torsional_stiffness_nm_per_rad,
        coupling.damping_ratio == 1 ? std::string("critically damped")
                                    : fmt::format("damping ratio {:g}", coupling.damping_ratio),
        1e3 * coupling.clone_mass_kg, citations.cite(Source::technique));
  }
  std::string operator()(const Displacement& displacement) const {
    return fmt::format("In {}, the clone was displaced from the effector: {}.", name,
                       std::visit([](const auto& law) { return law.described(); }, displacement));
  }
};

std::string apparatus(const RanProtocol& ran, Citations& citations) {
  const Protocol& protocol = ran.protocol;
  std::string text = fmt::format(
      "Participants moved a tracked effector of {:g} x {:g} x {:g} mm, whose virtual clone pushed "
      "cubes with sides of {:g} mm, {:g} mm apart. Pictures were shown at {} Hz. Movements and "
      "contacts were simulated ({}) with Coulomb friction of {:g} {} and {} contacts.",
      1e3 * protocol.effector_size_m.x(), 1e3 * protocol.effector_size_m.y(),
      1e3 * protocol.effector_size_m.z(), 1e3 * protocol.layout.cube_size_m,
      1e3 * protocol.layout.gap_m, ran.run_as.rates_hz(), ran.run_as.simulators(),
      protocol.friction,
      protocol.friction_is == FrictionIs::per_body ? "of each body" : "between two surfaces",
      protocol.contact_compliance_m_per_n == 0
          ? "rigid"
          : fmt::format("compliant ({:g} mm/N)", 1e3 * protocol.contact_compliance_m_per_n));
  for (const std::string& condition : ran.conditions) {
    try {
      const Technique technique =
          technique_named(condition, protocol.techniques, protocol.coupling);
      text += ' ';
      text += std::visit(LawInWords{condition, citations}, technique.law);
    } catch (const std::out_of_range&) {  // of a task that names conditions otherwise
    }
  }
  return text;
}

std::string of_protocol(const Summary& summary, const RanProtocol& ran, Citations& citations) {
  std::string text = apparatus(ran, citations) + " " + tasks_in_words(ran.protocol, citations);
  if (summary.protocols.size() == 1) return text;
  return fmt::format("Protocol {}, {}: {}", ran.protocol.name,
                     counted(static_cast<int>(ran.participants.size()), "participant"), text);
}

// "no attempt was", "1 attempt was", "2 attempts were"
std::string counted_were(int n, std::string_view what) {
  if (n == 0) return fmt::format("no {} was", what);
  return fmt::format("{} {}", counted(n, what), n == 1 ? "was" : "were");
}

std::string data(const Summary& summary) {
  std::map<Task, int, InTaskOrder> by_task;
  int n_completed = 0, n_void = 0, n_anticipatory = 0;
  for (const LossRow& row : summary.quality.losses) {
    if (row.n_completed > 0) by_task[row.task] += row.n_completed;
    n_completed += row.n_completed;
    n_void += row.n_void;
    n_anticipatory += row.n_anticipatory;
  }
  std::vector<std::string> counts;
  for (const auto& [task, n] : by_task) counts.push_back(fmt::format("{} {}", n, name_of(task)));
  std::string text = fmt::format(
      "{} completed ({}); {} void{}, and {} anticipatory.", counted(n_completed, "trial"),
      listed(counts), counted_were(n_void, "attempt"), n_void > 0 ? " and presented again" : "",
      counted_were(n_anticipatory, "response"));
  const auto& staircases = summary.shared->staircases.results();
  const auto n_censored = std::ranges::count_if(
      staircases, [](const StaircaseResult& one) { return !one.why.empty(); });
  if (!staircases.empty())
    text += fmt::format(" Of {} finished staircases, {} had a censored JND or none.",
                        staircases.size(), n_censored);
  return text;
}

std::string places(const std::vector<const StudyEstimate*>& rows) {
  std::vector<std::string> all;
  for (const StudyEstimate* row : rows)
    all.push_back(fmt::format("{:g} g in {} ({} of {})", *row->reference_g, row->condition,
                              counted(row->n_trials, "trial"), counted(row->n, "participant")));
  return listed(all);
}

// Begins with a space; empty: nothing was checked.
std::string model_check(const Estimates& all) {
  const std::optional<ModelVerdict> verdict = model_verdict(all);
  if (!verdict) return "";
  std::vector<std::string> missed;
  for (const StudyEstimate* check : verdict->missed)
    missed.push_back(fmt::format("{} g in {}", check->text_at("reference_g"), check->condition));
  return fmt::format(
      " The model was checked in {} simulated studies, in which people of the fitted population "
      "ran the participants' staircases: {} (smallest p = {:.3f}, for all figures together).",
      verdict->n_studies,
      missed.empty() ? "its predictions agree with the data"
                     : fmt::format("it does not predict the data at {}", listed(missed)),
      verdict->least_p);
}

std::string thresholds(const Summary& summary, Citations& citations) {
  std::vector<const StudyEstimate*> fitted, others;
  for (const StudyEstimate* one : estimates_of(summary.estimates, "threshold_75"))
    (one->value && one->n >= least_people ? fitted : others).push_back(one);
  if (fitted.empty()) return "";
  std::string text = fmt::format(
      "Discrimination thresholds are the differences at which an unbiased forced choice is 75 % "
      "correct. They are from the indecision model of three-way choices (2-AC; {}; {}), fitted at "
      "{}. The logarithms of sensitivity and criterion half-width were jointly normal over "
      "participants and the side bias was normal; all shared a lapse rate between 0 and 0.2. "
      "Random effects were integrated by adaptive Gauss-Hermite quadrature ({}). Estimates, of the "
      "median participant, are maximum likelihood with 95 % profile-likelihood intervals adjusted "
      "for the number of participants.",
      citations.cite(Source::two_ac), citations.cite(Source::indecision), places(fitted),
      citations.cite(Source::quadrature));
  text += model_check(summary.estimates);
  if (!others.empty())
    text += fmt::format(" No threshold of a population is given at {}.", places(others));
  return text;
}

// Estimators that cite nothing, by a measure of theirs.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> without_source{{
    {"forced_threshold_75",
     " Forced choices of each participant were fitted with a cumulative normal (maximum "
     "likelihood, with 2 % of the answers wrong however large the difference); thresholds are "
     "geometric means over participants with Student's t intervals of the logarithms."},
    {"same_different_threshold_75",
     " Answers \"same\" and \"different\" of each participant were fitted with the differencing "
     "model (maximum likelihood, 2 % lapses); thresholds are 0.6745 by its sensitivity, "
     "summarized by geometric means over participants with Student's t intervals of the "
     "logarithms."},
    {"adjustment_bias",
     " Of adjustments, bias (setting minus reference), spread (standard deviation of a "
     "participant's settings) and start effect (slope of settings on first masses) are means "
     "over participants with Student's t intervals; the bias in percent is a geometric mean."},
    {"judgment_mean",
     " Numbers answered to questions are means over participants of each one's mean, geometric "
     "where the question takes only numbers above 0, with Student's t intervals."},
    {"judgment_share",
     " Shares of answers to questions are of all trials, with intervals over participants as "
     "clusters."},
    {"judgment_threshold",
     " Thresholds of questions are what each participant's procedures estimated; means are "
     "those of a log-normal distribution with censored values, with a profile-likelihood "
     "interval."},
}};

std::string other_estimators(const Summary& summary, Citations& citations) {
  const Estimates& all = summary.estimates;
  std::string text;
  const auto has_method = [&](std::string_view measure, std::string_view method) {
    return std::ranges::any_of(estimates_of(all, measure),
                               [&](const StudyEstimate* one) { return one->method == method; });
  };
  const auto has_interval = [&](std::string_view measure) {
    return std::ranges::any_of(estimates_of(all, measure),
                               [](const StudyEstimate* one) { return one->low.has_value(); });
  };
  if (has_method("jnd", name_of(MeanKind::log_normal_mean)))
    text += fmt::format(
        " JNDs are summarized by the mean of a log-normal distribution with censored "
        "values ({}), with a profile-likelihood interval.",
        citations.cite(Source::tobit));
  if (find_estimate(all, "sorting_answers"))
    text += fmt::format(
        " Percentages are means over participants; their 95 % intervals are score intervals with "
        "participants as clusters ({}), or exact where all participants are equal.",
        citations.cite(Source::clustered));
  if (has_interval("perceived_distance"))
    text += fmt::format(
        " Perceived masses are from the orders of sorted cubes by Thurstone's case V ({}): "
        "maximum likelihood of whole orders, with profile-likelihood intervals scaled to the "
        "variance over participants ({}).",
        citations.cite(Source::comparative_judgment), citations.cite(Source::adjusted_likelihood));
  for (const auto& [measure, sentence] : without_source)
    if (find_estimate(all, measure)) text += sentence;
  if (find_estimate(all, "estimation_exponent"))
    text += fmt::format(
        " Magnitude estimates are geometric means over participants, and the exponent is the mean "
        "slope of log number on log mass ({}), with Student's t intervals.",
        citations.cite(Source::magnitudes));
  return text;
}

std::string analysis(const Summary& summary, Citations& citations) {
  std::vector<std::string> declared;
  for (const Hypothesis& hypothesis : summary.hypotheses)
    if (hypothesis.declared) declared.push_back(hypothesis.name);
  std::set<std::string> programs;
  for (const RanProtocol& ran : summary.protocols)
    if (const std::string of = ran.run_as.programs(); !of.empty()) programs.insert(of);
  std::string text = thresholds(summary, citations) + other_estimators(summary, citations);
  text += declared.empty() ? " No hypothesis was declared beforehand: all results are exploratory."
                           : fmt::format(" Declared beforehand: {}; other results are exploratory.",
                                         listed(declared));
  if (!programs.empty()) text += fmt::format(" Program: {}.", fmt::join(programs, "; "));
  return text.starts_with(' ') ? text.substr(1) : text;
}
}  // namespace

std::string Citations::cite(Source source) {
  if (std::ranges::find(cited_, source) == cited_.end()) cited_.push_back(source);
  return std::string(text_of(source).cited);
}

std::vector<std::string> Citations::references() const {
  std::vector<std::string> all;
  for (const Source source : cited_) all.emplace_back(text_of(source).in_full);
  std::ranges::sort(all);
  return all;
}

std::string listed(const std::vector<std::string>& items) {
  if (items.size() < 2) return items.empty() ? "" : items.front();
  return fmt::format("{} and {}", fmt::join(items.begin(), items.end() - 1, ", "), items.back());
}

std::string listed_g(const std::vector<double>& masses_g) {
  std::vector<std::string> items;
  for (const double mass_g : masses_g) items.push_back(fmt::format("{:g}", mass_g));
  return listed(items);
}

Methods methods_of(const Summary& summary) {
  if (summary.sessions.empty()) return {};
  Citations citations;
  Methods methods{{participants(summary)}, {}};
  for (const RanProtocol& ran : summary.protocols)
    methods.paragraphs.push_back(of_protocol(summary, ran, citations));
  methods.paragraphs.push_back(data(summary));
  methods.paragraphs.push_back(analysis(summary, citations));
  methods.references = citations.references();
  return methods;
}

}  // namespace heft
