// Draws on a PDF's pages by cairo: x right and y down in millimeters from the paper's top left
// corner. Cairo brings a dozen shared libraries along, which only sheets need; so it is a module by
// itself, loaded by whoever asks first.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <string>

namespace heft {

using PointMm = Eigen::Vector2d;

struct Stroke {
  double width_mm = 0.2;
  double gray = 0;  ///< 0 black ... 1 white
  bool dashed = false;
};

struct Lettering {
  double size_mm = 3;  ///< of the font
  double gray = 0;
  bool bold = false;
  bool centered = false;  ///< about the given point, else starting at it
};

class PdfPen {
 public:
  virtual ~PdfPen() = default;

  /// Black, all at once: no hairlines between neighbors.
  virtual void areas(std::span<const std::array<PointMm, 4>> corners_mm) = 0;
  virtual void lines(std::span<const PointMm> points_mm, const Stroke& stroke) = 0;
  /// @param at_mm on the base line
  virtual void text(const PointMm& at_mm, const std::string& text, const Lettering& lettering) = 0;
  virtual void next_page() = 0;
  /// @return what is wrong with the file; empty: nothing
  virtual std::string finish() = 0;
};

/// @throws Error when the file is there already or can't be written; naming the module and what is
///   wrong with it, if it can't be loaded
std::unique_ptr<PdfPen> make_pdf_pen(const std::string& path, const PointMm& paper_mm,
                                     const std::string& title);

/// What the module has.
struct SheetsModule {
  std::unique_ptr<PdfPen> (*make)(const std::string& path, const PointMm& paper_mm,
                                  const std::string& title);
};

}  // namespace heft
