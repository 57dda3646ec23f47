#include "tracking/sheets/PdfPen.h"

#include <fmt/format.h>

#include "base/Error.h"
#include "base/Module.h"
#include "base/TextFile.h"

namespace heft {

namespace {
// A sheet that was printed, measured and glued stays as it is.
void make_file(const std::string& path) {
  require_writable(path);
  if (!create_file(path, 0666))
    throw Error(
        fmt::format("{} is there already and would be written over; name another file, or remove "
                    "it first",
                    path));
}
}  // namespace

std::unique_ptr<PdfPen> make_pdf_pen(const std::string& path, const PointMm& paper_mm,
                                     const std::string& title) {
  static const auto& module = *static_cast<const SheetsModule*>(
      from_module("heft-sheets.so", "heft_sheets", "draws sheets to print"));
  make_file(path);
  return module.make(path, paper_mm, title);
}

}  // namespace heft
