#include "analysis/ReportPage.h"

#include <fmt/format.h>

#include "analysis/Charts.h"
#include "analysis/Tables.h"

namespace heft {

namespace {
constexpr std::string_view style = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #222; max-width: 72rem; margin: 2rem auto;
       padding: 0 1rem; }
table { border-collapse: collapse; font-size: 0.85rem; display: block; overflow-x: auto; }
th, td { padding: 0.2rem 0.6rem; border-bottom: 1px solid #ddd; text-align: left; }
td.n { text-align: right; font-variant-numeric: tabular-nums; }
.note, .made { color: #666; font-size: 0.85rem; }
.simulated { background: #fff3d6; border-left: 4px solid #d79b00; padding: 0.4rem 0.8rem; }
svg { max-width: 100%; height: auto; }
)";

// An SVG without what stands before its element: inside HTML that is not allowed.
std::string_view svg_element(std::string_view svg) {
  const auto start = svg.find("<svg");
  return start == std::string_view::npos ? std::string_view() : svg.substr(start);
}

std::string hypotheses_html(const Summary& summary) {
  std::string html = "<h2>Hypotheses and the figures that speak to them</h2>\n<dl>\n";
  for (const Hypothesis& hypothesis : summary.hypotheses) {
    html += fmt::format("<dt><b>{}</b>: {}</dt>\n", hypothesis.name,
                        html_escaped(hypothesis.statement));
    for (const std::string& figure : hypothesis.figures)
      html += fmt::format("<dd>{}</dd>\n", html_escaped(figure));
  }
  return html + "</dl>\n";
}
}  // namespace

std::string report_page(const Summary& summary, const std::vector<DrawnChart>& charts) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<title>Heft report</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<h1>Heft report</h1>\n<p>{}</p>\n",
      style, html_escaped(headline(summary)));
  for (const std::string& note : summary.notes)
    html += fmt::format("<p class=\"{}\">{}</p>\n", summary.simulated() ? "simulated" : "note",
                        html_escaped(note));
  for (const DrawnChart& chart : charts) html += fmt::format("<p>{}</p>\n", svg_element(chart.svg));
  if (charts.empty()) html += "<p class=\"note\">No charts were drawn.</p>\n";
  html += "<h2>Tables</h2>\n";
  for (const Table& table : tables_of(summary)) html += as_html(table);
  html += hypotheses_html(summary);
  html += fmt::format("<p class=\"made\">{}</p>\n</body>\n</html>\n",
                      html_escaped(caption_of(summary)));
  return html;
}

}  // namespace heft
