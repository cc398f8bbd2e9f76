// Finds the motions between the passes of simulated recordings, and judges them by their truth.
//   pass_motion [--different] [--open3d] RECORDING...
// each made by `turnscan simulate --next-pass`. --different: the first pass of each recording is
// joined to the second of the next one. --open3d: the same surfaces are given to Open3D, too.
// Prints a line of JSON a pass; bench/pass_cases makes random recordings and sums up.

#include <fmt/format.h>

#include <bench/pass_motion/open3d_motion.hpp>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/passes/join_passes.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/recording/recording.hpp>

namespace {

using namespace turnscan;
using Json = nlohmann::ordered_json;

/// Partners of the other pass lie no farther than that, and face the same way.
constexpr float kSeamReach_m = 0.003f, kSeamCos = 0.9f;
/// The step between two passes is that of their median distance over so much of the surface.
constexpr float kSeamBlock_m = 0.02f;
constexpr std::size_t kMinOfBlock = 30;

/// Of all threads together; another program's work does not count.
double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// A pass as it was reconstructed, and how the object truly lay in it.
struct Pass {
  passes::PassSurface surface;
  Pose T_table_object = Pose::Identity();
};

Pose pose_of(const nlohmann::json& rows) {
  Pose T = Pose::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) T.matrix()(r, c) = rows.at(std::size_t(r)).at(std::size_t(c));
  }
  return T;
}

std::vector<Pose> true_poses(const std::filesystem::path& recording) {
  std::ifstream file(recording / "truth/truth.json");
  const auto truth = nlohmann::json::parse(file);
  std::vector<Pose> out{pose_of(truth.at("object").at("T_table_object"))};
  for (const auto& next : truth.value("next_passes", nlohmann::json::array()))
    out.push_back(pose_of(next.at("T_table_object")));
  return out;
}

Result<std::vector<Pass>> read_passes(const std::filesystem::path& folder) {
  TURNSCAN_ASSIGN(const Recording recording, Recording::open(folder));
  std::vector<Pass> out;
  const std::vector<Pose> truth = true_poses(folder);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    ReconstructOptions options;
    options.surface.method = SurfaceMethod::kVolumetric;
    options.merge.pass = int(k);
    options.for_placing = true;
    TURNSCAN_ASSIGN(const Reconstruction made, reconstruct(recording, options, {}, {}));
    Pass& pass = out.emplace_back();
    pass.surface = passes::measured_surface(made.objects.at(0), made.seen);
    pass.T_table_object = truth[k];
  }
  return out;
}

/// The rotation (deg) and the rms displacement over the pass's surface (mm) by which a motion errs.
std::pair<double, double> error_of(const Pose& T_first_pass, const Pass& first, const Pass& pass) {
  const Pose truth = first.T_table_object * pass.T_table_object.inverse();
  double sum = 0.0;
  for (const Vec3f& p : pass.surface.points)
    sum += (T_first_pass * p.cast<double>() - truth * p.cast<double>()).squaredNorm();
  const Eigen::AngleAxisd turn(T_first_pass.linear() * truth.linear().transpose());
  return {std::abs(turn.angle()) * kDegreesPerRadian,
          1e3 * std::sqrt(sum / double(pass.surface.points.size()))};
}

/// By how much the measurements of two passes lie beside each other where both see (mm): over all,
/// and in nine tenths of the places.
std::pair<double, double> seam_of(const Pose& T_first_pass, const Pass& first, const Pass& pass) {
  const KdTree tree(first.surface.points);
  const Eigen::Isometry3f T = T_first_pass.cast<float>();
  std::vector<float> all;
  std::map<std::array<int, 3>, std::vector<float>> blocks;
  for (std::size_t i = 0; i < pass.surface.points.size(); ++i) {
    const Vec3f p = T * pass.surface.points[i], n = T.linear() * pass.surface.normals[i];
    std::uint32_t near = 0;
    float squared = 0.0f;
    if (tree.knn(p, 1, &near, &squared, kSeamReach_m) == 0) continue;
    const Vec3f& other = first.surface.normals[near];
    if (other.dot(n) < kSeamCos) continue;
    const Vec3f apart = p - first.surface.points[near];
    const float offset = (n + other).normalized().dot(apart);
    // At the rim of what the other measured its nearest point lies beside.
    if (apart.squaredNorm() - offset * offset > 2.25e-6f) continue;
    all.push_back(offset);
    const Eigen::Vector3i at = (p / kSeamBlock_m).array().floor().cast<int>();
    blocks[{at.x(), at.y(), at.z()}].push_back(offset);
  }
  if (all.empty()) return {};
  std::vector<double> steps;
  for (auto& [at, offsets] : blocks)
    if (offsets.size() >= kMinOfBlock) steps.push_back(std::abs(double(median(offsets))));
  std::sort(steps.begin(), steps.end());
  return {1e3 * std::abs(double(median(all))),
          steps.empty() ? 0.0 : 1e3 * steps[std::size_t(0.9 * double(steps.size() - 1))]};
}

Json judged(const passes::PassMotion& m, const Pass& first, const Pass& pass) {
  Json out = {{"joined", m.joined}};
  if (!m.joined) {
    out["reason"] = m.reason;
    return out;
  }
  const auto [turn, shift] = error_of(m.T_first_pass, first, pass);
  const auto [seam, most] = seam_of(m.T_first_pass, first, pass);
  out.update({{"deg", turn},
              {"mm", shift},
              {"stated_deg", m.sigma_rad * kDegreesPerRadian},
              {"stated_mm", m.sigma_m * 1e3},
              {"overlap_cm2", m.overlap_m2 * 1e4},
              {"against_cm2", m.against_m2 * 1e4},
              {"residual_mm", m.residual_m * 1e3},
              {"seam_mm", seam},
              {"seam_p90_mm", most}});
  return out;
}

void join_and_print(const std::string& name, const std::vector<Pass>& all, bool open3d) {
  std::vector<passes::PassSurface> surfaces;
  for (const Pass& pass : all) surfaces.push_back(pass.surface);
  const double start = processor_seconds();
  const auto motions = passes::join_passes(surfaces, {}, {});
  const double seconds = processor_seconds() - start;
  if (!motions) {
    fmt::print("{}\n", Json({{"recording", name}, {"error", motions.error().text()}}).dump());
    return;
  }
  for (std::size_t k = 1; k < all.size(); ++k) {
    Json line = {{"recording", name}, {"pass", k}, {"seconds", seconds}};
    line.update(judged((*motions)[k], all[0], all[k]));
    if (open3d) {
      for (const auto& other : bench::open3d_motions(all[0].surface, all[k].surface)) {
        const auto [turn, shift] = error_of(other.T_first_pass, all[0], all[k]);
        line[other.name] = {
            {"deg", turn}, {"mm", shift}, {"fitness", other.fitness}, {"seconds", other.seconds}};
      }
    }
    fmt::print("{}\n", line.dump());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names;
  bool different = false, open3d = false;
  for (const std::string argument : std::span(argv + 1, std::size_t(argc - 1))) {
    if (argument == "--different")
      different = true;
    else if (argument == "--open3d")
      open3d = true;
    else
      names.push_back(argument);
  }
  if (names.empty()) return 2;
  std::vector<std::vector<Pass>> recordings;
  for (const std::string& name : names) {
    auto read = read_passes(name);
    if (!read) {
      fmt::print("{}\n", Json({{"recording", name}, {"error", read.error().text()}}).dump());
      continue;
    }
    if (!different) {
      join_and_print(name, *read, open3d);
    } else {
      recordings.push_back(std::move(*read));
    }
  }
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const std::size_t next = (i + 1) % recordings.size();
    join_and_print(names[i] + "/" + names[next], {recordings[i][0], recordings[next][1]}, open3d);
  }
}
