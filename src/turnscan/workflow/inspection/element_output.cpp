#include <turnscan/workflow/inspection/element_output.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/io/text/sheet_field.hpp>
#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan::workflow {

namespace {

using Rows = std::vector<std::vector<std::string>>;
using text::OrderedJson;

/// How a quantity is shown to people, and named in JSON.
struct Unit {
  double per_si = 1.0;
  const char* name = "";
  const char* json = "";
  int finest = 6;  ///< decimals beyond which no scan knows anything
};

Unit unit_of(Quantity quantity) {
  if (quantity == Quantity::kLength) return {1e3, "mm", "_m", 4};
  if (quantity == Quantity::kAngle) return {kDegreesPerRadian, "deg", "_rad", 4};
  return {};
}

/// Decimals that show two digits of sigma.
int decimals_of(const ElementFigure& figure, const Unit& unit) {
  const double sigma = figure.sigma.value_or(0.0) * unit.per_si;
  if (!(sigma > 0.0)) return unit.finest;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, unit.finest);
}

std::vector<std::string> figure_row(const std::string& element, const std::string& name,
                                    const ElementFigure& f) {
  const Unit unit = unit_of(f.quantity);
  const int decimals = decimals_of(f, unit);
  const double steps = std::pow(10.0, decimals);
  const auto rounded = [&](double value) {
    return std::round(value * unit.per_si * steps) / steps + 0.0;  // no negative zero
  };
  const auto shown = [&](double value) { return fmt::format("{:.{}f}", rounded(value), decimals); };
  return {element,          name,
          shown(f.value),   f.sigma ? shown(*f.sigma) : "not known",
          shown(f.nominal), fmt::format("{:+.{}f}", rounded(f.deviation()), decimals),
          unit.name};
}

std::string relation_text(const MeasuredRelation& r) {
  return fmt::format("{} of {} and {}", r.angle ? "angle" : "distance", r.of[0], r.of[1]);
}

std::string table_of(const Rows& rows, std::vector<std::size_t> left) {
  TextTable table(std::move(left));
  for (const auto& row : rows) table.add(row);
  return table.text();
}

std::string csv_line(const std::string& name, const std::string& type, const std::string& points,
                     const std::string& form, const ElementFigure& f) {
  const Unit unit = unit_of(f.quantity);
  const auto number = [&](double value) { return fmt::format("{:.7f}", value * unit.per_si); };
  return fmt::format("{},{},{},{},{},{},{},{},{},{}\n", text::sheet_field(name), type, points, form,
                     text::sheet_field(f.name), unit.name, number(f.value),
                     f.sigma ? number(*f.sigma) : "", number(f.nominal), number(f.deviation()));
}

OrderedJson figure_json(const ElementFigure& f) {
  OrderedJson out = OrderedJson::object();
  out["value"] = f.value;
  out["sigma"] = f.sigma ? OrderedJson(*f.sigma) : OrderedJson(nullptr);
  out["nominal"] = f.nominal;
  out["deviation"] = f.deviation();
  return out;
}

OrderedJson element_json(const MeasuredElement& e) {
  OrderedJson out = OrderedJson::object();
  out["name"] = e.name;
  out["type"] = elements::name_of(e.kind);
  out["points"] = e.points;
  out["form_m"] = e.form_m;
  out["rms_m"] = e.rms_m;
  for (const ElementFigure& figure : e.figures) {
    std::string key = figure.name;
    std::replace(key.begin(), key.end(), ' ', '_');
    out[key + unit_of(figure.quantity).json] = figure_json(figure);
  }
  return out;
}

OrderedJson relation_json(const MeasuredRelation& r) {
  OrderedJson out = OrderedJson::object();
  out["name"] = r.figure.name;
  out["type"] = r.angle ? "angle" : "distance";
  out["of"] = r.of;
  out[r.angle ? "angle_rad" : "distance_m"] = figure_json(r.figure);
  return out;
}

}  // namespace

Rows element_rows(const ElementReport& report) {
  Rows rows{{"element", "type", "points", "form in mm", "rms in mm"}};
  for (const MeasuredElement& e : report.elements) {
    if (e.points == 0) continue;  // an intersection
    rows.push_back({e.name, std::string(elements::name_of(e.kind)), fmt::format("{}", e.points),
                    fmt::format("{:.4f}", e.form_m * 1e3), fmt::format("{:.4f}", e.rms_m * 1e3)});
  }
  return rows;
}

Rows figure_rows(const ElementReport& report) {
  Rows rows{{"of", "figure", "value", "sigma", "nominal", "deviation", "unit"}};
  for (const MeasuredElement& e : report.elements)
    for (const ElementFigure& figure : e.figures)
      rows.push_back(figure_row(e.name, figure.name, figure));
  for (const MeasuredRelation& r : report.relations)
    rows.push_back(figure_row(r.figure.name, relation_text(r), r.figure));
  return rows;
}

std::string elements_text(const ElementReport& report) {
  return table_of(element_rows(report), {0, 1}) + "\n" + table_of(figure_rows(report), {0, 1, 6}) +
         (report.T_datum_mesh ? "Coordinates are those of the datum frame\n" : "");
}

std::string elements_csv(const ElementReport& report) {
  std::string text = "element,type,points,form_mm,figure,unit,value,sigma,nominal,deviation\n";
  for (const MeasuredElement& e : report.elements) {
    const bool measured = e.points > 0;
    for (const ElementFigure& figure : e.figures)
      text += csv_line(e.name, std::string(elements::name_of(e.kind)),
                       measured ? fmt::format("{}", e.points) : "",
                       measured ? fmt::format("{:.7f}", e.form_m * 1e3) : "", figure);
  }
  for (const MeasuredRelation& r : report.relations) {
    ElementFigure figure = r.figure;
    figure.name = relation_text(r);
    text += csv_line(r.figure.name, r.angle ? "angle" : "distance", "", "", figure);
  }
  return text;
}

std::string elements_json(const ElementReport& report) {
  OrderedJson out = OrderedJson::object();
  out["elements"] = OrderedJson::array();
  for (const MeasuredElement& e : report.elements) out["elements"].push_back(element_json(e));
  out["relations"] = OrderedJson::array();
  for (const MeasuredRelation& r : report.relations) out["relations"].push_back(relation_json(r));
  out["T_datum_mesh"] = report.T_datum_mesh ? text::json_of(*report.T_datum_mesh) : OrderedJson();
  return text::json_text(out);
}

}  // namespace turnscan::workflow
