#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/simulator/rendering/picture.hpp>
#include <turnscan/workflow/plan/plan_files.hpp>

namespace turnscan::workflow {

namespace {

namespace fs = std::filesystem;

constexpr int kSide_px = 480;
constexpr double kFromBelow_rad = -35.0 * kRadiansPerDegree;
constexpr double kSeenFrom_rad = 25.0 * kRadiansPerDegree;
constexpr Rgb kBadColor{205, 30, 40}, kNeverColor{85, 85, 90};
constexpr double kYellowMedians = 3.0;
constexpr double kWorthSaying = 0.002;  // share of the surface

Rgb error_color(double share) {
  constexpr std::array<Rgb, 4> kStops{
      {{49, 84, 170}, {38, 150, 150}, {80, 180, 70}, {240, 220, 60}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto i = std::min(std::size_t(at), kStops.size() - 2);
  const auto mixed = [part = at - double(i)](std::uint8_t a, std::uint8_t b) {
    return std::uint8_t(std::lround((1.0 - part) * a + part * b));
  };
  return {mixed(kStops[i].r, kStops[i + 1].r), mixed(kStops[i].g, kStops[i + 1].g),
          mixed(kStops[i].b, kStops[i + 1].b)};
}

/// Error of each spot for the whole rig; negative: not seen.
std::vector<double> spot_errors(const PlanField& field, std::size_t object, const Rig& rig) {
  const PlanObject& it = field.objects[object];
  std::vector<planning::SpotSight> all(it.surface.spots.size());
  for (const PlanPlace& place : rig.places)
    for (const std::uint32_t q : rig.poses[object]) {
      const auto sights = sights_from(field, it, it.poses[q], place);
      for (std::size_t i = 0; i < all.size(); ++i)
        if (sights[i].chance() > 0.0f) all[i] += sights[i];
    }
  const planning::ErrorModel model;
  std::vector<double> out(all.size(), -1.0);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].seen()) out[i] = model.at(it.surface.spots[i], all[i]);
  return out;
}

std::string reason_words(Miss reason) {
  switch (reason) {
    case Miss::kReceiverBlocked:
      return "is hidden from the sensor by the object itself or the platter";
    case Miss::kEmitterBlocked:
      return "lies in the shadow of the emitter or is hidden from the second camera";
    case Miss::kGrazing:
      return "is seen at too grazing an angle";
    case Miss::kTooNear:
      return "is too near";
    case Miss::kTooFar:
      return "is too far";
    case Miss::kOutOfView:
      return "lies outside of the image";
    case Miss::kTooDark:
      return "returns too little light, or is at too grazing an angle to return any";
    default:
      return "is missed otherwise";
  }
}

}  // namespace

bool is_plan_file(const std::string& name) {
  static const std::regex written(R"(plan-[0-9]+(-[0-9]+-[A-Za-z0-9_-]*)?\.(toml|png))");
  return name == "plan.json" || std::regex_match(name, written);
}

Result<> check_plan_folder(const std::string& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return {};
  if (!fs::is_directory(folder, error))
    return fail_at(folder, ErrorCode::kAlreadyExists, "there is a file of this name; give another");
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (const std::string name = entry.path().filename().string();
        name != "trials" && !is_plan_file(name))
      return fail_at(folder, ErrorCode::kAlreadyExists,
                     "the folder has other content ({}); give an empty or a new one",
                     entry.path().filename().string());
  if (error) return fail_at(folder, ErrorCode::kIo, "cannot be read: {}", error.message());
  return {};
}

std::string unseen_sentence(const CoverageMap& map) {
  const double unseen = 1.0 - map.covered();
  if (unseen < kWorthSaying) return "Everything is seen.";
  std::vector<std::pair<double, Miss>> reasons;
  for (std::size_t m = 1; m < map.reason_m2.size(); ++m)
    if (map.reason_m2[m] >= kWorthSaying * map.area_m2)
      reasons.emplace_back(map.reason_m2[m] / map.area_m2, static_cast<Miss>(m));
  std::stable_sort(reasons.begin(), reasons.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string out = fmt::format("{:.1f} % of the surface is not seen", 100.0 * unseen);
  for (std::size_t i = 0; i < reasons.size(); ++i)
    out += fmt::format("{} {:.1f} % {}", i == 0 ? ":" : ",", 100.0 * reasons[i].first,
                       reason_words(reasons[i].second));
  const double never = map.state_m2[std::size_t(CoverageState::kUnreachable)] / map.area_m2;
  if (never >= kWorthSaying)
    out += fmt::format(
        "; {:.1f} % cannot be seen from these heights however the table turns: it "
        "takes another pass, or another height",
        100.0 * never);
  if (!map.holes.empty() && map.holes.front().area_m2 >= kWorthSaying * map.area_m2) {
    const CoverageHole& hole = map.holes.front();
    out += fmt::format(". The largest piece: {:.1f} cm2 about ({:.0f}, {:.0f}, {:.0f}) mm",
                       1e4 * hole.area_m2, 1e3 * hole.center.x(), 1e3 * hole.center.y(),
                       1e3 * hole.center.z());
  }
  return out + ".";
}

Result<ColorImage> plan_picture(const PlanField& field, std::size_t object, const Rig& rig,
                                const std::optional<double>& max_error_m,
                                const RunContext& context) {
  const PlanObject& it = field.objects[object];
  const std::vector<double> errors = spot_errors(field, object, rig);
  std::vector<double> seen;
  for (const double e : errors)
    if (e >= 0.0) seen.push_back(e);
  double median = 0.0;
  if (!seen.empty()) {
    std::nth_element(seen.begin(), seen.begin() + std::ptrdiff_t(seen.size() / 2), seen.end());
    median = seen[seen.size() / 2];
  }
  const auto color = [&](double error) -> Rgb {
    if (error < 0.0) return kNeverColor;
    if (max_error_m && error > *max_error_m) return kBadColor;
    return error_color(error / (kYellowMedians * std::max(median, 1e-9)));
  };
  // Faces take the colour of the nearest spot with a similar normal.
  std::vector<Vec3f> points;
  for (const planning::Spot& spot : it.surface.spots) points.push_back(spot.middle.p);
  const KdTree tree(points);
  TriangleMesh painted;
  painted.vertices.resize(3 * it.mesh.triangles.size());
  painted.colors.resize(painted.vertices.size());
  painted.triangles.resize(it.mesh.triangles.size());
  parallel_for(it.mesh.triangles.size(), 256, [&](std::size_t t) {
    constexpr std::size_t kNear = 8;
    std::array<Vec3f, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = it.mesh.vertices[it.mesh.triangles[t][k]];
    const Vec3f normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    const auto nearest = [&](const Vec3f& p) {
      std::array<std::uint32_t, kNear> index{};
      std::array<float, kNear> squared{};
      const std::size_t found = tree.knn(p, kNear, index.data(), squared.data());
      for (std::size_t i = 0; i < found; ++i)
        if (it.surface.spots[index[i]].middle.normal.dot(normal) > 0.0f) return index[i];
      return index[0];
    };
    for (std::size_t k = 0; k < 3; ++k) {
      painted.vertices[3 * t + k] = corner[k];
      painted.colors[3 * t + k] = color(errors[nearest(corner[k])]);
    }
    const auto first = std::uint32_t(3 * t);
    painted.triangles[t] = {first, first + 1, first + 2};
  });
  std::vector<ColorImage> pictures;
  for (const double elevation : {kSeenFrom_rad, kFromBelow_rad}) {
    PictureOptions options;
    options.width = options.height = kSide_px;
    options.smooth = false;
    options.ground = false;
    options.elevation_rad = elevation;
    TURNSCAN_ASSIGN(ColorImage picture, render_picture(std::span(&painted, 1), options, context));
    pictures.push_back(std::move(picture));
  }
  return side_by_side(pictures);
}

std::string plan_file_name(const PlanRequest& request, std::size_t rank, std::size_t object) {
  std::string name = fmt::format("plan-{}", rank);
  if (request.objects.size() == 1) return name;
  std::string of = request.objects[object];
  if (of.starts_with("builtin:")) of = of.substr(8);
  of = fs::path(of).stem().string();
  for (char& c : of)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';

  return name + fmt::format("-{}-{}", object + 1, of);
}

}  // namespace turnscan::workflow
