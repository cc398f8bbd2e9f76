// Imports folders of the TUM RGB-D benchmark (Sturm et al. 2012): depth.txt and rgb.txt list
// `time file`, groundtruth.txt lists `time tx ty tz qx qy qz qw` (camera to world).
// https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats: depth images have 5000 steps per
// metre and are registered to colour; for them the page recommends the uncalibrated intrinsics
// fx = fy = 525, cx = 319.5, cy = 239.5 without distortion ("ROS default").

#include <algorithm>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr double kMaxTimeDifference = 0.02;   // seconds
constexpr double kDepthUnit = 1.0 / 5000.0;   // metres
constexpr std::size_t kMaxEntries = 1000000;  // of poses, a hundred times a second and more
constexpr std::size_t kMaxTumFrames = 100000;

struct TimedFile {
  double time_s = 0.0;
  std::string file;
};

struct TimedPose {
  double time_s = 0.0;
  Vec3d position = Vec3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// Calls parse(words) for each line and sorts what it returns by time.
template <class Entry, class Parse>
Result<std::vector<Entry>> read_list(const fs::path& path, std::size_t word_count,
                                     const RunContext& context, const Parse& parse) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  std::vector<Entry> entries;
  text::LineReader lines(text);
  while (const auto line = lines.next_content()) {
    TURNSCAN_TRY(context.check());
    const auto words = text::words_of(line->text);
    auto entry = words.size() == word_count
                     ? parse(words)
                     : Result<Entry>(fail(ErrorCode::kFormat, "there are {} words, not {}",
                                          words.size(), word_count));
    if (!entry)
      return fail_at(path.string(), ErrorCode::kFormat, "line {}: {}", line->number,
                     entry.error().message);
    if (entries.size() == kMaxEntries)
      return fail_at(path.string(), ErrorCode::kResourceLimit, "there are more than {} lines",
                     kMaxEntries);
    entries.push_back(std::move(*entry));
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.time_s < b.time_s; });
  return entries;
}

Result<TimedFile> parse_file(const std::vector<std::string_view>& words) {
  TURNSCAN_ASSIGN(const double time_s, parse_number(words[0]));
  return TimedFile{time_s, std::string(words[1])};
}

Result<TimedPose> parse_tum_pose(const std::vector<std::string_view>& words) {
  std::array<double, 8> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    TURNSCAN_ASSIGN(v[i], parse_number(words[i]));
  }
  TURNSCAN_ASSIGN(const Pose pose, pose_from(Vec3d(v[1], v[2], v[3]), v[4], v[5], v[6], v[7]));
  return TimedPose{v[0], pose.translation(), Eigen::Quaterniond(pose.linear())};
}

/// The entry nearest in time within the limit, or nullptr. Entries must be sorted by time.
template <class Entry>
const Entry* nearest(const std::vector<Entry>& entries, double time_s) {
  const auto after = std::lower_bound(entries.begin(), entries.end(), time_s,
                                      [](const Entry& e, double t) { return e.time_s < t; });
  const Entry* best = nullptr;
  const auto offer = [&](const Entry& e) {
    const double difference = std::abs(e.time_s - time_s);
    if (difference <= kMaxTimeDifference &&
        (best == nullptr || difference < std::abs(best->time_s - time_s)))
      best = &e;
  };
  if (after != entries.begin()) offer(*std::prev(after));
  if (after != entries.end()) offer(*after);
  return best;
}

/// Interpolated between the neighbours in time if both are near, else the nearest, else nullopt.
std::optional<Pose> pose_at(const std::vector<TimedPose>& poses, double time_s) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), time_s,
                                      [](const TimedPose& p, double t) { return p.time_s < t; });
  TimedPose at;
  const bool between = after != poses.begin() && after != poses.end() &&
                       after->time_s - time_s <= kMaxTimeDifference &&
                       time_s - std::prev(after)->time_s <= kMaxTimeDifference;
  if (between) {
    const TimedPose& a = *std::prev(after);
    const double span = after->time_s - a.time_s;
    const double s = span > 0.0 ? (time_s - a.time_s) / span : 0.0;
    at.position = a.position + s * (after->position - a.position);
    at.rotation = a.rotation.slerp(s, after->rotation);
  } else if (const TimedPose* pose = nearest(poses, time_s)) {
    at = *pose;
  } else {
    return std::nullopt;
  }
  Pose out = Pose::Identity();
  out.linear() = at.rotation.normalized().toRotationMatrix();
  out.translation() = at.position;
  return out;
}

Result<CameraIntrinsics> intrinsics_of(const fs::path& folder, const ImportOptions& options,
                                       SequenceHeader& header) {
  if (!options.intrinsics.empty()) return stated_intrinsics(options);
  TURNSCAN_ASSIGN(const auto kinect, iai_kinect2_intrinsics(options));
  if (kinect) return *kinect;
  TURNSCAN_ASSIGN(const auto beside, intrinsics_beside(folder));
  if (beside) return *beside;
  const std::string name = display_name(folder);
  for (const char* known : {"freiburg1", "freiburg2", "freiburg3"}) {
    if (name.find(known) == std::string::npos) continue;
    CameraIntrinsics camera;
    camera.fx = camera.fy = 525.0;
    camera.cx = 319.5;
    camera.cy = 239.5;
    add_note(header,
             "intrinsics fx = fy = 525, cx = 319.5, cy = 239.5 without distortion, as the "
             "benchmark recommends for its registered depth images");
    return camera;
  }
  return fail_at(folder.string(), ErrorCode::kMissingData,
                 "the folder does not hold the camera's intrinsics and its name is none of "
                 "freiburg1, freiburg2, freiburg3; state them: --intrinsics fx,fy,cx,cy");
}

Result<std::vector<TimedPose>> read_poses(const fs::path& folder, const RunContext& context) {
  const fs::path path = folder / "groundtruth.txt";
  TURNSCAN_ASSIGN(const bool there, file::is_there(path));
  if (!there) return std::vector<TimedPose>();
  return read_list<TimedPose>(path, 8, context, parse_tum_pose);
}

Result<std::vector<TimedFile>> read_color_list(const fs::path& folder, const RunContext& context) {
  const fs::path path = folder / "rgb.txt";
  TURNSCAN_ASSIGN(const bool there, file::is_there(path));
  if (!there) return std::vector<TimedFile>();
  return read_list<TimedFile>(path, 2, context, parse_file);
}

Result<std::vector<ForeignFrame>> list_frames(const fs::path& folder, const ImportOptions& options,
                                              SequenceHeader& header, const RunContext& context) {
  TURNSCAN_ASSIGN(const auto depths,
                  read_list<TimedFile>(folder / "depth.txt", 2, context, parse_file));
  if (depths.size() > kMaxTumFrames)
    return fail_at((folder / "depth.txt").string(), ErrorCode::kResourceLimit,
                   "there are more than {} frames", kMaxTumFrames);
  TURNSCAN_ASSIGN(const auto colors, read_color_list(folder, context));
  TURNSCAN_ASSIGN(const auto poses, read_poses(folder, context));
  std::vector<ForeignFrame> frames;
  std::size_t unplaced = 0;
  for (const TimedFile& depth : depths) {
    TURNSCAN_TRY(context.check());
    ForeignFrame frame;
    frame.info.index = static_cast<std::uint32_t>(frames.size());
    frame.info.time_s = depth.time_s;
    frame.info.file = depth.file;
    TURNSCAN_ASSIGN(frame.data, existing_file(folder, depth.file, "depth.txt"));
    if (const TimedFile* color = nearest(colors, depth.time_s)) {
      TURNSCAN_ASSIGN(frame.color, existing_file(folder, color->file, "rgb.txt"));
    }
    if (const auto pose = pose_at(poses, depth.time_s)) {
      TURNSCAN_ASSIGN(frame.info.T_table_sensor, placed_pose(*pose, options));
    } else if (!poses.empty()) {
      frame.info.status = FrameStatus::kDropped;
      ++unplaced;
    }
    frames.push_back(std::move(frame));
  }
  if (unplaced > 0)
    add_note(header, fmt::format("{} of {} frames have no pose within 20 ms; they are marked "
                                 "dropped",
                                 unplaced, frames.size()));
  return frames;
}

}  // namespace

OpenResult open_tum(const fs::path& folder, const ImportOptions& options,
                    const RunContext& context) {
  SequenceHeader header;
  header.source = fmt::format("TUM RGB-D folder {}", display_name(folder));
  SensorInfo sensor;
  TURNSCAN_ASSIGN(sensor.intrinsics, intrinsics_of(folder, options, header));
  TURNSCAN_ASSIGN(sensor.depth_unit_m, depth_scale(options, kDepthUnit));
  TURNSCAN_ASSIGN(const auto own_camera, intrinsics_beside(folder));
  if (!options.depth_unit_m) {
    if (!own_camera) sensor.model = "kinect-v1";
    add_note(header,
             "depth images have 5000 steps a metre, as the benchmark defines for its Kinects");
  }
  header.sensors.push_back(sensor);
  TURNSCAN_ASSIGN(std::vector<ForeignFrame> frames, list_frames(folder, options, header, context));
  TURNSCAN_TRY(apply_iai_kinect2(options, frames, header));
  TURNSCAN_TRY(look_at_first_images(header, frames));
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<ForeignSequence>(std::move(header), frames);
}

}  // namespace turnscan::importers
