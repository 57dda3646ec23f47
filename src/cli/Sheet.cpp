// heft sheet: the board and the effector's cut-out net as PDF, in true millimeters.
#include "tracking/Sheet.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "base/PlugTable.h"
#include "cli/Commands.h"
#include "cli/Talk.h"
#include "protocol/MarkerFile.h"

namespace heft::cli {

namespace {
struct Options {
  std::string body, out, paper = "a4";
};

Paper paper_named(const std::string& name) {
  if (const auto paper = named<Paper>(name)) return *paper;
  throw unknown_name("paper", name, EnumNames<Paper>::names);
}

void say_next_step(const Options& options, const char* what) {
  say("{}: print page 1 at 100 %, measure the ruler line, and write its length into {} as\n"
      "ruler_measured_m = 0.150 (in meters). Page 2 says what to do with the {}.\n",
      options.out, options.body, what);
}

void draw_board(const Options& options) {
  const Paper paper = paper_named(options.paper);
  write_board_sheet(load_board(options.body), paper, options.out);
  say_next_step(options, "board");
}

void draw_effector(const Options& options) {
  const Paper paper = paper_named(options.paper);
  write_effector_sheet(load_effector(options.body), paper, options.out);
  say_next_step(options, "effector");
}

void add_body(Command& sheet, const char* name, const char* summary, const char* file_summary,
              void (*draw)(const Options&)) {
  Command command = sheet.add_command(name, summary);
  const auto options = std::make_shared<Options>();
  command.add_option(fmt::format("--{}", name), &options->body, file_summary).required();
  command.add_option("--out", &options->out, "the PDF to write; none is written over").required();
  command.add_option("--paper", &options->paper, "a4 or letter").shows_default();
  command.does([options, draw] { draw(*options); });
}
}  // namespace

void add_sheet(Command& app) {
  Command command = app.add_command(
      "sheet", "draw the board or the effector's cut-out net as PDF, to print",
      {"heft sheet board --board protocols/apparatus/board.toml --out board.pdf",
       "heft sheet effector --effector protocols/apparatus/effector.toml --out effector.pdf"});
  command.needs_command();
  add_body(command, "board", "the board on the table", "board file", draw_board);
  add_body(command, "effector", "the effector's box, to cut out and fold", "effector file",
           draw_effector);
}

}  // namespace heft::cli
