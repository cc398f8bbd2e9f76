#include <turnscan/workflow/page/page_fields.hpp>

#include <algorithm>
#include <cmath>

namespace turnscan::page {

namespace {

template <class T>
std::vector<float> scaled(const std::vector<T>& values, double scale) {
  std::vector<float> out;
  out.reserve(values.size());
  for (const T v : values) out.push_back(static_cast<float>(scale * double(v)));
  return out;
}

/// Quantile of the finite |values| of all objects.
double quantile_of_magnitude(const std::vector<PageObject>& objects, const Field& field,
                             double share) {
  std::vector<float> all;
  for (const PageObject& object : objects) {
    const std::vector<float> values = field.values(object);
    for (std::size_t v = 0; v < values.size(); ++v)
      if (std::isfinite(values[v]) && counts(field, object, v)) all.push_back(std::abs(values[v]));
  }
  if (all.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(share * double(all.size() - 1));
  std::nth_element(all.begin(), all.begin() + at, all.end());
  return all[static_cast<std::size_t>(at)];
}

/// Rounds up to 1, 1.5, 2, 3, 5 or 7 times a power of ten, so that a legend has simple numbers.
double rounded_up(double value) {
  if (!(value > 0.0)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0})
    if (factor * power >= value * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

Field expected_error() {
  Field field;
  field.id = "expected_error";
  field.label = "Expected error";
  field.noun = "expected error";
  field.help = "How far each point may be off (standard deviation)";
  field.unit = "mm";
  field.map = "viridis";
  field.of_measured = true;
  field.values = [](const PageObject& o) { return scaled(o.expected_error_m, 1e3); };
  return field;
}

Field deviation() {
  Field field;
  field.id = "deviation";
  field.label = "Deviation";
  field.noun = "deviation";
  field.help = "Distance from the reference: blue inside it, red outside";
  field.unit = "mm";
  field.map = "diverging";
  field.values = [](const PageObject& o) { return scaled(o.deviation_m, 1e3); };
  return field;
}

Field seen_by() {
  Field field;
  field.id = "seen_by";
  field.label = "Seen by";
  field.noun = "number of frames that saw it";
  field.help = "Number of frames that saw each point";
  field.unit = "frames";
  field.map = "viridis";
  field.values = [](const PageObject& o) { return scaled(o.seen_by, 1.0); };
  return field;
}

Field invented() {
  Field field;
  field.id = "invented";
  field.label = "Invented";
  field.help = "What no sensor measured and the program closed";
  field.map = "classes";
  field.classes = {"measured", "invented"};
  field.values = [](const PageObject& o) { return scaled(o.invented, 1.0); };
  return field;
}

}  // namespace

std::vector<Field> fields_of(const std::vector<PageObject>& objects) {
  std::vector<Field> fields;
  for (Field field : {expected_error(), deviation(), seen_by(), invented()}) {
    const bool known = std::any_of(objects.begin(), objects.end(),
                                   [&](const PageObject& o) { return !field.values(o).empty(); });
    if (!known) continue;
    if (field.classes.empty()) field.to = rounded_up(quantile_of_magnitude(objects, field, 0.95));
    if (field.map == "diverging") field.from = -field.to;
    fields.push_back(std::move(field));
  }
  return fields;
}

}  // namespace turnscan::page
