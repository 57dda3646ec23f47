// heft power: what a study of a protocol can be expected to find.
#include "population/Power.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <thread>

#include "base/Error.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "protocol/readers/Files.h"
#include "protocol/study/StudyPlan.h"

namespace heft::cli {

namespace {
namespace fs = std::filesystem;

struct PowerOptions {
  std::string file, chart;  // file: a protocol or a study plan
  std::vector<ResponderChoice> models;
  std::vector<ProtocolSetting> set;
  std::vector<int> participants;  // empty: the default
  std::string level = "surrogate";
  std::optional<std::int64_t> confirm;
  int studies = 100;
  int jobs = 1;
  std::optional<std::uint64_t> seed;
  bool json = false, tables = false;
};

// A protocol and the numbers of people that take part by it.
struct Design {
  std::string protocol;
  std::vector<int> participants;
};

// Those of a study plan are its groups, those with the same protocol together.
std::vector<Design> planned_designs(const std::string& file) {
  if (recognized_kind(read_text_file(file), file) != FileKind::study) return {{file, {8, 13, 20}}};
  const StudyPlan plan = load_study(file);
  std::map<std::string, int> planned;
  for (int number = 1; number <= plan.participants; ++number)
    ++planned[plan.groups[static_cast<std::size_t>(place_in(plan, number).group)].protocol];
  std::vector<Design> designs;
  for (const auto& [protocol, n] : planned) designs.push_back({protocol, {n}});
  return designs;
}

std::vector<Design> designs_of(const PowerOptions& options) {
  std::vector<Design> designs = planned_designs(options.file);
  if (!options.participants.empty())
    for (Design& design : designs) design.participants = options.participants;
  return designs;
}

// "8,13,20"
std::vector<int> read_sizes(const std::string& text) {
  std::vector<int> sizes;
  for (const char *at = text.data(), *end = at + text.size(); at <= end;) {
    int n = 0;
    const auto [after, error] = std::from_chars(at, end, n);
    if (error != std::errc() || n < 1 || n > 10000 || (after != end && *after != ','))
      throw Error(fmt::format("--participants {}: expected numbers from 1 to 10000 with commas "
                              "between, such as 8,13,20",
                              text),
                  ExitCode::usage);
    sizes.push_back(n);
    at = after + 1;
  }
  return sizes;
}

// A folder that exists as long as this object.
class WorkFolder {
 public:
  WorkFolder() : path_(fs::temp_directory_path() / fmt::format("heft-power-{}", ::getpid())) {
    fs::create_directories(path_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

// The studies of one model. Of one seed they have the same people at every level.
Power power_of_model(const PowerOptions& options, const Design& design, const Protocol& protocol,
                     const ResponderChoice& model, const std::string& level, std::uint64_t seed) {
  SessionOptions given;
  given.responder = model;
  given.tracker = Plug{level};
  given.settings = options.set;
  given.protocol_file = design.protocol;
  const WorkFolder folder;
  const PowerRequest request{resolve(given, protocol, seed), design.participants, options.studies,
                             options.jobs, folder.path()};
  ProgressBar bar(fmt::format("{} ({})", to_text(model), level));
  const auto progress = [&](double done) {
    bar.update(done, fmt::format("{:.0f} of {} studies", done * options.studies, options.studies));
  };
  const StopOnSignal stop;
  auto power = power_of(request, progress, stop.requested());
  if (!power) throw Error("stopped before the last study", ExitCode::interrupted);
  return std::move(*power);
}

std::vector<ModelPower> powers_of(const PowerOptions& options, const Design& design,
                                  std::uint64_t seed) {
  const Protocol protocol = load_protocol(design.protocol, options.set);
  std::vector<ModelPower> all;
  for (const ResponderChoice& model : options.models) {
    all.push_back({protocol.name, to_text(model), seed, options.level,
                   power_of_model(options, design, protocol, model, options.level, seed),
                   std::nullopt});
    if (!options.confirm) continue;
    const Design confirmed{design.protocol, {static_cast<int>(*options.confirm)}};
    all.back().whole =
        power_of_model(options, confirmed, protocol, model, "hand", seed).sizes.front();
  }
  return all;
}

void print_powers(const PowerOptions& options, const std::vector<Design>& designs) {
  const std::uint64_t seed = options.seed ? *options.seed : fresh_seed();
  std::vector<ModelPower> all;
  for (const Design& design : designs)
    std::ranges::move(powers_of(options, design, seed), std::back_inserter(all));
  if (!options.chart.empty()) draw_power(all.front(), options.chart);
  if (options.json) return fmt::print("{}", as_json(all));
  for (const ModelPower& found : all) {
    if (&found != &all.front()) print("\n");
    print_power(found, options.tables);
  }
  if (!options.chart.empty()) print("chart: {}\n", options.chart);
}

void check(const PowerOptions& options, const std::vector<Design>& designs) {
  const auto refuse = [](const char* why) { throw Error(why, ExitCode::usage); };
  for (const ResponderChoice& model : options.models)
    if (std::holds_alternative<Person>(model))
      refuse("--model human: power comes from simulated people; expected a model");
  if (options.confirm && options.level == "hand")
    refuse("--confirm has no effect with --level hand: all studies are whole sessions");
  for (const Design& design : designs)
    if (options.confirm && !std::ranges::count(design.participants, *options.confirm))
      refuse("--confirm: expected one of the sizes of --participants");
  if (options.json && options.tables) refuse("--tables has no effect with --json");
  if (!options.chart.empty() && !options.chart.ends_with(".svg"))
    refuse("--chart: expected a file that ends in .svg");
  if (!options.chart.empty() && options.models.size() > 1) refuse("--chart shows one --model");
  if (!options.chart.empty() && designs.size() > 1)
    refuse("--chart shows one protocol; give a protocol instead of a plan with several");
}

}  // namespace

void add_power(Command& app) {
  const auto options = std::make_shared<PowerOptions>();
  Command command = app.add_command(
      "power", "what a study can be expected to find, by number of participants",
      {"heft power protocols/paper.toml",
       "heft power protocols/recommended.toml --participants 10,20,40 --studies 200 --chart "
       "power.svg",
       "heft power protocols/jnd.toml --participants 8,13 --confirm 13",
       "heft power study/STUDY.toml --studies 200",
       "heft power protocols/jnd.toml --model simulated:mine.toml --model coin --json"});
  command
      .add_option("PROTOCOL", &options->file,
                  "a protocol file, or a study plan: the protocols of its groups, in their own "
                  "order of blocks")
      .required();
  const auto read_model = [options](const std::string& text) {
    from_text(text, options->models.emplace_back());
  };
  command.add_option("--model", ReadsText{read_model, true},
                     "NAME or NAME:FILE ...: people like this one (heft doctor --list; default: "
                     "simulated)");
  command.add_option("--participants", ReadsText{[options](const std::string& text) {
                       options->participants = read_sizes(text);
                     }},
                     "sizes of the study, with commas between (default: 8,13,20; of a plan: "
                     "as planned)");
  command.add_option("--studies", &options->studies, "simulated studies of each size")
      .shows_default()
      .whole_number(2, 100000);
  command
      .add_option("--level", &options->level,
                  "surrogate: straight strokes alone, fast; hand: whole sessions")
      .one_of({"surrogate", "hand"})
      .shows_default();
  command
      .add_option("--confirm", &options->confirm,
                  "N, one of the sizes: the same studies of it by whole sessions, too")
      .whole_number(1, 10000);
  command.add_jobs(options->jobs, "the result does");
  command.add_seed(options->seed, "drawn and printed");
  command.add_option("--chart", &options->chart, "FILE.svg: power and precision by size");
  command.add_flag("--json", options->json, "all figures as JSON on stdout");
  command.add_flag("--tables", options->tables, "every size and figure");
  add_settings(command, options->set,
               "change a key of the protocol, such as block.comparison.catch_fraction=0.2");
  command.does([options] {
    if (options->models.empty()) options->models.push_back(Plug{"simulated"});
    const auto designs = designs_of(*options);
    check(*options, designs);
    print_powers(*options, designs);
  });
}

}  // namespace heft::cli
