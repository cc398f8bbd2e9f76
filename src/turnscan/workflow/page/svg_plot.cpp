#include <turnscan/workflow/page/svg_plot.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/workflow/page/encoding.hpp>

namespace turnscan::page {

namespace {

constexpr double kWidth = 560, kHeight = 300;
constexpr double kLeft = 62, kRight = 14, kTop = 14, kBottom = 46;
constexpr std::array<const char*, 3> kColors{"#1f5fa8", "#c2541b", "#3a7d44"};
// Distinguishable without colour.
constexpr std::array<const char*, 3> kDashes{"none", "7 4", "2 3"};
constexpr int kXTicks = 7, kYTicks = 5;

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double v) {
    if (!std::isfinite(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  bool empty() const { return !(low <= high); }
  /// The range is at least 2 % of the values: smaller variations are rounding errors and must not
  /// be magnified.
  void widen() {
    const double magnitude = std::max(std::abs(low), std::abs(high));
    if (high - low > 0.02 * magnitude) return;
    const double by = magnitude > 0.0 ? 0.05 * magnitude : 1.0;
    low -= by;
    high += by;
  }
};

std::string number(double v) { return fmt::format("{:.4g}", v == 0.0 ? 0.0 : v); }

class Drawing {
 public:
  Drawing(const Plot& plot, Extent x, Extent y) : plot_(plot) {
    y_ticks_ = ticks(y.low, y.high, kYTicks);
    x_ticks_ = ticks(x.low, x.high, kXTicks);
    x_ = x;
    y_ = {y_ticks_.front(), y_ticks_.back()};
  }

  std::string text(const std::string& id, const std::string& attributes) const {
    std::string svg = fmt::format(
        "<svg{} viewBox=\"0 0 {} {}\" role=\"img\" aria-labelledby=\"{}-t {}-d\">"
        "<title id=\"{}-t\">{}</title><desc id=\"{}-d\">{}</desc>\n",
        attributes, kWidth, kHeight, id, id, id, escaped(plot_.title), id,
        escaped(plot_.description));
    svg += axes();
    for (std::size_t s = 0; s < plot_.series.size(); ++s)
      svg += plot_.kind == Plot::Kind::kBars ? bars(plot_.series[s]) : line(s);
    if (plot_.marked)
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\"/>\n",
                         at_x(plot_.x[*plot_.marked]), at_y(plot_.series[0].y[*plot_.marked]),
                         kColors[0]);
    return svg + "</svg>\n";
  }

 private:
  double at_x(double v) const {
    return kLeft + (v - x_.low) / (x_.high - x_.low) * (kWidth - kLeft - kRight);
  }
  double at_y(double v) const {
    return kHeight - kBottom - (v - y_.low) / (y_.high - y_.low) * (kHeight - kTop - kBottom);
  }

  std::string axes() const {
    std::string svg;
    for (const double t : y_ticks_)
      svg += fmt::format(
          "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#d5d8dc\"/>"
          "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
          kLeft, at_y(t), kWidth - kRight, kLeft - 7, at_y(t) + 4, number(t));
    for (const double t : x_ticks_) {
      if (t < x_.low || t > x_.high) continue;
      svg += fmt::format(
          "<path d=\"M{:.1f} {:.1f}v5\" stroke=\"#6b7280\"/>"
          "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
          at_x(t), kHeight - kBottom, at_x(t), kHeight - kBottom + 18, number(t));
    }
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#6b7280\"/>\n", kLeft,
                       kHeight - kBottom, kWidth - kRight);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                       (kLeft + kWidth - kRight) / 2, kHeight - 8, escaped(plot_.x_label));
    svg += fmt::format(
        "<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (kTop + kHeight - kBottom) / 2, escaped(plot_.y_label));
    return svg;
  }

  std::string bars(const Series& series) const {
    const double step = plot_.x.size() > 1 ? plot_.x[1] - plot_.x[0] : 1.0;
    const double width = 0.9 * std::abs(at_x(plot_.x[0] + step) - at_x(plot_.x[0]));
    std::string svg;
    for (std::size_t i = 0; i < plot_.x.size(); ++i) {
      if (!(series.y[i] > 0.0)) continue;
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
          at_x(plot_.x[i]) - width / 2, at_y(series.y[i]), width, at_y(0.0) - at_y(series.y[i]),
          kColors[0]);
    }
    return svg;
  }

  std::string line(std::size_t s) const {
    const Series& series = plot_.series[s];
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < plot_.x.size(); ++i) {
      const bool there = std::isfinite(series.y[i]);
      if (there)
        // With h0, a point without neighbours is drawn as a dot.
        path += fmt::format("{}{:.1f} {:.1f}{}", drawing ? 'L' : 'M', at_x(plot_.x[i]),
                            at_y(series.y[i]), drawing ? "" : "h0");
      drawing = there;
    }
    return fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"{}\" "
        "stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n",
        path, kColors[s % kColors.size()], kDashes[s % kDashes.size()]);
  }

  const Plot& plot_;
  Extent x_, y_;
  std::vector<double> x_ticks_, y_ticks_;
};

/// Legend of the lines in the drawing.
std::string key(const Plot& plot) {
  if (plot.series.size() < 2) return "";
  std::string html = "<ul class=\"key\">";
  for (std::size_t s = 0; s < plot.series.size(); ++s)
    html += fmt::format(
        "<li><svg viewBox=\"0 0 34 8\" aria-hidden=\"true\"><path d=\"M1 4H33\" stroke=\"{}\" "
        "stroke-width=\"2\" stroke-dasharray=\"{}\"/></svg> {}</li>",
        kColors[s % kColors.size()], kDashes[s % kDashes.size()], escaped(plot.series[s].name));
  return html + "</ul>\n";
}

std::string table(const Plot& plot) {
  // The table is for reading: it has at most this many rows.
  constexpr std::size_t kMaxRows = 60;
  const std::size_t step = (plot.x.size() + kMaxRows - 1) / kMaxRows;
  std::string html = fmt::format(
      "<details><summary>The figures as a table</summary><table><thead><tr><th "
      "scope=\"col\">{}</th>",
      escaped(plot.x_label));
  for (const Series& series : plot.series)
    html += fmt::format("<th scope=\"col\">{}</th>",
                        escaped(series.name.empty() ? plot.y_label : series.name));
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < plot.x.size(); i += step) {
    html += fmt::format("<tr><td>{}</td>", number(plot.x[i]));
    for (const Series& series : plot.series)
      html += fmt::format("<td>{}</td>", std::isfinite(series.y[i]) ? number(series.y[i]) : "-");
    html += "</tr>\n";
  }
  return html + "</tbody></table></details>\n";
}

}  // namespace

std::vector<double> ticks(double low, double high, int count) {
  const double rough = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      step = factor * power;
      break;
    }
  }
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  std::vector<double> values;
  for (double i = first; i <= last; ++i) values.push_back(i * step);
  return values;
}

namespace {

/// The drawing within the extent of its values; empty if there is nothing to draw. attributes: of
/// its svg element.
std::string drawn(const Plot& plot, const std::string& id, const std::string& attributes) {
  Extent x, y;
  for (const double v : plot.x) x.add(v);
  for (const Series& series : plot.series)
    for (const double v : series.y) y.add(v);
  if (x.empty() || y.empty()) return "";
  if (plot.kind == Plot::Kind::kBars) {
    y.add(0.0);
    const double half = plot.x.size() > 1 ? (plot.x[1] - plot.x[0]) / 2 : 0.5;
    x.add(plot.x.front() - half);
    x.add(plot.x.back() + half);
  }
  x.widen();
  y.widen();
  return Drawing(plot, x, y).text(id, attributes);
}

}  // namespace

std::string svg_figure(const Plot& plot, const std::string& id) {
  const std::string drawing = drawn(plot, id, "");
  if (drawing.empty()) return "";
  return fmt::format(
      "<figure class=\"plot\">\n<figcaption>{}</figcaption>\n{}{}<p>{}</p>\n{}</figure>\n",
      escaped(plot.title), drawing, key(plot), escaped(plot.description), table(plot));
}

std::string svg_file(const Plot& plot) {
  return drawn(plot, "plot",
               " xmlns=\"http://www.w3.org/2000/svg\" font-family=\"sans-serif\" font-size=\"12\"");
}

}  // namespace turnscan::page
