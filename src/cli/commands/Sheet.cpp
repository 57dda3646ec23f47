// heft sheet: the board and the effector's cut-out net as PDF, in true millimeters.
#include "tracking/sheets/Sheet.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "base/Names.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "protocol/readers/Files.h"
#include "tracking/detection/MarkerBody.h"

namespace heft::cli {

namespace {
struct SheetOptions {
  std::string body, out, paper = "a4";
};

using LoadBody = MarkerBody (*)(const std::string& path);
using WriteSheet = void (*)(const MarkerBody& body, Paper paper, const std::string& out);

void draw(const SheetOptions& options, const char* what, LoadBody load, WriteSheet write) {
  const auto paper = named<Paper>(options.paper);
  if (!paper) throw unknown_name("paper", options.paper, EnumNames<Paper>::names);
  write(load(options.body), *paper, options.out);
  say("{}: print page 1 at 100 %, measure its ruler lines, and write their lengths into {} as\n"
      "ruler_measured_m = [0.150, 0.150] (in meters). Page 2 has the instructions for the {}.\n",
      options.out, options.body, what);
}

void add_body(Command& sheet, const char* name, const char* summary, LoadBody load,
              WriteSheet write) {
  const std::string example =
      fmt::format("heft sheet {0} --{0} protocols/apparatus/{0}.toml --out {0}.pdf", name);
  Command command = sheet.add_command(name, summary, {example});
  const auto options = std::make_shared<SheetOptions>();
  command.add_option(fmt::format("--{}", name), &options->body, fmt::format("{} file", name))
      .required();
  command.add_option("--out", &options->out, "the PDF to write, a new file").required();
  command.add_option("--paper", &options->paper, "a4 or letter").shows_default();
  command.does([=] { draw(*options, name, load, write); });
}
}  // namespace

void add_sheet(Command& app) {
  Command command = app.add_command(
      "sheet", "draw the board or the effector's net as PDF, to print",
      {"heft sheet board --board protocols/apparatus/board.toml --out board.pdf",
       "heft sheet effector --effector protocols/apparatus/effector.toml --out effector.pdf"});
  command.needs_command();
  add_body(command, "board", "the board on the table", load_board, write_board_sheet);
  add_body(command, "effector", "the effector's box, to cut out and fold", load_effector,
           write_effector_sheet);
}

}  // namespace heft::cli
