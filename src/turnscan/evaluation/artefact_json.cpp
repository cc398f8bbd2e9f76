#include <array>
#include <nlohmann/json.hpp>
#include <turnscan/evaluation/artefact.hpp>

namespace turnscan {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

Json optional_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

void add_fit(Json& json, const FitFigures& fit) {
  json["sigma_m"] = fit.sigma_m;
  json["points"] = fit.points;
  json["rejected"] = fit.rejected;
  json["left_out"] = fit.left_out;
}

Json ball_json(const BallFigures& b) {
  Json json = {{"center_m", vector_json(b.center_m)},
               {"diameter_m", b.diameter_m},
               {"probing_error_form_m", b.fit.form_m},
               {"probing_error_form95_m", b.fit.form95_m},
               {"probing_error_size_m", b.size_error_m}};
  add_fit(json, b.fit);
  json["covered"] = b.covered;
  return json;
}

Json plate_json(const PlateFigures& p) {
  Json json = {{"flatness_error_m", p.fit.form_m}, {"flatness_error95_m", p.fit.form95_m},
               {"normal", vector_json(p.normal)},  {"center_m", vector_json(p.center_m)},
               {"length_m", p.length_m},           {"width_m", p.width_m}};
  add_fit(json, p.fit);
  return json;
}

}  // namespace

std::string to_json(const ArtefactFigures& figures) {
  constexpr std::array<const char*, 4> kNames{"none", "ball", "ball-bar", "plate"};
  Json json = {{"artefact", kNames[static_cast<std::size_t>(figures.artefact)]}};
  for (const BallFigures& ball : figures.balls) json["balls"].push_back(ball_json(ball));
  if (figures.spacing) {
    const SpacingFigures& s = *figures.spacing;
    json["sphere_spacing"] = {{"measured_m", s.measured_m},
                              {"error_m", optional_json(s.error_m)},
                              {"error_fixed_diameter_m", optional_json(s.error_fixed_diameter_m)}};
  }
  if (figures.plate) json["plate"] = plate_json(*figures.plate);
  return json.dump(2) + "\n";
}

}  // namespace turnscan
