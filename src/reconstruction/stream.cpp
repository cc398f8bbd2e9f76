#include <algorithm>
#include <map>
#include <mutex>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/first_look.hpp>
#include <turnscan/reconstruction/point_stream.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <turnscan/reconstruction/unused_options.hpp>
#include <turnscan/reconstruction/volumetric_stream.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan {

namespace {

Result<> check_options(const ReconstructOptions& options) {
  ReconstructOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  TURNSCAN_TRY(objects_to_keep(options.components));
  if (options.voxels.size_m && options.voxels.grid)
    return fail(ErrorCode::kInvalidOption, "voxel-size and voxel-grid are both given; give one");
  return {};
}

Result<> check_sensor(const FrameInfo& info, const SequenceHeader& header) {
  if (info.sensor < header.sensors.size()) return {};
  return fail(ErrorCode::kFormat, "frame {}: there is no sensor {}", info.index, info.sensor);
}

/// Frames with poses of their own may lie as they like: the poses bring them together.
Result<> check_pass(const FrameInfo& info, const FrameInfo& first) {
  if (info.pass == first.pass || info.T_table_sensor) return {};
  return fail(
      ErrorCode::kInvalidOption,
      "frames {} and {} are of passes {} and {}, in which the object lies differently; give "
      "--pass to say which to use",
      first.index, info.index, first.pass, info.pass);
}

/// Whether any frame has neighbours along rows and columns, between which there is surface; the
/// profiles of a line scanner have none.
bool any_grid(const std::vector<Frame>& frames) {
  return std::any_of(frames.begin(), frames.end(), [](const Frame& frame) {
    return !frame.depth.pixels.empty() || (frame.grid_width > 1 && frame.grid_height > 1);
  });
}

/// So many profiles of line scanners make a good first look.
constexpr std::size_t kFirstProfiles = 256;

/// A frame that is to be worked on, and its place.
struct Placed {
  std::size_t position = 0;  ///< in the list handed over
  FrameInfo info;
  Pose T_table_sensor;
};

}  // namespace

class ReconstructionStream::Impl {
 public:
  Impl(const SequenceHeader& header, const ReconstructOptions& options)
      : header_(header),
        options_(options),
        poser_(header_, options_.merge.speed_rad_s),
        first_frames_(frames_of_first_look(header_, options_.crop)) {
    recipe_ = FrameRecipe::make(header_);
    recipe_.outliers = options_.outliers;
  }

  Result<> add(const std::vector<FrameInfo>& infos, const FrameReader& read,
               const RunContext& context) {
    const StageTimer timer(out_, "frames");
    std::vector<Placed> placed;
    std::size_t dropped = 0, left_out = 0;
    const std::optional<int>& pass = options_.merge.pass;
    for (std::size_t i = 0; i < infos.size(); ++i) {
      TURNSCAN_TRY(check_sensor(infos[i], header_));
      if (pass && infos[i].pass != std::uint32_t(*pass)) {
        ++left_out;
        continue;
      }
      if (!first_) first_ = infos[i];
      TURNSCAN_TRY(check_pass(infos[i], *first_));
      TURNSCAN_ASSIGN(const Pose pose, poser_(infos[i]));
      if (infos[i].status == FrameStatus::kDropped)
        ++dropped;
      else
        placed.push_back({i, infos[i], pose});
    }
    if (look_) {
      TURNSCAN_TRY(work(placed, read, context));
    } else {
      TURNSCAN_TRY(wait(placed, read, context));
    }
    out_.dropped_frames += dropped;
    context.advance(dropped + left_out);
    return {};
  }

  Result<TriangleMesh> preview(const RunContext& context) {
    if (!volumetric())
      return fail(ErrorCode::kInvalidOption,
                  "preview: only --method volumetric shows the growing surface");
    const VolumetricStream* volume = nullptr;
    {
      const std::lock_guard lock(mutex_);
      volume = volume_.get();
    }
    return volume == nullptr ? TriangleMesh() : volume->preview(context);
  }

  Result<Reconstruction> finish(const StageSink& sink, const RunContext& context) {
    TURNSCAN_TRY(context.check());
    if (!look_) {
      if (waiting_.empty() && options_.merge.pass && !first_)
        return fail(ErrorCode::kInvalidOption, "the recording has no frame of pass {}",
                    *options_.merge.pass);
      if (waiting_.empty())
        return fail(ErrorCode::kTooFewPoints, "the recording has no frame that can be used");
      whole_ = true;
      TURNSCAN_TRY(look(context));
    }
    for (const std::string& name : unused_options(options_))
      out_.notes.push_back(fmt::format("option {}: this method does not use it", name));
    if (forgotten_ > 0)
      out_.notes.push_back(
          fmt::format("the first {} frames show nothing on the platter", forgotten_));
    if (volumetric()) {
      for (auto& [sensor, group] : groups_) TURNSCAN_TRY(add_group(group.flush(), sensor));
      TURNSCAN_TRY(volume_->finish(sink, context, out_));
    } else {
      TURNSCAN_TRY(points_->finish(sink, context, out_));
    }
    return std::move(out_);
  }

 private:
  bool volumetric() const { return options_.surface.method == SurfaceMethod::kVolumetric; }

  /// Keeps frames until there are enough for the first look.
  Result<> wait(const std::vector<Placed>& placed, const FrameReader& read,
                const RunContext& context) {
    const std::size_t missing = first_frames_ - waiting_.size();
    const std::size_t count = std::min(missing, placed.size());
    std::vector<Result<Frame>> frames(count);
    parallel_for(count, 1, [&](std::size_t i) {
      if (context.cancelled()) return;
      frames[i] = read(placed[i].position);
      if (frames[i] && !options_.color) frames[i]->color = ColorImage();
    });
    TURNSCAN_TRY(context.check());
    for (const auto& frame : frames) {
      TURNSCAN_TRY(frame);
      const std::size_t s = frame->info.sensor;
      TURNSCAN_TRY(points_of(*frame, header_.sensors.at(s), recipe_.rays.at(s)));
    }
    for (std::size_t i = 0; i < count; ++i) {
      waiting_.push_back(std::move(*frames[i]));
      waiting_poses_.push_back(placed[i].T_table_sensor);
    }
    if (waiting_.size() < first_frames_) return {};
    if (first_frames_ < kFirstProfiles) {
      TURNSCAN_ASSIGN(const bool profiles, are_profiles());
      if (profiles) {
        first_frames_ = kFirstProfiles;
        return wait({placed.begin() + std::ptrdiff_t(count), placed.end()}, read, context);
      }
    }
    if (auto seen = look(context); !seen) {
      if (seen.error().code != ErrorCode::kTooFewPoints) return seen;
      look_later();
    }
    if (!look_) return wait({placed.begin() + std::ptrdiff_t(count), placed.end()}, read, context);
    return work({placed.begin() + std::ptrdiff_t(count), placed.end()}, read, context);
  }

  Result<bool> are_profiles() const {
    TURNSCAN_ASSIGN(const auto sheets, find_sheets(waiting_, header_, recipe_.rays));
    return !sheets.empty() && std::all_of(sheets.begin(), sheets.end(),
                                          [](const auto& sheet) { return sheet.has_value(); });
  }

  /// Nothing stands on the platter yet: waits for more frames, and forgets the oldest of many.
  void look_later() {
    constexpr std::size_t kMost = 512;
    if (waiting_.size() < kMost) {
      first_frames_ = 2 * waiting_.size();
      return;
    }
    const auto half = std::ptrdiff_t(waiting_.size() / 2);
    forgotten_ += std::size_t(half);
    waiting_.erase(waiting_.begin(), waiting_.begin() + half);
    waiting_poses_.erase(waiting_poses_.begin(), waiting_poses_.begin() + half);
  }

  /// Chooses crop and scale, and works on the frames that waited for it.
  Result<> look(const RunContext& context) {
    TURNSCAN_ASSIGN(FirstLook look,
                    look_at(waiting_, waiting_poses_, header_, recipe_.rays, options_.crop));
    out_.frame_spacing_m = look.spacing_m;
    out_.sensor_noise_m = look.noise_m;
    out_.choices = look.choices;
    out_.notes = look.notes;
    recipe_.cylinder = look.cylinder;
    if (volumetric()) {
      const std::lock_guard lock(mutex_);
      TURNSCAN_ASSIGN(volume_, VolumetricStream::create(header_, options_, look, recipe_.rays));
    } else {
      points_.emplace(options_, look, !any_grid(waiting_));
    }
    look_ = std::move(look);
    std::vector<Placed> placed;
    for (std::size_t i = 0; i < waiting_.size(); ++i)
      placed.push_back({i, waiting_[i].info, waiting_poses_[i]});
    const std::vector<Frame> frames = std::move(waiting_);
    waiting_.clear();
    waiting_poses_.clear();
    TURNSCAN_TRY(work(
        placed, [&](std::size_t i) -> Result<Frame> { return frames[i]; }, context));
    return volumetric() ? volume_->begin() : Result<>();
  }

  Result<> work(const std::vector<Placed>& placed, const FrameReader& read,
                const RunContext& context) {
    return volumetric() ? add_views(placed, read, context) : add_points(placed, read, context);
  }

  /// What a frame gives: a view, or a profile that waits for those after it.
  struct Seen {
    DepthView view;
    std::optional<Profile> profile;
    std::uint64_t returns = 0, kept = 0;
  };

  Result<Seen> see(const Frame& frame, const Pose& T_table_sensor) const {
    Seen seen;
    const std::size_t s = frame.info.sensor;
    if (!look_->sheets.at(s)) {
      TURNSCAN_ASSIGN(seen.view, volume_->view(frame, T_table_sensor));
      seen.returns = seen.view.returns;
      seen.kept = seen.view.kept;
      return seen;
    }
    TURNSCAN_ASSIGN(FramePoints points, points_of(frame, header_.sensors[s], recipe_.rays[s]));
    seen.returns = points.cloud.size();
    points = in_sheet_order(points, *look_->sheets[s]);
    if (look_->cylinder) points = crop(points, SensorCrop(*look_->cylinder, T_table_sensor));
    seen.kept = points.cloud.size();
    seen.profile = Profile{std::move(points), T_table_sensor};
    return seen;
  }

  Result<> add_views(const std::vector<Placed>& placed, const FrameReader& read,
                     const RunContext& context) {
    std::vector<Result<Seen>> seen(placed.size());
    parallel_for(placed.size(), 1, [&](std::size_t i) {
      if (context.cancelled()) return;
      seen[i] = read(placed[i].position).and_then([&](const Frame& frame) {
        return see(frame, placed[i].T_table_sensor);
      });
      context.advance();
    });
    TURNSCAN_TRY(context.check());
    for (const auto& one : seen) TURNSCAN_TRY(one);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      ++out_.frames;
      out_.returns += seen[i]->returns;
      out_.cropped += seen[i]->kept;
      const std::uint32_t sensor = placed[i].info.sensor;
      if (seen[i]->profile) {
        TURNSCAN_TRY(add_group(groups_[sensor].add(std::move(*seen[i]->profile)), sensor));
      } else {
        TURNSCAN_TRY(volume_->add(std::move(seen[i]->view), sensor));
      }
    }
    return {};
  }

  Result<> add_group(const std::vector<Profile>& group, std::uint32_t sensor) {
    if (group.empty()) return {};
    return volume_->add(volume_->view(group, *look_->sheets[sensor]), sensor);
  }

  Result<> add_points(const std::vector<Placed>& placed, const FrameReader& read,
                      const RunContext& context) {
    std::vector<Result<FramePart>> parts(placed.size());
    parallel_for(placed.size(), 1, [&](std::size_t i) {
      if (context.cancelled()) return;
      parts[i] = read(placed[i].position).and_then([&](const Frame& frame) {
        return process_frame(frame, recipe_, placed[i].T_table_sensor);
      });
      context.advance();
    });
    TURNSCAN_TRY(context.check());
    for (const auto& part : parts) TURNSCAN_TRY(part);
    std::vector<FramePart> seen;
    std::vector<Viewpoint> viewpoints;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Viewpoint& own = header_.sensors[placed[i].info.sensor].viewpoint;
      viewpoints.push_back(own.transformed(placed[i].T_table_sensor));
      seen.push_back(std::move(*parts[i]));
    }
    TURNSCAN_TRY(points_->add(seen, viewpoints, whole_, context));
    for (const FramePart& part : seen) {
      ++out_.frames;
      out_.returns += part.returns;
      out_.cropped += part.cropped;
    }
    return {};
  }

  SequenceHeader header_;
  ReconstructOptions options_;
  FramePoser poser_;
  FrameRecipe recipe_;
  std::size_t first_frames_;
  std::optional<FrameInfo> first_;  ///< of those used, dropped ones too
  std::vector<Frame> waiting_;
  std::vector<Pose> waiting_poses_;
  std::size_t forgotten_ = 0;  ///< frames without an object, before the first look
  std::optional<FirstLook> look_;
  bool whole_ = false;                             ///< the first look sees all frames
  std::map<std::uint32_t, ProfileGroups> groups_;  ///< of line scanners
  std::optional<PointStream> points_;
  std::mutex mutex_;  ///< guards the pointer volume_
  std::unique_ptr<VolumetricStream> volume_;
  Reconstruction out_;
};

ReconstructionStream::ReconstructionStream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ReconstructionStream::ReconstructionStream(ReconstructionStream&&) noexcept = default;
ReconstructionStream& ReconstructionStream::operator=(ReconstructionStream&&) noexcept = default;
ReconstructionStream::~ReconstructionStream() = default;

Result<ReconstructionStream> ReconstructionStream::create(const SequenceHeader& header,
                                                          const ReconstructOptions& options) {
  TURNSCAN_TRY(check_options(options));
  return ReconstructionStream(std::make_unique<Impl>(header, options));
}

Result<> ReconstructionStream::add(const std::vector<FrameInfo>& infos, const FrameReader& read,
                                   const RunContext& context) {
  return impl_->add(infos, read, context);
}

Result<> ReconstructionStream::add(const std::vector<Frame>& frames, const RunContext& context) {
  std::vector<FrameInfo> infos;
  for (const Frame& frame : frames) infos.push_back(frame.info);
  return impl_->add(
      infos, [&](std::size_t i) -> Result<Frame> { return frames[i]; }, context);
}

Result<TriangleMesh> ReconstructionStream::preview(const RunContext& context) const {
  return impl_->preview(context);
}

Result<Reconstruction> ReconstructionStream::finish(const StageSink& sink,
                                                    const RunContext& context) {
  return impl_->finish(sink, context);
}

}  // namespace turnscan
