// The methods of a report: their numbers are those of the study and of the protocol that it ran.
#include "analysis/report/Methods.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "SourceFolder.h"
#include "analysis/Analysis.h"
#include "analysis/MadeUpChoosers.h"
#include "analysis/report/Report.h"
#include "base/files/TextFile.h"

namespace heft {
namespace {

using namespace made_up;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::string all_of(const Methods& methods) {
  return fmt::format("{}", fmt::join(methods.paragraphs, "\n"));
}

SessionData session_of(const std::string& protocol, int number) {
  SessionData data = session(number, fmt::format("P{:02}", number));
  const Protocol ran = load_protocol(source_folder() + "/protocols/" + protocol);
  data.session.header.protocol_name = ran.name;
  data.session.header.protocol_text = ran.text;
  data.session.header.protocol_sha256 = ran.sha256;
  data.setups[0].setup.simulator = "boxes";
  data.setups[0].setup.heft_version = "0.1.0";
  return data;
}

Summary papers_study(const std::vector<ProtocolSetting>& settings = {}) {
  RandomStream stream(3, "methods");
  std::vector<SessionData> sessions;
  for (int i = 1; i <= 13; ++i) {
    SessionData data = session_of("paper.toml", i);
    data.setups[0].setup.settings = settings;
    add_sortings(data, "C1", "incorrect", 5);
    add_sortings(data, "C2", "correct", 5);
    compare(data, Population{150}.draw(stream), papers_at(200), stream);
    for (Attempt& attempt : data.attempts)
      if (attempt.trial.plan.condition.empty()) attempt.trial.plan.condition = "C2";
    sessions.push_back(data);
  }
  return summarize({"x.db", sessions}, "");
}

TEST(Methods, CountModelsApartFromPeople) {
  Summary summary = papers_study();
  summary.data = "simulated";
  for (const auto& [n, who] :
       {std::pair(1, "1 simulated participant (a model, no person) took part"),
        {2, "2 simulated participants (models, no people) took part"}}) {
    summary.flow.n_started = n;
    EXPECT_THAT(methods_of(summary).paragraphs.at(0), StartsWith(who));
  }
}

TEST(Methods, HaveThePapersNumbers) {
  const Methods methods = methods_of(papers_study());
  EXPECT_THAT(methods.paragraphs.at(0), AllOf(StartsWith("13 people took part in 13 sessions."),
                                              HasSubstr("No rule of exclusion was declared, and no "
                                                        "one was excluded."),
                                              HasSubstr("The analysis has 13 participants.")));
  for (const char* part :
       {"90 x 40 x 40 mm", "sides of 35 mm, 45 mm apart", "at 15 Hz", "(boxes at 240 Hz)",
        "friction of 0.8 between two surfaces and rigid contacts",
        "In C1, the clone stayed on the effector.",
        "In C2, a spring of 50 N/m and 150 N m/rad (critically damped) coupled the clone, of 10 g",
        "(Issartel et al., 2015)", "two cubes (15 and 800 g, in C2)",
        "3 cubes of 15, 200 and 800 g", "in 10 trials (5 in C1 and 5 in C2, in random order)",
        "A break of at least 60 s",
        "3 up-down staircases (Levitt, 1971): 15 g from 175 g, steps 50 "
        "g, halved every 2 reversals; 200 g from 600 g, steps 150 g, halved every 2 reversals; 800 "
        "g from 700 g, steps 200 g, halved every 2 reversals.",
        "decreased after each choice of either cube and increased after each answer \"no "
        "difference\", between 0 and 1500 g. A staircase ended after 10 reversals, or after 60 "
        "trials; its JND is the mean difference at all reversals but the first 2.",
        "run in random order"})
    EXPECT_THAT(methods.paragraphs.at(1), HasSubstr(part));
  EXPECT_THAT(methods.paragraphs.at(2),
              AllOf(HasSubstr("130 sorting"), HasSubstr("Of 13 finished staircases")));
  EXPECT_THAT(methods.paragraphs.at(3),
              AllOf(HasSubstr("participants as clusters (Korn & Graubard, 1998)"),
                    HasSubstr("No hypothesis was declared"), HasSubstr("Program: heft 0.1.0")));
  EXPECT_THAT(methods.references,
              AllOf(Contains(StartsWith("Issartel, P.")), Contains(StartsWith("Levitt, H. (1971)")),
                    Not(Contains(StartsWith("Kaernbach"))), Not(Contains(StartsWith("Stevens")))));
}

TEST(Methods, CountWhatWasVoidAndAnticipatory) {
  SessionData data = session_of("paper.toml", 1);
  add_sortings(data, "C1", "incorrect", 5);
  for (Attempt& attempt : data.attempts) {
    attempt.trial.shown_s = attempt.trial.first_contact_s = 0;
    attempt.trial.validated_s = 5;
  }
  const auto counts = [&] { return methods_of(summarize({"x.db", {data}}, "")).paragraphs.at(2); };
  EXPECT_THAT(counts(), HasSubstr("5 trials completed (5 sorting); no attempt was void, and no "
                                  "response was anticipatory."));
  data.attempts[0].trial.status = TrialStatus::voided;
  EXPECT_THAT(counts(), HasSubstr("1 attempt was void and presented again, and no response was"));
  data.attempts[1].trial.status = TrialStatus::voided;
  for (const std::size_t i : {2UL, 3UL}) data.attempts[i].trial.validated_s = 0.1;
  EXPECT_THAT(counts(), HasSubstr("2 attempts were void and presented again, and 2 responses were "
                                  "anticipatory."));
}

TEST(Methods, HaveTheModelThatWasFitted) {
  const Summary summary = papers_study();
  const StudyEstimate* threshold = find_estimate(summary.estimates, "threshold_75");
  ASSERT_TRUE(threshold && threshold->value);
  EXPECT_THAT(methods_of(summary).paragraphs.back(),
              AllOf(HasSubstr(fmt::format("fitted at 200 g in C2 ({} trials of 13 participants)",
                                          threshold->n_trials)),
                    HasSubstr("Gauss-Hermite quadrature (Pinheiro & Bates, 1995)"),
                    HasSubstr("profile-likelihood intervals"), HasSubstr("(Tobin, 1958)")));
}

// --set changes what was run.
TEST(Methods, HaveWhatWasSet) {
  const std::string text = all_of(methods_of(
      papers_study({{"coupling.stiffness_n_per_m", "75"}, {"physics.friction", "0.64"}})));
  EXPECT_THAT(text, AllOf(HasSubstr("a spring of 75 N/m"), HasSubstr("friction of 0.64")));
}

TEST(Methods, OfForcedChoicesSayHowTheseWereMade) {
  std::vector<SessionData> sessions;
  for (int i = 1; i <= 4; ++i) sessions.push_back(session_of("examples/forced_choice.toml", i));
  for (SessionData& data : sessions)
    add_comparison(data, "constant", 200, 80).answers_offered = ComparisonAnswers::heavier;
  const Methods methods = methods_of(summarize({"x.db", sessions}, ""));
  const std::string text = all_of(methods);
  for (const char* part :
       {"4 people took part", "on balanced sides, and chose the heavier one",
        "200 g from 200 g, steps 80, 40, 20 g",
        "decreased after 3 choices of the comparison in a row", "from 5 g",
        "ended after 6 reversals, or after 40 trials",
        "the method of constant stimuli: constant levels -160, -80, -40, 40, 80, 160 g, each 4 "
        "times"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(text, AllOf(Not(HasSubstr("indecision model")), Not(HasSubstr("sorted"))));
}

TEST(Methods, NameABayesianProcedureAndItsSource) {
  const std::string text =
      all_of(methods_of(summarize({"x.db", {session_of("recommended.toml", 1)}}, "")));
  EXPECT_THAT(text, HasSubstr("at 15 g by Psi (Kontsevich & Tyler, 1999): function indecision, "));
  EXPECT_THAT(text, Not(HasSubstr("interval width none")));
}

TEST(Methods, ListWhoWasExcludedAndByWhichRule) {
  std::vector<SessionData> sessions;
  for (int i = 1; i <= 6; ++i) {
    SessionData& data = sessions.emplace_back(session_of("paper.toml", i));
    data.exclusion.unfinished = true;
    data.session.header.protocol_text += "\n[exclusion]\nunfinished = true\n";
    add_sortings(data, "C2", "correct", 5);
  }
  sessions[2].session.state = SessionState::aborted;
  const Methods methods = methods_of(summarize({"x.db", sessions}, ""));
  EXPECT_THAT(methods.paragraphs.at(0),
              AllOf(HasSubstr("6 people took part"), HasSubstr("1 did not finish."),
                    HasSubstr("excludes participants with an unfinished session"),
                    HasSubstr("1 excluded (no finished session: 1)"),
                    HasSubstr("The analysis has 5 participants.")));
}

TEST(Methods, OfSeveralProtocolsHaveAParagraphEach) {
  std::vector<SessionData> sessions{session_of("paper.toml", 1), session_of("jnd.toml", 2)};
  for (SessionData& data : sessions) add_sortings(data, "C2", "correct", 1);
  const Methods methods = methods_of(summarize({"x.db", sessions}, ""));
  EXPECT_EQ(methods.paragraphs.size(), 5u);
  EXPECT_THAT(methods.paragraphs.at(2), StartsWith("Protocol jnd, 1 participant: "));
  EXPECT_THAT(methods_of(summarize({"x.db", {}}, "")).paragraphs, IsEmpty());
}

}  // namespace
}  // namespace heft
