#include <nlohmann/json.hpp>
#include <turnscan/core/angles.hpp>

#include <turnscan/workflow/next_pass/next_pass_json.hpp>
#include <turnscan/workflow/next_pass/next_pass_text.hpp>

namespace turnscan::workflow {

nlohmann::ordered_json next_pass_json(const NextPassAdvice& advice) {
  using Json = nlohmann::ordered_json;
  const UnseenSurface& unseen = advice.unseen;
  Json poses = Json::array();
  for (const NextPose& pose : advice.poses) {
    Json rows = Json::array();
    const auto& m = pose.T_table_mesh.matrix();
    for (int i = 0; i < 4; ++i) rows.push_back({m(i, 0), m(i, 1), m(i, 2), m(i, 3)});
    poses.push_back({{"tip_deg", pose.tip_rad * kDegreesPerRadian},
                     {"towards_deg", pose.towards_rad * kDegreesPerRadian},
                     {"shows_cm2", pose.shows_m2 * 1e4},
                     {"overlap_cm2", pose.overlap_m2 * 1e4},
                     {"stands", pose.stands},
                     {"lift_mm", pose.lift_m * 1e3},
                     {"T_table_mesh", std::move(rows)}});
  }
  return {{"surface_cm2", unseen.surface_m2 * 1e4}, {"unseen_cm2", unseen.unseen_m2() * 1e4},
          {"base_cm2", unseen.base_m2 * 1e4},       {"underside_cm2", unseen.underside_m2 * 1e4},
          {"sides_cm2", unseen.sides_m2 * 1e4},     {"top_cm2", unseen.top_m2 * 1e4},
          {"advice", next_pass_text(advice)},       {"poses", std::move(poses)}};
}

}  // namespace turnscan::workflow
