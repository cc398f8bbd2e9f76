#include <turnscan/api/named_options.hpp>
#include <turnscan/api/reconstruct.hpp>
#include <turnscan/api/reconstructed_scan.hpp>

namespace turnscan {

namespace {

/// What the command line takes beside the options of the stages.
OptionTable describe(ReconstructRequest& request) {
  OptionTable table = describe(request.options);
  table
      .text("calibration", request.calibration,
            "Source of the turntable's pose and the angles: auto, recorded or motion")
      .text("turntable", request.turntable,
            "Calibration file to use instead of the recording's turntable")
      .flag("allow-open", request.allow_open, "Accept meshes that are not watertight");
  return table;
}

}  // namespace

ReconstructedScan::ReconstructedScan(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

const Reconstruction& ReconstructedScan::result() const { return impl_->run.reconstruction; }

std::string ReconstructedScan::report() const { return run_report(impl_->run, impl_->options); }

Result<std::vector<std::string>> ReconstructedScan::write(const OutputFiles& files,
                                                          const RunContext& context) const {
  ReconstructFiles wanted;
  wanted.mesh = files.mesh;
  wanted.mesh_options.up = files.up;
  wanted.report = files.report;
  wanted.page = files.page;
  TURNSCAN_TRY(check_outputs(wanted));
  return write_outputs(wanted, impl_->run, impl_->options, context);
}

Result<ReconstructedScan> reconstruct(const FrameSequence& frames, const Options& options,
                                      const RunContext& context) {
  return reconstruct(std::vector<NamedFrames>{{"", &frames}}, options, context);
}

Result<ReconstructedScan> reconstruct(const std::vector<NamedFrames>& recordings,
                                      const Options& options, const RunContext& context) {
  if (recordings.empty())
    return fail(ErrorCode::kInvalidOption, "recordings: there is none; give one");
  ReconstructRequest request;
  TURNSCAN_TRY(api::set_fields(describe(request), options));
  std::vector<NamedSequence> named;
  for (const NamedFrames& recording : recordings)
    named.push_back({recording.name, recording.frames});
  auto made = std::make_shared<ReconstructedScan::Impl>();
  TURNSCAN_ASSIGN(made->run, run_reconstruction(named, request, context));
  made->options = request.options;
  TURNSCAN_TRY(check_joined(made->run.apart));
  return ReconstructedScan(std::move(made));
}

std::vector<OptionDescription> reconstruct_options() {
  ReconstructRequest request;
  return api::describe_fields(describe(request));
}

}  // namespace turnscan
