#include <turnscan/workflow/page/page_sections.hpp>

#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/simulator/rendering/picture.hpp>
#include <turnscan/workflow/inspection/element_output.hpp>
#include <turnscan/workflow/page/encoding.hpp>
#include <turnscan/workflow/page/page_plots.hpp>

namespace turnscan::page {

namespace {

std::string name_of(const PageInput& input, std::size_t i) {
  const std::string& name = input.objects[i].mesh.name;
  if (!name.empty()) return name;
  return input.objects.size() == 1 ? "The object" : fmt::format("Object {}", i + 1);
}

std::string section(const std::string& id, const std::string& title, const std::string& content) {
  if (content.empty()) return "";
  return fmt::format("<section aria-labelledby=\"{}-h\">\n<h2 id=\"{}-h\">{}</h2>\n{}</section>\n",
                     id, id, title, content);
}

/// Rows of a table, the first of which is the header; cells are escaped.
class HtmlTable {
 public:
  /// With kStacked, a row becomes a list on a narrow screen, each value after its column's name.
  enum class Layout { kColumns, kStacked };

  explicit HtmlTable(std::vector<std::string> head, Layout layout = Layout::kColumns)
      : head_(std::move(head)), layout_(layout) {
    html_ = fmt::format("<div class=\"table{}\" tabindex=\"0\"><table><thead><tr>",
                        layout_ == Layout::kStacked ? " stacked" : "");
    for (const std::string& cell : head_)
      html_ += fmt::format("<th scope=\"col\">{}</th>", escaped(cell));
    html_ += "</tr></thead><tbody>\n";
  }
  HtmlTable& add(const std::string& head, const std::vector<std::string>& cells) {
    html_ += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(head));
    for (std::size_t i = 0; i < cells.size(); ++i)
      html_ += layout_ == Layout::kStacked
                   ? fmt::format("<td data-name=\"{}\">{}</td>", escaped(head_.at(i + 1)),
                                 escaped(cells[i]))
                   : fmt::format("<td>{}</td>", escaped(cells[i]));
    html_ += "</tr>\n";
    rows_ = true;
    return *this;
  }
  std::string text() const { return rows_ ? html_ + "</tbody></table></div>\n" : ""; }

 private:
  std::vector<std::string> head_;
  Layout layout_;
  std::string html_;
  bool rows_ = false;
};

std::string list_of(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return "";
  std::string html = "<ul>\n";
  for (const std::string& sentence : sentences)
    html += fmt::format("<li>{}</li>\n", escaped(sentence));
  return html + "</ul>\n";
}

std::string mm(double value_m) {
  const double value = std::round(value_m * 1e6) / 1e3;
  return fmt::format("{:.3f} mm", value == 0.0 ? 0.0 : value);  // avoids a negative zero
}
std::string percent(double share) { return fmt::format("{:.1f} %", share * 100.0); }

std::string value_text(const VerdictSentence& s) {
  if (!s.value) return "";
  return s.unit.empty() ? fmt::format("{:.3g}", *s.value)
                        : fmt::format("{:.3g} {}", *s.value, s.unit);
}

std::string verdict_html(const std::string& name, const Verdict& verdict) {
  std::string html = fmt::format("<h3>{} <span class=\"badge {}\">{}</span></h3>\n", escaped(name),
                                 verdict.colour, verdict.colour);
  if (verdict.sentences.empty()) return html;
  // A narrow screen shows the rows as blocks, which a screen reader would not treat as rows without
  // these roles.
  html +=
      "<div class=\"table verdict\" tabindex=\"0\"><table role=\"table\"><thead><tr role=\"row\">"
      "<th scope=\"col\">What</th><th scope=\"col\">Rating</th><th scope=\"col\">Why</th>"
      "<th scope=\"col\">Figure</th></tr></thead><tbody>\n";
  for (const VerdictSentence& s : verdict.sentences)
    html += fmt::format(
        "<tr role=\"row\"><th scope=\"row\" role=\"rowheader\">{}</th>"
        "<td role=\"cell\"><span class=\"level {}\">{}</span></td><td role=\"cell\">{}</td>"
        "<td role=\"cell\" class=\"number\">{}</td></tr>\n",
        escaped(s.topic), s.level, s.level, escaped(s.text), escaped(value_text(s)));
  return html + "</tbody></table></div>\n";
}

struct Side {
  const char* name;
  double azimuth_deg, elevation_deg;
};
constexpr std::array<Side, 6> kSides{{{"Front", 0, 0},
                                      {"Right", 90, 0},
                                      {"Back", 180, 0},
                                      {"Left", -90, 0},
                                      {"Top", 0, 89.9},
                                      {"Bottom", 0, -89.9}}};
constexpr int kPictureSamples = 4;
constexpr int kPictureQuality = 86;

std::string tolerance_text(const std::optional<ToleranceShares>& t) {
  if (!t) return "";
  return fmt::format("{} within +-{}, {} above, {} below", percent(t->in),
                     format_quantity(t->tolerance_m, Quantity::kLength), percent(t->above),
                     percent(t->below));
}

std::string comparison_html(const std::string& name, const Evaluation& e) {
  HtmlTable table({"Figure", "Value", "Meaning"});
  table.add("Deviation, mean", {mm(e.deviation.mean), "positive: the mesh lies outside"});
  table.add("Deviation, standard deviation", {mm(e.deviation.sigma), "about the mean"});
  table.add("Deviation, 95 % of the surface",
            {fmt::format("{} to {}", mm(e.deviation.low), mm(e.deviation.high)), ""});
  if (e.tolerance)
    table.add("Tolerance", {tolerance_text(e.tolerance), "shares of the mesh's surface"});
  table.add("Accuracy, median", {mm(e.accuracy.median), "distance from the mesh to the reference"});
  table.add("Accuracy, 95th percentile", {mm(e.accuracy.p95), ""});
  table.add("Completeness, median",
            {mm(e.completeness.median), "distance from the reference to the mesh"});
  table.add("Completeness, 95th percentile", {mm(e.completeness.p95), ""});
  for (const ThresholdScore& s : e.scores)
    table.add("F at " + format_quantity(s.threshold_m, Quantity::kLength),
              {fmt::format("{:.4f}", s.f),
               fmt::format("{} of the mesh and {} of the reference are within",
                           percent(s.precision), percent(s.recall))});
  return fmt::format("<h3>{}</h3>\n", escaped(name)) + table.text();
}

/// The first row is the header.
std::string table_html(const std::vector<std::vector<std::string>>& rows) {
  HtmlTable table(rows.front());
  for (std::size_t i = 1; i < rows.size(); ++i)
    table.add(rows[i].front(), {rows[i].begin() + 1, rows[i].end()});
  return table.text();
}

}  // namespace

std::string verdict_section(const PageInput& input, const ReportFacts& facts) {
  std::string html;
  for (std::size_t i = 0; i < std::min(input.objects.size(), facts.objects.size()); ++i) {
    if (facts.objects[i].verdict)
      html += verdict_html(name_of(input, i), *facts.objects[i].verdict);
  }
  return section("verdict", "Verdict", html);
}

std::string view_section() {
  return section(
      "view-section", "The model in 3D",
      "<div id=\"view\" hidden>\n<div id=\"switches\"></div>\n"
      "<canvas id=\"model\" tabindex=\"0\" role=\"img\" aria-label=\"The model in 3D\" "
      "aria-describedby=\"view-help\"></canvas>\n"
      "<div id=\"legend\" role=\"status\" hidden></div>\n"
      "<p id=\"view-help\" class=\"soft\">Drag to turn, scroll or pinch to zoom. With the "
      "keyboard: arrow keys turn, + and - zoom, Home goes back to the first view.</p>\n"
      "<p id=\"view-status\" role=\"status\"></p>\n</div>\n"
      "<noscript><p>The 3D view needs JavaScript; the pictures below show the model from six "
      "sides.</p></noscript>\n");
}

Result<std::string> pictures_section(const PageInput& input, const RunContext& context) {
  std::vector<TriangleMesh> meshes;
  for (const PageObject& object : input.objects) meshes.push_back(object.mesh);
  std::string html = "<div class=\"pictures\">\n";
  for (const Side& side : kSides) {
    PictureOptions options;
    options.width = options.height = input.picture_px;
    options.azimuth_rad = side.azimuth_deg / kDegreesPerRadian;
    options.elevation_rad = side.elevation_deg / kDegreesPerRadian;
    options.ground = false;
    options.ambient_samples = kPictureSamples;
    TURNSCAN_TRY(context.check());
    // With a separate context: its phases are not phases of the page.
    TURNSCAN_ASSIGN(const ColorImage picture, render_picture(meshes, options, context.quiet()));
    TURNSCAN_ASSIGN(const std::string jpeg, encode_color_jpeg(picture, kPictureQuality));
    html += fmt::format(
        "<figure><img src=\"data:image/jpeg;base64,{}\" width=\"{}\" height=\"{}\" alt=\"The model "
        "seen from: {}\"><figcaption>{}</figcaption></figure>\n",
        base64(jpeg), input.picture_px, input.picture_px, side.name, side.name);
    context.advance(1);
  }
  return section("pictures", "From six sides", html + "</div>\n");
}

Result<std::string> dimensions_section(const PageInput& input, const RunContext& context) {
  HtmlTable table({"Object", "Width x height x depth", "Area", "Volume", "Triangles", "Mesh"},
                  HtmlTable::Layout::kStacked);
  for (std::size_t i = 0; i < input.objects.size(); ++i) {
    const TriangleMesh& mesh = input.objects[i].mesh;
    const MeshReport check = check_surface(mesh, context);
    TURNSCAN_TRY(context.check());
    const Vec3d size = bounds(mesh.vertices).size() * 1e3;
    table.add(
        name_of(input, i),
        {fmt::format("{:.1f} x {:.1f} x {:.1f} mm", size.x(), size.y(), size.z()),
         fmt::format("{:.1f} cm2", check.area_m2 * 1e4),
         check.closed ? fmt::format("{:.1f} cm3", check.volume_m3 * 1e6) : "not closed",
         fmt::format("{}", mesh.triangles.size()),
         check.watertight() && check.crossing_edges == 0 ? "closed and consistent" : check.text()});
  }
  return section("dimensions", "Dimensions", table.text());
}

std::string comparison_section(const PageInput& input) {
  std::string html;
  for (std::size_t i = 0; i < input.objects.size(); ++i) {
    if (input.objects[i].evaluation)
      html += comparison_html(name_of(input, i), *input.objects[i].evaluation);
  }
  return section("comparison", "Compared with the reference", html);
}

std::string elements_section(const PageInput& input) {
  if (!input.elements) return "";
  return section("elements", "Elements",
                 table_html(workflow::element_rows(*input.elements)) +
                     table_html(workflow::figure_rows(*input.elements)));
}

std::string plots_section(const PageInput& input, const ReportFacts& facts) {
  std::string html;
  const std::vector<Plot> plots = plots_of(input, fields_of(input.objects), facts);
  for (std::size_t i = 0; i < plots.size(); ++i)
    html += svg_figure(plots[i], fmt::format("plot{}", i + 1));
  if (html.empty()) return "";
  return section("plots", "Plots", "<div class=\"plots\">\n" + html + "</div>\n");
}

std::string making_section(const ReportFacts& facts) {
  std::string html;
  HtmlTable figures({"Figure", "Value"});
  for (const auto& [name, value] : facts.figures) figures.add(name, {value});
  html += figures.text();
  std::vector<std::string> notes = facts.notes;
  for (const ReportedObject& object : facts.objects)
    notes.insert(notes.end(), object.notes.begin(), object.notes.end());
  if (!notes.empty()) html += "<h3>Notes</h3>\n" + list_of(notes);
  HtmlTable parameters({"Parameter", "Value", "Why"});
  for (const Parameter& p : facts.parameters) parameters.add(p.option, {p.value, p.reason});
  if (!facts.parameters.empty()) html += "<h3>Parameters</h3>\n" + parameters.text();
  HtmlTable times({"Stage", "Seconds"});
  for (const auto& [stage, seconds] : facts.seconds)
    times.add(stage, {fmt::format("{:.2f}", seconds)});
  if (!facts.seconds.empty())
    html += "<details><summary>Time of each stage</summary>\n" + times.text() + "</details>\n";
  if (!facts.options.empty())
    html += fmt::format(
        "<details><summary>All options as they were given</summary>\n<pre>{}</pre></details>\n",
        escaped(facts.options));
  return section("making", "How it was made", html);
}

}  // namespace turnscan::page
