// Participants, and what the figures show point by point, row for row.
#include "analysis/TableParts.h"

namespace heft {

namespace {
void add_rate(std::vector<Cell>& row, const Rate& rate) {
  row.push_back(number(rate.percent));
  row.push_back(low(rate.interval_percent));
  row.push_back(high(rate.interval_percent));
}

Table choice_list(const Summary& summary) {
  Table table{"choice_curves",
              titled("Choices by difference", summary),
              {{"reference_g", "reference g"},
               {"condition", "condition"},
               {"mean_level_g", "difference g"},
               {"n_trials", "trials"},
               {"right_percent", "right %"},
               {"right_low_percent", "low"},
               {"right_high_percent", "high"},
               {"wrong_percent", "wrong %"},
               {"wrong_low_percent", "low"},
               {"wrong_high_percent", "high"},
               {"none_percent", "no difference %"},
               {"none_low_percent", "low"},
               {"none_high_percent", "high"}},
              {},
              ""};
  for (const ChoiceBin& bin : summary.points.choices) {
    std::vector<Cell> row{mass(bin.compared.reference_g), word(bin.compared.condition),
                          number(bin.mean_level_g), count(bin.n_trials)};
    for (const Rate* rate : {&bin.right, &bin.wrong, &bin.none}) add_rate(row, *rate);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table sorting_list(const Summary& summary) {
  Table table{"sorting_by_participant",
              titled("Right sortings by participant", summary),
              {{"participant", "participant"}, {"c1_percent", "C1 %"}, {"c2_percent", "C2 %"}},
              {},
              ""};
  for (const PersonSorting& person : summary.points.sorting)
    table.rows.push_back(
        {word(person.participant), number(person.c1_percent), number(person.c2_percent)});
  return table;
}

Table detection_list(const Summary& summary) {
  Table table{"hits_and_false_alarms",
              titled("Differences seen, by participant", summary),
              {{"participant", "participant"},
               {"hits_percent", "of trials with a difference %"},
               {"n_trials", "n"},
               {"false_alarms_percent", "without %"},
               {"n_without", "n"}},
              {},
              ""};
  for (const PersonDetection& person : summary.points.detection)
    table.rows.push_back({word(person.participant), number(person.hits_percent),
                          count(person.n_trials), number(person.false_alarms_percent),
                          count(person.n_catch)});
  return table;
}

Table measured_list(std::string name, std::string_view title, std::string at, std::string unit,
                    const std::vector<Quartiles>& rows, const Summary& summary) {
  Table table{std::move(name),
              titled(title, summary),
              {{"group", "group"},
               {at, at},
               {"n", "n"},
               {"median_" + unit, "median"},
               {"lower_quartile_" + unit, "25 %"},
               {"upper_quartile_" + unit, "75 %"}},
              {},
              ""};
  for (const Quartiles& row : rows)
    table.rows.push_back({word(row.group), number(row.at), count(row.n), number(row.median, 2),
                          number(row.lower_quartile, 2), number(row.upper_quartile, 2)});
  return table;
}
}  // namespace

Table track_list(const SessionTracks& session, const Summary& summary) {
  Table table{"staircase_trials",
              titled("Every trial of every staircase", summary),
              {{"session_id", "session"},
               {"participant", "participant"},
               {"staircase", "staircase"},
               {"reference_g", "reference g"},
               {"trial", "trial"},
               {"level_g", "difference g"},
               {"chosen", "chosen"},
               {"wrong", "wrong"},
               {"reversal", "reversal"}},
              {},
              ""};
  for (const Track& track : session.tracks)
    for (std::size_t i = 0; i < track.points.size(); ++i) {
      const TrackPoint& point = track.points[i];
      table.rows.push_back({word(std::to_string(session.session_id)), word(session.participant),
                            word(track.staircase), mass(track.reference_g),
                            count(static_cast<int>(i) + 1), number(point.level_g),
                            count(point.chosen ? 1 : 0), count(point.wrong ? 1 : 0),
                            count(point.is_reversal ? 1 : 0)});
    }
  return table;
}

Table participant_list(const Summary& summary) {
  Table table{"participants",
              titled("Participants", summary),
              {{"participant", "participant"},
               {"n_sessions", "sessions"},
               {"n_finished", "finished"},
               {"n_completed", "trials"},
               {"n_impossible", "impossible answers"},
               {"n_lost", "out of view"},
               {"n_catch", "catch trials"},
               {"n_false_alarms", "false alarms"},
               {"excluded_because", "left out, because"}},
              {},
              "nobody is left out but by a rule that the protocol declares"};
  for (const ParticipantRow& row : summary.participants)
    table.rows.push_back({word(row.participant), count(row.n_sessions), count(row.n_finished),
                          count(row.n_completed), count(row.n_impossible), count(row.n_lost),
                          count(row.n_catch), count(row.n_false_alarms),
                          word(row.excluded_because)});
  return table;
}

Table label_table(const Summary& summary) {
  Table table{"labels_by_mass",
              titled("Which label which cube got, of three", summary),
              {{"condition", "condition"},
               {"cube", "cube"},
               {"lightest", "\"lightest\""},
               {"intermediate", "\"intermediate\""},
               {"heaviest", "\"heaviest\""}},
              {},
              "numbers of sorted trials, without \"I don't know\"; right answers on the diagonal"};
  constexpr std::array cubes{"lightest", "intermediate", "heaviest"};
  for (const auto& [condition, matrix] : summary.points.labels)
    for (std::size_t rank = 0; rank < cubes.size(); ++rank)
      table.rows.push_back({word(condition), word(cubes.at(rank)), count(matrix.at(rank)[0]),
                            count(matrix.at(rank)[1]), count(matrix.at(rank)[2])});
  return table;
}

std::vector<Table> point_lists(const Summary& summary) {
  const Points& points = summary.points;
  return {choice_list(summary),
          sorting_list(summary),
          detection_list(summary),
          measured_list("times_by_level", "Response times by difference", "mean_level_g", "s",
                        points.times_by_level, summary),
          measured_list("times_by_trial", "Response times over the trials", "percent_of_trials",
                        "s", points.times_by_trial, summary),
          measured_list("lag_by_mass", "Largest lag by mass", "mass_g", "mm", points.lag_by_mass,
                        summary)};
}

}  // namespace heft
