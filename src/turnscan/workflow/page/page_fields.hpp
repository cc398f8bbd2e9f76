#pragma once
// Per-vertex quantities for the viewer's switches and the plots.

#include <functional>
#include <string>
#include <turnscan/workflow/page/page.hpp>
#include <vector>

namespace turnscan::page {

struct Field {
  std::string id;     ///< in the viewer's data
  std::string label;  ///< label of the switch
  std::string noun;   ///< name as used within a sentence
  std::string help;   ///< explanation in the legend
  std::string unit;
  std::string map;                   ///< colour map, see web/colors.js
  std::vector<std::string> classes;  ///< labels, if the values are categories
  double from = 0.0, to = 1.0;       ///< range of the colours, in `unit`
  /// Range and plots use measured vertices only: errors elsewhere do not characterise the scan.
  bool of_measured = false;
  /// One value per vertex of an object, in `unit`; NaN where it is not known; empty: not known for
  /// the object.
  std::function<std::vector<float>(const PageObject&)> values;
};

/// Whether a vertex contributes to range and plots.
inline bool counts(const Field& field, const PageObject& object, std::size_t vertex) {
  return !field.of_measured || vertex >= object.invented.size() || object.invented[vertex] == 0;
}

/// The fields that at least one object has.
std::vector<Field> fields_of(const std::vector<PageObject>& objects);

}  // namespace turnscan::page
