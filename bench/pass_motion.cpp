// Finds the motions between the passes of simulated recordings, and judges them by their truth.
// Usage: pass_motion [--different] RECORDING..., each made by `turnscan simulate --next-pass`.
// --different: the first pass of each recording is joined to the second of the next one.

#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/reconstruction/frame_batch.hpp>
#include <turnscan/reconstruction/passes/join_passes.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace {

using namespace turnscan;

constexpr std::size_t kViews = 40;

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

Result<std::vector<views::DepthView>> views_of(const FrameSequence& sequence, std::uint32_t pass,
                                               double spacing_m) {
  TURNSCAN_ASSIGN(const FramePoses poses,
                  frame_poses(sequence.header(), sequence.frames(), std::nullopt));
  const std::vector<RayTable> rays = ray_tables(sequence.header());
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < sequence.frames().size(); ++i)
    if (sequence.frames()[i].pass == pass) frames.push_back(i);
  const double radius = sequence.header().turntable->radius_m.value_or(0.3);
  std::vector<views::DepthView> out;
  for (std::size_t k = 0; k < std::min(kViews, frames.size()); ++k) {
    const std::size_t i = frames[k * frames.size() / std::min(kViews, frames.size())];
    TURNSCAN_ASSIGN(const Frame frame, sequence.read(i));
    const Pose& T = poses.T_table_sensor[i];
    TURNSCAN_ASSIGN(auto view, views::make_view(frame, sequence.header().sensors[frame.info.sensor],
                                                rays[frame.info.sensor], T,
                                                {0.012, spacing_m, false}, [&](const Vec3f& p) {
                                                  const Vec3d q = T * p.cast<double>();
                                                  return q.y() > -0.01 && q.y() < 1.0 &&
                                                         std::hypot(q.x(), q.z()) < radius;
                                                }));
    out.push_back(std::move(view));
  }
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
    TURNSCAN_ASSIGN(Reconstruction made, reconstruct(recording, options, {}, {}));
    Pass& pass = out.emplace_back();
    pass.surface = passes::measured_surface(made.objects.at(0));
    pass.surface.noise_m = std::max(made.sensor_noise_m, made.merged_noise_m);
    pass.surface.floor_m = 0.0;
    TURNSCAN_ASSIGN(pass.surface.views,
                    views_of(recording, std::uint32_t(k), made.frame_spacing_m));
    pass.T_table_object = truth[k];
  }
  return out;
}

/// The rotation and the rms displacement by which a motion errs on the pass's surface.
std::pair<double, double> error_of(const passes::PassMotion& motion, const Pass& first,
                                   const Pass& pass) {
  const Pose truth = first.T_table_object * pass.T_table_object.inverse();
  double sum = 0.0;
  for (const Vec3f& p : pass.surface.points)
    sum += (motion.T_first_pass * p.cast<double>() - truth * p.cast<double>()).squaredNorm();
  const Eigen::AngleAxisd turn(motion.T_first_pass.linear() * truth.linear().transpose());
  return {std::abs(turn.angle()), std::sqrt(sum / double(pass.surface.points.size()))};
}

void join_and_print(const std::string& name, const std::vector<Pass>& all) {
  std::vector<passes::PassSurface> surfaces;
  for (const Pass& pass : all) surfaces.push_back(pass.surface);
  const double start = processor_seconds();
  const auto motions = passes::join_passes(surfaces, {}, {});
  const double seconds = processor_seconds() - start;
  if (!motions) {
    fmt::print("{} failed: {}\n", name, motions.error().text());
    return;
  }
  for (std::size_t k = 1; k < all.size(); ++k) {
    const passes::PassMotion& m = (*motions)[k];
    const auto [turn, shift] = error_of(m, all[0], all[k]);
    if (!m.joined) {
      fmt::print("{} {} refused in {:.2f} s: {}\n", name, k, seconds, m.reason);
      continue;
    }
    fmt::print(
        "{} {} {} {:.4f} deg {:.4f} mm, stated {:.4f} deg {:.4f} mm, ratio {:.2f}, "
        "overlap {:.1f} cm2, against {:.1f} cm2, residual {:.3f} mm, {:.2f} s\n",
        name, k, shift > 0.003 ? "WRONG" : "joined", turn * kDegreesPerRadian, shift * 1e3,
        m.sigma_rad * kDegreesPerRadian, m.sigma_m * 1e3, shift / m.sigma_m, m.overlap_m2 * 1e4,
        m.against_m2 * 1e4, m.residual_m * 1e3, seconds);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> names(argv + 1, argv + argc);
  const bool different = !names.empty() && names[0] == "--different";
  if (different) names.erase(names.begin());
  if (names.empty()) return 2;
  std::vector<std::vector<Pass>> recordings;
  for (const std::string& name : names) {
    auto read = read_passes(name);
    if (!read) {
      fmt::print("{}\n", read.error().text());
      return 1;
    }
    if (!different) {
      join_and_print(name, *read);
    } else {
      recordings.push_back(std::move(*read));
    }
  }
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const std::size_t next = (i + 1) % recordings.size();
    join_and_print(names[i] + "/" + names[next], {recordings[i][0], recordings[next][1]});
  }
}
