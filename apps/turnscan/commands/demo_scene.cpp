#include "commands/demo_scene.hpp"

#include <chrono>
#include <cmath>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/reconstruction/report.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/rendering/picture.hpp>

#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/simulation/seen_by.hpp>

namespace turnscan::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kErrorScale_m = 0.002;  // last colour of the error view
constexpr int kFramesOfATurn = 920;      // approximate; it follows from the speed
constexpr double kSecondsPerRecordedFrame = 0.025;
constexpr std::string_view kPair = "pair";

/// An object of the scene: its ground truth and the result.
struct Piece {
  std::string name;
  TriangleMesh truth;
  TriangleMesh mesh;
};

Result<std::vector<Piece>> make_pieces(const std::string& scene, const RunContext& context) {
  std::vector<Piece> pieces;
  const auto add = [&](const std::string& name, double x, double z, double yaw) -> Result<> {
    TURNSCAN_ASSIGN(TriangleMesh mesh, builtin_object(name, context));
    pieces.push_back({name, place(std::move(mesh), x, z, yaw), {}});
    return {};
  };
  if (scene != kPair) {
    TURNSCAN_TRY(add(scene, 0.0, 0.0, 0.0));
    return pieces;
  }
  // Back to back across the platter, as far apart as possible.
  TURNSCAN_TRY(add("letter-a", 0.0, 0.065, 0.0));
  TURNSCAN_TRY(add("doll", 0.0, -0.055, M_PI));
  return pieces;
}

/// Assigns each reconstructed mesh to the ground truth with the nearest bounding box centre.
void distribute(const Reconstruction& result, std::vector<Piece>& pieces) {
  std::vector<std::vector<TriangleMesh>> parts(pieces.size());
  for (const ObjectResult& object : result.objects) {
    const Vec3d center = bounds(object.mesh.vertices).center();
    std::size_t best = 0;
    double best_distance = 1e300;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const double d = (bounds(pieces[i].truth.vertices).center() - center).norm();
      if (d < best_distance) {
        best = i;
        best_distance = d;
      }
    }
    parts[best].push_back(object.mesh);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i].mesh = join_meshes(parts[i]);
}

Result<ColorImage> draw(const Piece& piece, const TriangleMesh& errors, int size_px,
                        const RunContext& context) {
  PictureOptions options;
  options.width = options.height = size_px;
  options.ambient_samples = 8;
  options.use_colors = false;
  std::vector<ColorImage> views;
  for (const TriangleMesh* mesh : {&piece.truth, &piece.mesh, &errors}) {
    TURNSCAN_ASSIGN(ColorImage view, render_picture(std::span(mesh, 1), options, context));
    views.push_back(std::move(view));
    options.use_colors = views.size() == 2;
  }
  return side_by_side(views, options.background);
}

Result<> write_piece(const Piece& piece, const fs::path& folder, int picture_size_px,
                     const RunContext& context) {
  const auto file = [&](const std::string& ending) { return folder / (piece.name + ending); };
  TURNSCAN_ASSIGN(const TriangleMesh errors,
                  color_by_error(piece.mesh, piece.truth, kErrorScale_m, context));
  TURNSCAN_ASSIGN(const ColorImage picture, draw(piece, errors, picture_size_px, context));
  TURNSCAN_TRY(write_mesh(file(".ply"), piece.mesh));
  if (piece.mesh.texture != nullptr) TURNSCAN_TRY(write_mesh(file(".glb"), piece.mesh));
  TURNSCAN_TRY(write_mesh(file(".stl"), piece.mesh));
  TURNSCAN_TRY(write_mesh(file("-reference.ply"), piece.truth));
  TURNSCAN_TRY(write_mesh(file("-errors.ply"), errors));
  return write_color_png(file(".png"), picture);
}

Result<Evaluation> judge(const Piece& piece, const VirtualScan& scan,
                         const EvaluateOptions& options, const RunContext& context) {
  if (piece.mesh.empty())
    return fail(ErrorCode::kTooFewPoints, "{}: nothing of it was reconstructed; try more frames",
                piece.name);
  return evaluate(piece.mesh, piece.truth, options, seen_by(scan.scene(), scan, context), context);
}

double f_at_1mm(const Evaluation& evaluation) {
  for (const ThresholdScore& score : evaluation.scores) {
    if (std::fabs(score.threshold_m - 1e-3) < 1e-9) return score.f;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Result<VirtualScanOptions> virtual_scan_options(const DemoScanOptions& demo) {
  VirtualScanOptions options;
  TURNSCAN_ASSIGN(ScannerModel model, find_scanner(demo.scanner));
  options.scanners.push_back({std::move(model), demo.placement});
  options.motion = demo.motion;
  options.platter = demo.platter;
  options.measure = demo.measure;
  options.record.color = demo.color;
  return options;
}

Result<Reconstruction> record_and_reconstruct(const VirtualScan& scan, const fs::path& folder,
                                              const ReconstructOptions& options,
                                              const RunContext& context) {
  TURNSCAN_TRY(write_recording(folder / "recording", scan, context));
  TURNSCAN_ASSIGN(const Recording recording, Recording::open(folder / "recording", context));
  TURNSCAN_ASSIGN(Reconstruction result, reconstruct(recording, options, {}, context));
  TURNSCAN_TRY(write_file_atomically(folder / "report.json", report_json(result, options)));
  return result;
}

}  // namespace

DemoScanOptions::DemoScanOptions() {
  placement.aim_height_m = 0.09;
  measure.mixed_pixels = 0.5;
}

OptionTable describe(DemoScanOptions& o) {
  OptionTable table;
  table.text("scanner", o.scanner,
             fmt::format("The virtual scanner: {}, or a file FILE.toml",
                         fmt::join(scanner_presets(), ", ")));
  table.append(describe(o.placement))
      .append(describe(o.motion, "scan-speed"))
      .append(describe(o.measure))
      .append(describe(o.platter))
      .flag("scan-colour", o.color, "Also give a colour image with each depth image.");
  return table;
}

Result<std::vector<std::string>> scene_names(const std::string& object) {
  std::vector<std::string> names = builtin_object_names();
  names.emplace_back(kPair);
  if (object == "all") {
    std::erase_if(names, [](const std::string& name) { return is_gauge(name); });
    return names;
  }
  for (const std::string& name : names) {
    if (name == object) return std::vector<std::string>{name};
  }
  return fail(ErrorCode::kInvalidOption, "object: there is no '{}'; use one of {}, all", object,
              fmt::join(names, ", "));
}

PhasePlan demo_phases(const std::string& name, const DemoSceneOptions& options) {
  const int frames = options.scan.motion.frames.value_or(kFramesOfATurn);
  PhasePlan plan = joined({{{"write recording", kSecondsPerRecordedFrame * frames}},
                           surface_phases(options.reconstruct, std::size_t(frames))});
  // For each object: pictures of the ground truth, the mesh and the errors.
  const PhasePlan pictures(3, {"render picture", 6.0});
  for (int object = 0; object < (name == kPair ? 2 : 1); ++object)
    plan = joined({plan, evaluate_phases(options.evaluate), seen_phases(), pictures});
  return plan;
}

Result<std::vector<DemoFigures>> run_demo_scene(const std::string& name, const fs::path& folder,
                                                const DemoSceneOptions& options,
                                                const RunContext& context) {
  TURNSCAN_ASSIGN(std::vector<Piece> pieces, make_pieces(name, context));
  std::vector<TriangleMesh> objects;
  objects.reserve(pieces.size());
  for (const Piece& piece : pieces) objects.push_back(piece.truth);
  TURNSCAN_ASSIGN(const VirtualScanOptions scan_options, virtual_scan_options(options.scan));
  TURNSCAN_ASSIGN(const VirtualScan scan, VirtualScan::create(objects, scan_options));
  const auto begin = Clock::now();
  TURNSCAN_ASSIGN(const Reconstruction result,
                  record_and_reconstruct(scan, folder, options.reconstruct, context));
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  distribute(result, pieces);
  std::vector<DemoFigures> figures;
  for (const Piece& piece : pieces) {
    TURNSCAN_ASSIGN(Evaluation evaluation, judge(piece, scan, options.evaluate, context));
    TURNSCAN_TRY(write_piece(piece, folder, options.picture_size_px, context));
    const double f = f_at_1mm(evaluation);
    figures.push_back({name, piece.name, scan.frames().size(), check_mesh(piece.mesh),
                       std::move(evaluation), f, seconds});
  }
  return figures;
}

}  // namespace turnscan::cli
