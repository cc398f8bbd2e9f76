#pragma once
// Plots as plain SVG, each with its figures as a table for those who cannot see it.

#include <string>
#include <vector>

namespace turnscan::page {

struct Series {
  std::string name;
  std::vector<double> y;  ///< as long as the plot's x; NaN: no value there
};

struct Plot {
  enum class Kind { kBars, kLines };
  std::string title;
  std::string description;  ///< a sentence: what it shows
  std::string x_label, y_label;
  Kind kind = Kind::kLines;
  std::vector<double> x;  ///< ascending; of bars their middles, evenly spaced
  std::vector<Series> series;
};

/// Ticks at 1, 2 or 5 times a power of ten, about `count` of them from low to high; their ends lie
/// at or beyond low and high. low < high.
std::vector<double> ticks(double low, double high, int count);

/// A <figure>: the drawing, its caption, and a table that can be opened. Empty when there is
/// nothing to draw. Names and labels are escaped.
std::string svg_figure(const Plot& plot, const std::string& id);

}  // namespace turnscan::page
