// The conversation of `heft procedure`, with a procedure that no file can name.
#include <gmock/gmock.h>

#include <sstream>

#include "cli/commands/ProcedureDialog.h"
#include "psychophysics/Bisection.h"

namespace heft::cli {
namespace {

TEST(ProcedureDialog, ShowsTheIntervalOfAnEstimate) {
  std::istringstream in(R"({"response":true}
{"response":false}
)");
  std::ostringstream out;
  ProcedureDialog({1, {}, {{"own", test::Bisection(0, 100, 25)}}}, out).run(in);
  EXPECT_EQ(out.str(), R"({"event":"trial","trial":1,"staircase":"own","level":50}
{"event":"trial","trial":2,"staircase":"own","level":25}
{"event":"finished","staircase":"own","reason":"precision","estimate":37.5,"low":25,"high":50,"n_trials":2}
{"event":"done"}
)");
}

}  // namespace
}  // namespace heft::cli
