#pragma once
// What is known of each vertex, as the viewer's switches and the plots take it.

#include <functional>
#include <string>
#include <turnscan/workflow/page/page.hpp>
#include <vector>

namespace turnscan::page {

struct Field {
  std::string id;     ///< in the viewer's data
  std::string label;  ///< of the switch
  std::string noun;   ///< within a sentence
  std::string help;   ///< of the legend
  std::string unit;
  std::string map;                   ///< web/colors.js
  std::vector<std::string> classes;  ///< of values that are kinds
  double from = 0.0, to = 1.0;       ///< range of the colours, in the unit
  /// Range and plots are of what was measured: how far off the rest may be says nothing of the
  /// scan.
  bool of_measured = false;
  /// Per vertex of an object in the unit, NaN where it is not known; empty: not known at all.
  std::function<std::vector<float>(const PageObject&)> values;
};

/// Whether a vertex counts for range and plots.
inline bool counts(const Field& field, const PageObject& object, std::size_t vertex) {
  return !field.of_measured || vertex >= object.invented.size() || object.invented[vertex] == 0;
}

/// Those that any object has.
std::vector<Field> fields_of(const std::vector<PageObject>& objects);

}  // namespace turnscan::page
