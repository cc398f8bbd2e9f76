#pragma once
// Plots as plain SVG, each with its values as an accessible table.

#include <optional>
#include <string>
#include <vector>

namespace turnscan::page {

struct Series {
  std::string name;
  std::vector<double> y;  ///< as many as the plot's x; NaN: no value
};

struct Plot {
  enum class Kind { kBars, kLines };
  std::string title;
  std::string description;  ///< one sentence that describes the content
  std::string x_label, y_label;
  Kind kind = Kind::kLines;
  std::vector<double> x;  ///< ascending; for bars their centres, evenly spaced
  std::vector<Series> series;
  std::optional<std::size_t> marked;  ///< a value of the first series that gets a dot
};

/// About `count` ticks at multiples of 1, 2 or 5 times a power of ten, from at or below low to at
/// or above high. low < high.
std::vector<double> ticks(double low, double high, int count);

/// A <figure>: the drawing, its caption, and an expandable table. Empty if there is nothing to
/// draw. Names and labels are escaped.
std::string svg_figure(const Plot& plot, const std::string& id);

/// The drawing alone, as a file. Empty if there is nothing to draw.
std::string svg_file(const Plot& plot);

}  // namespace turnscan::page
