#include <algorithm>
#include <mutex>
#include <turnscan/geometry/mesh/self_intersections.hpp>
#include <turnscan/reconstruction/estimation/first_frames.hpp>
#include <turnscan/reconstruction/finishing/fewer_triangles.hpp>
#include <turnscan/reconstruction/finishing/finishing.hpp>
#include <turnscan/reconstruction/method.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan {

namespace {

Result<> check_options(const ReconstructOptions& options) {
  ReconstructOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  TURNSCAN_TRY(objects_to_keep(options.components));
  if (options.voxels.size_m && options.voxels.grid)
    return fail(ErrorCode::kInvalidOption, "voxel-size and voxel-grid are both given; give one");
  if (options.finish.triangles == "all" && options.finish.max_error_m)
    return fail(ErrorCode::kInvalidOption,
                "triangles = all and max-error exclude each other; give one");
  if (options.finish.holes != Holes::kSmooth && !options.surface.repair &&
      options.surface.method != SurfaceMethod::kVolumetric)
    return fail(ErrorCode::kInvalidOption,
                "holes: without the repair it is not known what was measured; leave --repair on");
  return {};
}

Result<> check_sensor(const FrameInfo& info, const SequenceHeader& header) {
  if (info.sensor < header.sensors.size()) return {};
  return fail(ErrorCode::kFormat, "frame {}: there is no sensor {}", info.index, info.sensor);
}

/// Frames with poses of their own are not restricted: the poses relate them.
Result<> check_pass(const FrameInfo& info, const FrameInfo& first, bool poses_within_pass) {
  if (info.pass == first.pass || (info.T_table_sensor && !poses_within_pass)) return {};
  return fail(
      ErrorCode::kInvalidOption,
      "frames {} and {} are of passes {} and {}, in which the object lies differently; give "
      "--pass to say which to use",
      first.index, info.index, first.pass, info.pass);
}

}  // namespace

/// Computes the poses of the frames and keeps the first ones until the scale is known; then passes
/// frames to the method.
class ReconstructionStream::Impl {
 public:
  Impl(const SequenceHeader& header, const ReconstructOptions& options,
       std::vector<PassPlacement> passes)
      : header_(header),
        options_(options),
        passes_(std::move(passes)),
        entry_(method_entry(options_.surface.method)),
        rays_(ray_tables(header_)),
        poser_(header_, options_.merge.speed_rad_s) {
    first_frames_.emplace(header_, rays_, options_.crop, options_.color);
    for (const PassPlacement& pass : passes_)
      out_.passes.push_back({pass.name, pass.T_object_table, 0, pass.found});
  }

  Result<> add(const std::vector<FrameInfo>& infos, const FrameReader& read,
               const RunContext& context) {
    const StageTimer timer(out_.stages, "frames");
    TURNSCAN_ASSIGN(const Selection selected, select(infos));
    std::span<const PosedFrame> frames(selected.frames);
    while (!frames.empty()) {
      const std::size_t count = frames_of_one_pass(frames);
      if (!passes_.empty()) TURNSCAN_TRY(begin_pass(frames.front().info.pass, context));
      TURNSCAN_TRY(add_of_pass(frames.first(count), read, context));
      if (!passes_.empty()) out_.passes[pass_].frames += count;
      frames = frames.subspan(count);
    }
    out_.dropped_frames += selected.dropped;
    context.advance(selected.dropped + selected.left_out);
    return {};
  }

  Result<TriangleMesh> preview(const RunContext& context) {
    if (!entry_.previews)
      return fail(ErrorCode::kInvalidOption,
                  "preview: only --method volumetric shows the growing surface");
    const Method* method = nullptr;
    {
      const std::lock_guard lock(mutex_);
      method = method_.get();
    }
    return method == nullptr ? TriangleMesh() : method->preview(context);
  }

  Result<Reconstruction> finish(const StageSink& sink, const RunContext& context) {
    TURNSCAN_TRY(context.check());
    if (first_frames_) TURNSCAN_TRY(start_with_what_is_there(context));
    for (const std::string& name : unused_options(options_))
      out_.notes.push_back(fmt::format("option {}: this method does not use it", name));
    if (discarded_ > 0)
      out_.notes.push_back(
          fmt::format("the first {} frames show nothing on the platter", discarded_));
    TURNSCAN_TRY(method_->finish(sink, context, out_));
    TURNSCAN_TRY(finishing::finish_objects(options_.finish, out_, context));
    TURNSCAN_TRY(finishing::reduce_triangles(options_, out_, context));
    for (ObjectResult& object : out_.objects)
      object.check.crossing_edges = self_intersections(object.mesh, {}, context).edges;
    TURNSCAN_TRY(context.check());
    return std::move(out_);
  }

 private:
  /// The frames that are used of those passed in.
  struct Selection {
    std::vector<PosedFrame> frames;
    std::size_t dropped = 0;
    std::size_t left_out = 0;  ///< of other passes
  };

  Result<Selection> select(const std::vector<FrameInfo>& infos) {
    Selection out;
    const std::optional<int>& pass = options_.merge.pass;
    std::uint32_t last = pass_;
    for (std::size_t i = 0; i < infos.size(); ++i) {
      TURNSCAN_TRY(check_sensor(infos[i], header_));
      if (pass && infos[i].pass != std::uint32_t(*pass)) {
        ++out.left_out;
        continue;
      }
      if (!first_) first_ = infos[i];
      TURNSCAN_TRY(passes_.empty() ? check_pass(infos[i], *first_, header_.poses_within_pass)
                                   : check_placed(infos[i], last));
      TURNSCAN_ASSIGN(const Pose pose, poser_(infos[i]));
      if (infos[i].status == FrameStatus::kDropped)
        ++out.dropped;
      else
        out.frames.push_back({i, infos[i], pose});
    }
    return out;
  }

  /// Passes come one after another; last: pass of the previous frame.
  Result<> check_placed(const FrameInfo& info, std::uint32_t& last) const {
    if (info.pass >= passes_.size())
      return fail(ErrorCode::kInvalidOption, "frame {} is of pass {}, which has no place",
                  info.index, info.pass);
    if (info.pass < last)
      return fail(ErrorCode::kFormat, "frame {} of pass {} comes after those of pass {}",
                  info.index, info.pass, last);
    last = info.pass;
    return {};
  }

  /// Number of frames before those of another pass, if passes are fused.
  std::size_t frames_of_one_pass(std::span<const PosedFrame> frames) const {
    if (passes_.empty()) return frames.size();
    const auto next = std::find_if(frames.begin(), frames.end(), [&](const PosedFrame& frame) {
      return frame.info.pass != frames.front().info.pass;
    });
    return std::size_t(next - frames.begin());
  }

  /// The pass is cropped by its own table, which has to be found in its first frames.
  Result<> begin_pass(std::uint32_t pass, const RunContext& context) {
    if (pass == pass_ && pass_header_) return {};
    if (pass_header_ && first_frames_) TURNSCAN_TRY(start_with_what_is_there(context));
    pass_ = pass;
    pass_header_ = header_;
    pass_header_->turntable = passes_[pass].turntable;
    first_frames_.emplace(*pass_header_, rays_, options_.crop, options_.color);
    return {};
  }

  Result<> add_of_pass(std::span<const PosedFrame> frames, const FrameReader& read,
                       const RunContext& context) {
    if (first_frames_) return buffer_until_scale_known(frames, read, context);
    return method_->add(frames, read, context, out_);
  }

  /// Keeps frames until there are enough to estimate the scale; the remaining ones then go to the
  /// method.
  Result<> buffer_until_scale_known(std::span<const PosedFrame> frames, const FrameReader& read,
                                    const RunContext& context) {
    while (first_frames_) {
      TURNSCAN_ASSIGN(const std::size_t kept, first_frames_->keep(frames, read, context));
      frames = frames.subspan(kept);
      TURNSCAN_ASSIGN(const bool enough, first_frames_->enough());
      if (!enough) {
        if (frames.empty()) return {};
        continue;
      }
      const auto estimate = first_frames_->estimate();
      if (estimate) {
        TURNSCAN_TRY(start_method(*estimate, false, context));
      } else if (estimate.error().code == ErrorCode::kTooFewPoints) {
        first_frames_->ask_for_more();
      } else {
        return tl::unexpected<Error>(estimate.error());
      }
    }
    return method_->add(frames, read, context, out_);
  }

  /// Called if the scan has ended before its scale was known.
  Result<> start_with_what_is_there(const RunContext& context) {
    const bool none = first_frames_->frames().empty();
    if (none && options_.merge.pass && !first_)
      return fail(ErrorCode::kInvalidOption, "the recording has no frame of pass {}",
                  *options_.merge.pass);
    if (none) return fail(ErrorCode::kTooFewPoints, "the recording has no frame that can be used");
    TURNSCAN_ASSIGN(const auto estimate, first_frames_->estimate());
    return start_method(estimate, passes_.empty(), context);
  }

  /// Creates the method, or starts its next pass, and adds the buffered frames. whole: there will
  /// be no others.
  Result<> start_method(const estimation::ScanEstimate& estimate, bool whole,
                        const RunContext& context) {
    const bool first = method_ == nullptr;
    if (first) {
      TURNSCAN_TRY(make_method(estimate, whole));
    } else {
      note_pass(estimate);
      TURNSCAN_TRY(method_->begin_pass({passes_[pass_].T_object_table, estimate, share_of_table()},
                                       context));
    }
    const std::vector<Frame>& frames = first_frames_->frames();
    TURNSCAN_TRY(method_->add(
        first_frames_->posed_frames(), [&](std::size_t i) -> Result<Frame> { return frames[i]; },
        context, out_));
    discarded_ += first_frames_->discarded();
    first_frames_.reset();
    return first ? method_->begin(context) : Result<>();
  }

  Result<> make_method(const estimation::ScanEstimate& estimate, bool whole) {
    out_.frame_spacing_m = estimate.spacing_m;
    out_.sensor_noise_m = estimate.noise_m;
    out_.choices = estimate.choices;
    out_.notes = estimate.notes;
    std::optional<Pose> T_object_table;
    if (!passes_.empty()) T_object_table = passes_[pass_].T_object_table;
    const std::lock_guard lock(mutex_);
    TURNSCAN_ASSIGN(
        method_, entry_.create({header_, options_, rays_, estimate, first_frames_->frames(), whole,
                                T_object_table, share_of_table()}));
    return {};
  }

  const ObjectPartition* share_of_table() const {
    return passes_.empty() || !passes_[pass_].share ? nullptr : &*passes_[pass_].share;
  }

  /// Records the estimate from a further pass's first frames.
  void note_pass(const estimation::ScanEstimate& estimate) {
    for (ResolvedParameter choice : estimate.choices) {
      choice.reason = fmt::format("{}: {}", passes_[pass_].name, choice.reason);
      out_.choices.push_back(std::move(choice));
    }
    for (const std::string& note : estimate.notes)
      out_.notes.push_back(fmt::format("{}: {}", passes_[pass_].name, note));
  }

  SequenceHeader header_;
  ReconstructOptions options_;
  std::vector<PassPlacement> passes_;  ///< that are fused
  const MethodEntry& entry_;
  std::vector<RayTable> rays_;  ///< per sensor
  FramePoser poser_;
  std::optional<FrameInfo> first_;             ///< of the used frames, including dropped ones
  std::uint32_t pass_ = 0;                     ///< the current pass
  std::optional<SequenceHeader> pass_header_;  ///< with its table, if passes are fused
  std::optional<estimation::FirstFrames> first_frames_;  ///< until their scale is known
  std::size_t discarded_ = 0;
  std::mutex mutex_;  ///< guards the pointer method_
  std::unique_ptr<Method> method_;
  Reconstruction out_;
};

ReconstructionStream::ReconstructionStream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ReconstructionStream::ReconstructionStream(ReconstructionStream&&) noexcept = default;
ReconstructionStream& ReconstructionStream::operator=(ReconstructionStream&&) noexcept = default;
ReconstructionStream::~ReconstructionStream() = default;

Result<ReconstructionStream> ReconstructionStream::create(const SequenceHeader& header,
                                                          const ReconstructOptions& options,
                                                          std::vector<PassPlacement> passes) {
  TURNSCAN_TRY(check_options(options));
  if (!passes.empty() && options.merge.pass)
    return fail(ErrorCode::kInvalidOption, "pass = {}: all passes are fused; leave it out",
                *options.merge.pass);
  return ReconstructionStream(std::make_unique<Impl>(header, options, std::move(passes)));
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

Result<> ReconstructionStream::add(const FrameSequence& sequence, std::size_t first,
                                   const RunContext& context) {
  // Enough to keep the cores busy, few enough to keep memory bounded.
  constexpr std::size_t kFramesAtOnce = 64;
  const auto& frames = sequence.frames();
  context.begin_phase("read frames", frames.size() - first);
  for (; first < frames.size(); first += kFramesAtOnce) {
    const std::size_t end = std::min(first + kFramesAtOnce, frames.size());
    const std::vector<FrameInfo> infos(frames.begin() + std::ptrdiff_t(first),
                                       frames.begin() + std::ptrdiff_t(end));
    TURNSCAN_TRY(add(
        infos, [&](std::size_t i) { return sequence.read(first + i); }, context));
  }
  return {};
}

Result<TriangleMesh> ReconstructionStream::preview(const RunContext& context) const {
  return impl_->preview(context);
}

Result<Reconstruction> ReconstructionStream::finish(const StageSink& sink,
                                                    const RunContext& context) {
  return impl_->finish(sink, context);
}

}  // namespace turnscan
