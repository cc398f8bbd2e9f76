#pragma once
// A report as one HTML file that works offline: 3D model, pictures, plots, measurements and
// parameters (docs/reference/report.md).
//
//   PageInput input = page_input(run, report);
//   TURNSCAN_ASSIGN(const ReportPage page, make_page(input, context));
//   TURNSCAN_TRY(write_file_atomically("scan.html", page.html));

#include <cstdint>
#include <optional>
#include <string>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/evaluation/elements/elements.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/workflow/page/turn_points.hpp>
#include <vector>

namespace turnscan {

/// A mesh, metres, +y up, with per-vertex quantities. Each array has one entry per vertex, or is
/// empty: then the page has no switch for it.
struct PageObject {
  TriangleMesh mesh;
  std::vector<float> expected_error_m;   ///< NaN where it is not known
  std::vector<float> deviation_m;        ///< from the reference, positive outside
  std::vector<std::uint16_t> seen_by;    ///< number of frames
  std::vector<std::uint8_t> invented;    ///< 1: not measured
  std::optional<Evaluation> evaluation;  ///< against the reference
};

struct PageInput {
  std::string title;  ///< human-readable; any text
  std::vector<PageObject> objects;
  /// JSON of report_json(), or of a scan's report, or empty. From its `objects` the page shows
  /// `verdict` ({colour, sentences: [{topic, level, text, value, unit}]}) if present, and takes
  /// expected_error_m, seen_by and invented, one number per vertex, if the object above has none.
  std::string report;
  std::optional<ElementReport> elements;  ///< measured on the object
  std::vector<TurnPoint> turn;  ///< for the plot of the speed over the turn; empty: no plot
  int picture_px = 420;         ///< width and height of the pictures
};

struct ReportPage {
  std::string html;
  bool has_viewer = false;  ///< false: the program was built without the 3D view
};

/// All texts of the input are escaped; the page's content security policy allows its own script and
/// style, by their hashes, and nothing else. Begins the phase "page". Fails with kTooFewPoints (no
/// object, or one without triangles), kFormat as validate_mesh(), if an array's length differs from
/// the number of vertices, or if the report is not a JSON object; as render_picture() does and with
/// kCancelled.
Result<ReportPage> make_page(const PageInput& input, const RunContext& context);

/// Computes the deviation of each vertex from a reference and the evaluation, for all objects.
/// Fails as evaluate() does.
Result<> compare_with(PageInput& input, const TriangleMesh& reference,
                      const EvaluateOptions& options, const RunContext& context);

}  // namespace turnscan
