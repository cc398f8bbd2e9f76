#include <turnscan/workflow/export/export_run.hpp>

#include <fmt/ranges.h>
#include <algorithm>
#include <atomic>
#include <system_error>
#include <turnscan/core/parallel.hpp>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/plausibility/plausibility.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/calibration/disturbed_motion.hpp>
#include <turnscan/workflow/export/frame_images.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/passes/joined_frames.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/run_steps.hpp>

namespace turnscan {

namespace fs = std::filesystem;
using exporters::ExportLayout;
using exporters::PosedImage;
using workflow::ExportCamera;

namespace {

/// What is the same for all frames of a sensor.
struct ExportSensor {
  SensorInfo info;
  double depth_unit_m = 0.0;
  RayTable rays;                  ///< of the recorded depth camera
  ExportCamera depth, own_color;  ///< own_color: only if colour keeps its own camera
  bool keeps_color_camera = false;
};

struct FrameToWrite {
  std::size_t position = 0;
  std::uint32_t id = 0;
  double time_s = 0.0;
  Pose T_table_sensor;
};

/// Writes the images of frames. write() may be called from several threads at once.
class ImageWriter {
 public:
  ImageWriter(const fs::path& folder, const ExportLayout& layout, const SequenceHeader& header,
              std::optional<double> depth_unit_m, const Scene* scene)
      : folder_(folder), layout_(layout), scene_(scene) {
    for (const SensorInfo& info : header.sensors) {
      ExportSensor& sensor = sensors_.emplace_back();
      sensor.info = info;
      sensor.depth_unit_m = depth_unit_m.value_or(layout.depth_unit_m.value_or(info.depth_unit_m));
      sensor.rays = RayTable(info.intrinsics);
      sensor.depth = ExportCamera(info.intrinsics, layout.lens, scene != nullptr);
      sensor.keeps_color_camera = info.color_intrinsics && !layout.one_camera;
      if (sensor.keeps_color_camera)
        sensor.own_color = ExportCamera(*info.color_intrinsics, layout.lens, scene != nullptr);
    }
  }

  Result<> make_folders() const {
    for (const std::string_view name :
         {layout_.image_folder, layout_.depth_folder, layout_.mask_folder}) {
      std::error_code error;
      fs::create_directories(folder_ / name, error);
      if (error)
        return fail_at((folder_ / name).string(), ErrorCode::kIo, "cannot create the folder: {}",
                       error.message());
    }
    return {};
  }

  /// One or two: depth with the colour in its pixels, and colour that has a camera of its own.
  Result<std::vector<PosedImage>> write(const Frame& frame, const FrameToWrite& as) const {
    const ExportSensor& sensor = sensors_[frame.info.sensor];
    PosedImage image;
    image.id = as.id;
    image.time_s = as.time_s;
    image.T_world_camera = as.T_table_sensor;
    image.camera = sensor.depth.intrinsics();
    image.depth_unit_m = sensor.depth_unit_m;
    image.depth = exporters::depth_file(layout_, image.id);
    const workflow::UnitDepth depth =
        workflow::depth_in_unit(frame.depth, sensor.info, sensor.depth_unit_m);
    measured_ += depth.measured;
    lost_ += depth.lost;
    TURNSCAN_TRY(write_depth_png(folder_ / image.depth, sensor.depth.image_of(depth.image),
                                 Durability::kNamed));
    if (!sensor.keeps_color_camera) {
      TURNSCAN_ASSIGN(const ColorImage color,
                      workflow::color_of_depth(frame, sensor.info, sensor.rays));
      const bool as_recorded = !sensor.info.color_intrinsics && !color.empty();
      TURNSCAN_TRY(write_color(sensor.depth, color, as_recorded ? frame.color_jpeg : "", image));
    }
    if (!sensor.keeps_color_camera || frame.color.empty()) {
      TURNSCAN_TRY(write_mask(sensor.depth, image));
      return std::vector{image};
    }
    PosedImage own;
    own.id = as.id;
    own.time_s = as.time_s;
    own.T_world_camera = as.T_table_sensor * sensor.info.T_color_sensor.inverse();
    own.camera = sensor.own_color.intrinsics();
    TURNSCAN_TRY(write_color(sensor.own_color, frame.color, frame.color_jpeg, own));
    TURNSCAN_TRY(write_mask(sensor.own_color, own));
    return std::vector{image, own};
  }

  bool mesh_seen() const { return mesh_seen_; }
  bool takes_lens_out() const {
    return std::any_of(sensors_.begin(), sensors_.end(), [](const ExportSensor& sensor) {
      return sensor.depth.resamples() || sensor.own_color.resamples();
    });
  }

  /// A note if some depth is lost in so short steps; fails if most is.
  Result<> check_depth(std::vector<std::string>& notes) const {
    if (lost_ == 0) return {};
    const std::string what = fmt::format(
        "{:.1f} % of depth is farther than 16 bits reach in the steps of the depth images",
        100.0 * double(lost_) / double(measured_));
    if (2 * lost_ > measured_)
      return fail(ErrorCode::kInvalidOption, "{}; give a longer step, e.g. --depth-unit 1mm", what);
    notes.push_back(what + " and was left out; --depth-unit states a longer step");
    return {};
  }

 private:
  Result<> write_color(const ExportCamera& camera, const ColorImage& color, const std::string& jpeg,
                       PosedImage& image) const {
    if (color.empty()) return {};
    const bool packed = !jpeg.empty() && !camera.resamples();
    image.image = exporters::image_file(layout_, image.id, packed);
    if (packed) return write_file_atomically(folder_ / image.image, jpeg, Durability::kNamed);
    return write_color_png(folder_ / image.image, camera.image_of(color), Durability::kNamed);
  }

  Result<> write_mask(const ExportCamera& camera, PosedImage& image) const {
    if (scene_ == nullptr) return {};
    image.mask = exporters::mask_file(layout_, image.id, image.image.ends_with(".jpg"));
    const auto mask = camera.silhouette(*scene_, image.T_world_camera);
    if (std::find(mask.pixels.begin(), mask.pixels.end(), 255) != mask.pixels.end())
      mesh_seen_ = true;
    return write_grey_png(folder_ / image.mask, mask, Durability::kNamed);
  }

  const fs::path folder_;
  const ExportLayout& layout_;
  const Scene* scene_;
  std::vector<ExportSensor> sensors_;
  mutable std::atomic<bool> mesh_seen_ = false;
  mutable std::atomic<std::size_t> measured_ = 0, lost_ = 0;  ///< pixels of depth
};

Result<> check_exportable(const FrameSequence& frames, const ExportOptions& options) {
  for (const SensorInfo& sensor : frames.header().sensors)
    if (sensor.kind != SensorKind::kDepthCamera)
      return fail(ErrorCode::kUnsupported,
                  "the recording has scans of points, not images; nothing can be exported");
  const bool poses_join = workflow::has_poses(frames) && !frames.header().poses_within_pass;
  const std::vector<std::uint32_t> passes = passes_of(frames);
  if (options.pass && std::find(passes.begin(), passes.end(), *options.pass) == passes.end())
    return fail(ErrorCode::kInvalidOption,
                "--pass {}: the recording has no frames of it; it has {}", *options.pass,
                fmt::join(passes, ", "));
  if (options.pass || poses_join || passes.size() < 2) return {};
  return fail(ErrorCode::kMissingData,
              "the object lies differently in each of the {} passes; choose one with --pass",
              passes.size());
}

/// Times where all frames have them and they increase, else seconds counted from 0.
Result<std::vector<FrameToWrite>> frames_to_write(const CalibratedFrames& calibrated,
                                                  const ExportOptions& options,
                                                  std::vector<std::string>& notes) {
  const FrameSequence& frames = *calibrated.frames;
  TURNSCAN_ASSIGN(const FramePoses poses, frame_poses(frames.header(), frames.frames(),
                                                      calibrated.options.merge.speed_rad_s));
  std::vector<FrameToWrite> out;
  std::size_t count = 0;
  for (std::size_t i = 0; i < frames.frames().size(); ++i) {
    const FrameInfo& info = frames.frames()[i];
    if (info.status == FrameStatus::kDropped ||
        (options.pass && info.pass != std::uint32_t(*options.pass)) ||
        count++ % std::size_t(options.every) != 0)
      continue;
    out.push_back({i, std::uint32_t(out.size()), info.time_s, poses.T_table_sensor[i]});
  }
  if (out.empty()) return fail(ErrorCode::kTooFewPoints, "there are no frames to export");
  const bool times = std::adjacent_find(out.begin(), out.end(), [](const auto& a, const auto& b) {
                       return !(b.time_s > a.time_s);
                     }) == out.end();
  if (times && std::isfinite(out.front().time_s)) return out;
  for (FrameToWrite& frame : out) frame.time_s = frame.id;
  notes.push_back("the frames have no times that increase: they are numbered in seconds");
  return out;
}

void add_notes(const ExportLayout& layout, const SequenceHeader& header,
               const std::vector<PosedImage>& images, ExportSummary& summary) {
  std::size_t without_color = 0;
  for (const PosedImage& image : images) {
    summary.color_images += image.image.empty() ? 0 : 1;
    summary.depth_images += image.depth.empty() ? 0 : 1;
    summary.masks += image.mask.empty() ? 0 : 1;
    without_color += image.image.empty() ? 1 : 0;
  }
  const bool apart = !layout.one_camera && without_color > 0 && summary.color_images > 0;
  if (apart)
    summary.notes.push_back(fmt::format(
        "colour has a camera of its own: depth is described by itself in {}",
        layout.format == ExportFormat::kColmap ? "sparse_depth" : "transforms_depth.json"));
  if (!layout.one_camera && summary.color_images == 0)
    summary.notes.push_back(fmt::format(
        "there is no colour: the poses are those of the depth images, in {}", layout.depth_folder));
  const bool taken_over =
      layout.one_camera && summary.color_images > 0 &&
      std::any_of(header.sensors.begin(), header.sensors.end(),
                  [](const SensorInfo& sensor) { return sensor.color_intrinsics.has_value(); });
  if (taken_over)
    summary.notes.push_back("colour was taken into the pixels of depth, black where there is none");
}

}  // namespace

Result<> ExportOptions::check() const {
  ExportOptions copy = *this;
  return describe(copy).check();
}

OptionTable describe(ExportOptions& o) {
  OptionTable table;
  table.number("depth-unit", o.depth_unit_m, Quantity::kLength, {1e-7, 1.0},
               "Length of one step of the depth images that are written; automatic: 1 mm for "
               "colmap, nerfstudio and meshroom, 0.2 mm for tum, the recording's for bop");
  table.number("speed", o.speed_rad_s, Quantity::kAngularSpeed, {-100.0, 100.0},
               "Speed of the turntable instead of the recording's angles, counter-clockwise seen "
               "from above is positive");
  table.number("pass", o.pass, {0, 1e6}, "Only the frames of this pass");
  table.number("every", o.every, {1, 1e6}, "Only each n-th of the frames");
  return table;
}

Result<ExportFormat> export_format(const std::string& name) {
  std::vector<std::string_view> known;
  for (const ExportLayout& layout : exporters::export_layouts()) {
    if (layout.name == name) return layout.format;
    known.push_back(layout.name);
  }
  return fail(ErrorCode::kInvalidOption, "--to {}: there is no such layout; there are {}", name,
              fmt::join(known, ", "));
}

namespace {

Result<ExportSummary> write_export(const CalibratedFrames& calibrated, const ExportRequest& request,
                                   const fs::path& folder, const RunContext& context) {
  const ExportLayout& layout = exporters::layout_of(request.format);
  const FrameSequence& frames = *calibrated.frames;
  ExportSummary summary;
  TURNSCAN_ASSIGN(const std::vector<FrameToWrite> chosen,
                  frames_to_write(calibrated, request.options, summary.notes));
  std::optional<TriangleMesh> mesh;
  std::optional<Scene> scene;
  if (!request.mesh.empty()) {
    TURNSCAN_ASSIGN(mesh, read_mesh(request.mesh, {}, context));
    TURNSCAN_ASSIGN(scene, Scene::create(std::span(&*mesh, 1), std::nullopt, context));
  }
  const ImageWriter writer(folder, layout, frames.header(), request.options.depth_unit_m,
                           scene ? &*scene : nullptr);
  TURNSCAN_TRY(writer.make_folders());
  std::vector<std::vector<PosedImage>> written(chosen.size());
  context.begin_phase("write images", chosen.size());
  TURNSCAN_TRY(parallel_for(chosen.size(), 1, context, [&](std::size_t i) -> Result<> {
    TURNSCAN_ASSIGN(const Frame frame, frames.read(chosen[i].position));
    TURNSCAN_ASSIGN(written[i], writer.write(frame, chosen[i]));
    context.advance();
    return {};
  }));
  TURNSCAN_TRY(writer.check_depth(summary.notes));
  if (scene && !writer.mesh_seen())
    return fail_at(request.mesh, ErrorCode::kMissingData,
                   "the mesh is in none of the images; give the one that turnscan reconstruct "
                   "makes of this recording, with the same --turntable and --calibration");
  std::vector<PosedImage> images;
  for (std::vector<PosedImage>& of_frame : written)
    images.insert(images.end(), of_frame.begin(), of_frame.end());
  TURNSCAN_TRY(exporters::write_descriptions(folder, layout, images, mesh ? &*mesh : nullptr));
  add_notes(layout, frames.header(), images, summary);
  if (writer.takes_lens_out())
    summary.notes.push_back("the lens's distortion was taken out of the images");
  std::error_code ignored;
  for (const std::string_view name : {layout.image_folder, layout.mask_folder})
    fs::remove(folder / name, ignored);  // if it is empty
  return summary;
}

}  // namespace

Result<ExportSummary> export_recording(const FrameSequence& recording, const ExportRequest& request,
                                       const fs::path& folder, const RunContext& context) {
  TURNSCAN_TRY(request.options.check());
  TURNSCAN_TRY(check_output_folder(folder.string()));
  TURNSCAN_TRY(check_exportable(recording, request.options));
  ReconstructRequest placing;
  placing.options.merge.speed_rad_s = request.options.speed_rad_s;
  placing.calibration = request.calibration;
  placing.turntable = request.turntable;
  TURNSCAN_ASSIGN(const auto findings, find_implausible(recording, context));
  const auto placed = workflow::place_recording({"", &recording}, placing, context);
  if (!placed) return tl::unexpected<Error>(workflow::with_cause(placed.error(), {findings}));
  std::error_code error;
  const bool made = fs::create_directories(folder, error);
  auto summary = write_export(placed->calibrated, request, folder, context);
  if (!summary) {
    if (const auto own = file::Folder::open(folder))
      for (const std::string& name : own->names()) (void)own->remove(name);
    if (made) fs::remove(folder, error);
    return summary;
  }
  std::vector<std::string>& notes = summary->notes;
  if (const std::string& note = placed->calibrated.choice.note; !note.empty())
    notes.insert(notes.begin(), note);
  for (const PlausibilityFinding& finding : findings) notes.push_back(finding.text);
  return summary;
}

PhasePlan export_phases(const FrameSequence& recording) {
  return joined({motion_phases(), {{"write images", 0.05 * double(recording.frames().size())}}});
}

}  // namespace turnscan
