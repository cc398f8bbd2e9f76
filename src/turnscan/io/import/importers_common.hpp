#pragma once
// Common parts of the importers.

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/image/depth_file.hpp>
#include <turnscan/io/import/importers.hpp>
#include <turnscan/io/text/angle_table.hpp>
#include <vector>

namespace turnscan::importers {

/// One frame of an imported data set and its files; empty paths: none.
struct ForeignFrame {
  FrameInfo info;
  std::filesystem::path data;
  std::filesystem::path color;
  std::vector<std::filesystem::path> masks;  ///< what they show is kept; empty: all
};

/// A data set whose files are read when their frames are read.
class ForeignSequence : public FrameSequence {
 public:
  /// scan_to_sensor maps the coordinates of scans to metres in the sensor frame. Where all depths
  /// are multiples of several steps, as those of a sensor with longer ones, these become the
  /// recording's: what is estimated of rounding rests on them.
  ForeignSequence(SequenceHeader header, const std::vector<ForeignFrame>& frames,
                  const Eigen::Matrix3d& scan_to_sensor = Eigen::Matrix3d::Identity(),
                  const DepthFileOptions& depth_files = {});
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return frames_; }
  Result<Frame> read(std::size_t position) const override;

 private:
  std::uint16_t steps_of_sensor() const;

  struct Files {
    std::filesystem::path data, color;
    std::vector<std::filesystem::path> masks;
  };
  SequenceHeader header_;
  std::vector<FrameInfo> frames_;
  std::vector<Files> files_;
  Eigen::Matrix3d scan_to_sensor_;
  DepthFileOptions depth_files_;
  std::uint16_t steps_ = 1;  ///< of the images, in one of the recording
};

using OpenResult = Result<std::unique_ptr<FrameSequence>>;

// One opener per layout. path is the file or folder that the user named. They fail with kCancelled
// soon after the context is.
OpenResult open_stanford_conf(const std::filesystem::path& path, const ImportOptions& options,
                              const RunContext& context);
OpenResult open_cloud_folder(const std::filesystem::path& folder, const ImportOptions& options,
                             const RunContext& context);
OpenResult open_tum(const std::filesystem::path& folder, const ImportOptions& options,
                    const RunContext& context);
OpenResult open_frame_pose(const std::filesystem::path& folder, const ImportOptions& options,
                           const RunContext& context);
OpenResult open_matroska(const std::filesystem::path& path, const ImportOptions& options,
                         const RunContext& context);
OpenResult open_open3d_rgbd(const std::filesystem::path& folder, const ImportOptions& options,
                            const RunContext& context);
OpenResult open_json_png(const std::filesystem::path& path, const ImportOptions& options,
                         const RunContext& context);
OpenResult open_record3d(const std::filesystem::path& path, const ImportOptions& options,
                         const RunContext& context);
OpenResult open_sens(const std::filesystem::path& path, const ImportOptions& options,
                     const RunContext& context);
OpenResult open_klg(const std::filesystem::path& path, const ImportOptions& options,
                    const RunContext& context);
OpenResult open_scanner_app(const std::filesystem::path& folder, const ImportOptions& options,
                            const RunContext& context);
OpenResult open_depth_folder(const std::filesystem::path& folder, const ImportOptions& options,
                             const RunContext& context);
OpenResult open_nerfstudio(const std::filesystem::path& path, const ImportOptions& options,
                           const RunContext& context);
OpenResult open_bop(const std::filesystem::path& folder, const ImportOptions& options,
                    const RunContext& context);
OpenResult open_rtabmap(const std::filesystem::path& folder, const ImportOptions& options,
                        const RunContext& context);

/// Whether a file of this name may be a depth image: PNG, TIFF, PGM, NPY or bare numbers.
bool is_depth_name(std::string_view name);
/// "frame_00012.json", as 3D Scanner App names the metadata of a frame.
bool is_scanner_app_frame(std::string_view name);
/// "depth" or "NAME_depth": the folder in which RTAB-Map's export stores depth images.
bool is_rtabmap_depth_folder(std::string_view name);
OpenResult open_rosbag(const std::filesystem::path& path, const ImportOptions& options,
                       const RunContext& context);

/// Larger text files of data sets are rejected.
inline constexpr std::uint64_t kMaxTextBytes = std::uint64_t(16) << 20;

/// Names of the files and folders in a folder, sorted; at most a million.
Result<std::vector<std::string>> names_in(const std::filesystem::path& folder);

/// The last component of a path, human-readable; also for "dir/" and ".".
std::string display_name(const std::filesystem::path& path);

/// folder / name, if name stays inside the folder and is a file. The error names what refers to it.
Result<std::filesystem::path> existing_file(const std::filesystem::path& folder,
                                            std::string_view name, std::string_view mentioned_by);

/// Adds a sentence about an assumption to header.source.
void add_note(SequenceHeader& header, std::string_view note);

/// Sets the path of the file to which an error refers.
tl::unexpected<Error> at_path(const std::filesystem::path& path, Error error);

/// Metres per unit of scans: as stated, else `by_format`, else an error that asks for it.
Result<double> point_scale(const ImportOptions& options, std::optional<double> by_format);

/// A table of angles or times. Fails as text::parse_angle_table() and reading do.
Result<std::vector<text::AngleRow>> read_angle_table(const std::filesystem::path& path);

/// Rotation, or reflection, from the axes of scans (options.axes) to the sensor frame: x right, y
/// down, z forward. Identity if they are not stated.
Result<Eigen::Matrix3d> stated_axes(const ImportOptions& options);

/// Metres per step of depth images: as stated, else `by_format`, else an error that asks for it.
Result<double> depth_scale(const ImportOptions& options, std::optional<double> by_format);

/// From options.intrinsics ("fx,fy,cx,cy" or a file), without the image size.
Result<CameraIntrinsics> stated_intrinsics(const ImportOptions& options);
/// Intrinsics of the depth camera in options.iai_kinect2, if that folder is given and contains
/// them.
Result<std::optional<CameraIntrinsics>> iai_kinect2_intrinsics(const ImportOptions& options);
/// Intrinsics from a file of text::parse_camera_file(); the image size is 0 if it is not stated.
Result<CameraIntrinsics> intrinsics_from_file(const std::filesystem::path& path);

/// Intrinsics from the first file there is of those that usually hold a camera's 3x3 matrix beside
/// images; nullopt: there is none.
Result<std::optional<CameraIntrinsics>> intrinsics_beside(const std::filesystem::path& folder);

/// From options.sensor_position or options.sensor_direction, if either is given.
Result<std::optional<Viewpoint>> stated_viewpoint(const ImportOptions& options);

/// "x,y,z" without units; must not be zero.
Result<Vec3d> parse_direction(std::string_view name, std::string_view text);
/// "x,y,z" with units of length, in metres.
Result<Vec3d> parse_position(std::string_view name, std::string_view text);

/// T_world_sensor from a pose of the data set: in the direction options.pose_direction, camera to
/// world by default, with the world rotated so that options.world_up becomes +Y.
Result<Pose> placed_pose(const Pose& pose, const ImportOptions& options);

/// Completes header.turntable from the options. on_platter: an existing centre is already on the
/// platter's surface.
Result<> apply_turntable_options(const ImportOptions& options, bool on_platter,
                                 SequenceHeader& header);

/// Sets cameras and depth offset of sensor 0 from options.iai_kinect2, if given; the colour camera
/// only if the frames have colour images of its size. Fails as read_iai_kinect2 does, and with
/// kInvalidOption if the depth images are of another size.
Result<> apply_iai_kinect2(const ImportOptions& options, const std::vector<ForeignFrame>& frames,
                           SequenceHeader& header);

/// Reads the size of the first frame's images; sets the sensor's image size if it is 0, and drops
/// the colour of all frames, with a note, if it is not registered and has no camera.
Result<> look_at_first_images(SequenceHeader& header, std::vector<ForeignFrame>& frames);

}  // namespace turnscan::importers
