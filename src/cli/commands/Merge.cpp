// heft merge: the shards of a simulation as one log.
#include <fmt/format.h>

#include <memory>

#include "base/Error.h"
#include "base/Names.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "session/Shards.h"

namespace heft::cli {

namespace {

void merge(const MergeRequest& request) {
  const StopOnSignal stop;
  MergeResult result;
  {
    ProgressBar bar("merging");
    result = merge_shards(
        request, [&](const char* what, double done) { bar.update(done, what); }, stop.requested());
  }
  const std::string stored = counted(result.n_participants, "participant");
  if (result.n_participants < result.n_expected)
    throw Error(fmt::format("stopped; {} in {}; the same command continues", stored, request.db),
                ExitCode::interrupted);
  say("{} in {}, {} of them new; head of the log: {}\n", stored, request.db, result.n_new,
      short_head(result.head));
  say("results: heft analyse --db {}\n", shell_quoted(request.db));
}

}  // namespace

void add_merge(Command& app) {
  const auto request = std::make_shared<MergeRequest>();
  Command command = app.add_command("merge", "join the shards of a simulation to one log",
                                    {"heft merge all.db shard-*.db"});
  command
      .add_option("DB", &request->db,
                  "the log that one run would have written; new, or left by the same command")
      .required();
  command.add_option("SHARDS", &request->shards, "logs of heft simulate --shard I/N, all N")
      .required();
  command.does([request] { merge(*request); });
}

}  // namespace heft::cli
