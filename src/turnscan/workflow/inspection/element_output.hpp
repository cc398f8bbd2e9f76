#pragma once
// What was measured of elements, as tables.

#include <string>
#include <turnscan/evaluation/elements/elements.hpp>
#include <vector>

namespace turnscan::workflow {

/// Rows of texts for people, the first of which is the header: of each element its points and form;
/// and of all figures, including the relations, value, sigma, nominal and deviation. Lengths in mm,
/// angles in degrees.
std::vector<std::vector<std::string>> element_rows(const ElementReport& report);
std::vector<std::vector<std::string>> figure_rows(const ElementReport& report);

/// Both tables.
std::string elements_text(const ElementReport& report);
/// One line per figure: element,type,points,form_mm,figure,unit,value,sigma,nominal,deviation. A
/// field is empty where there is no value.
std::string elements_csv(const ElementReport& report);
/// JSON text with a final newline; keys carry units. docs/reference/evaluation.md lists them.
std::string elements_json(const ElementReport& report);

}  // namespace turnscan::workflow
