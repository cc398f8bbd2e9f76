#include <turnscan/workflow/verdict/residuals_json.hpp>

#include <nlohmann/json.hpp>

namespace turnscan::workflow {

namespace {

/// Rounded to a tenth of a micrometre.
double millimetres(double value_m) { return std::round(value_m * 1e7) / 1e4; }

nlohmann::ordered_json columns_of(const std::vector<FrameResidual>& residuals) {
  auto out = nlohmann::ordered_json::object();
  for (const char* name :
       {"frame", "sensor", "pass", "time_s", "off_mm", "spread_mm", "outward_mm"})
    out[name] = nlohmann::ordered_json::array();
  for (const FrameResidual& r : residuals) {
    out["frame"].push_back(r.frame);
    out["sensor"].push_back(r.sensor);
    out["pass"].push_back(r.pass);
    out["time_s"].push_back(std::isfinite(r.time_s) ? nlohmann::ordered_json(r.time_s)
                                                    : nlohmann::ordered_json());
    out["off_mm"].push_back(millimetres(r.off_m()));
    out["spread_mm"].push_back(millimetres(r.spread_m));
    out["outward_mm"].push_back(millimetres(r.outward_m));
  }
  return out;
}

}  // namespace

void put_frame_residuals(const std::vector<std::vector<FrameResidual>>& residuals,
                         nlohmann::ordered_json& report) {
  auto& objects = report["objects"];
  for (std::size_t i = 0; i < std::min(residuals.size(), objects.size()); ++i)
    if (!residuals[i].empty()) objects[i]["frame_residuals"] = columns_of(residuals[i]);
}

}  // namespace turnscan::workflow
