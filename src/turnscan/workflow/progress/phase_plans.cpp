#include <algorithm>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/calibration/calibration_choice.hpp>
#include <turnscan/workflow/passes/joined_frames.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>

// Weights are seconds measured with the built-in doll, a turn of 920 depth images of 512 x 424
// pixels, on two cores.

namespace turnscan {

PhasePlan platter_phases() { return {{"average frames", 0.2}, {"look for the platter", 2.0}}; }

PhasePlan motion_phases() {
  return joined({platter_phases(),
                 {{"sample frames", 4.0}, {"find the motion", 18.0}},
                 platter_phases(),
                 {{"sample frames", 0.6}, {"compare frames", 1.7}}});
}

namespace {

constexpr int kFramesOfATurn = 920;
constexpr double kReadFrame = 0.015, kRecordTurn = 30.0, kTexture = 8.0;

/// Checks of the recorded turntable.
PhasePlan check_phases() {
  return joined({platter_phases(),
                 {{"sample frames", 0.6},
                  {"compare frames", 1.7},
                  {"average frames", 0.1},
                  {"sample frames", 0.2},
                  {"average frames", 0.1},
                  {"sample frames", 0.6}}});
}

/// The turntable is found in the recording, or the recorded one is checked.
PhasePlan calibration_phases(const FrameSequence& frames, const ReconstructRequest& request) {
  if (request.calibration == "motion" ||
      (request.calibration == "auto" &&
       !frame_poses(frames.header(), frames.frames(), request.options.merge.speed_rad_s)))
    return motion_phases();
  return check_phases();
}

/// Advice for the next pass, and the inputs of the verdict.
PhasePlan judge_phases() {
  return joined({{{"advise", 2.0}}, platter_phases(), {{"coverage", 1.0}}});
}

PhasePlan refine_phases(const RefineOptions& options) {
  return PhasePlan(std::size_t(std::max(options.iterations, 0)), {"refine candidates", 0.9});
}

PhasePlan of_points(const ReconstructOptions& options) {
  const PhasePlan common = joined({{{"voxels", 0.1}, {"candidate points", 0.1}, {"normals", 1.4}},
                                   refine_phases(options.refine)});
  if (options.surface.method == SurfaceMethod::kPoisson)
    return joined({common, {{"surface", 3.5}, {"repair", 0.4}}});
  return joined({common,
                 {{"surface", 11.0},
                  {"measure distances", 0.1},
                  {"measure distances", 6.0},
                  {"wrap", 10.0}}});
}

}  // namespace

PhasePlan surface_phases(const ReconstructOptions& options, std::size_t frames) {
  PhasePlan plan{{"read frames", kReadFrame * double(std::max<std::size_t>(frames, 1))}};
  if (options.surface.method == SurfaceMethod::kVolumetric)
    plan = joined({plan, {{"closing", 2.0}, {"fit", 6.5}}});
  else
    plan = joined({plan, of_points(options)});
  if (options.finish.triangles != "all" || options.finish.max_error_m)
    plan.push_back({"simplify", 1.0});
  if (options.texture.texture) plan.push_back({"texture", kTexture});
  return plan;
}

PhasePlan page_phases() { return {{"page", 9.0}}; }

PhasePlan reconstruct_phases(const std::vector<NamedSequence>& recordings,
                             const ReconstructRequest& request) {
  PhasePlan placing, singly;
  std::size_t passes = 0, frames = 0;
  for (const NamedSequence& recording : recordings) {
    placing = joined({placing, calibration_phases(*recording.frames, request)});
    const std::size_t own = request.options.merge.pass ? 1 : passes_of(*recording.frames).size();
    const std::size_t count = recording.frames->frames().size();
    passes += own;
    frames += count;
    for (std::size_t i = 0; i < own; ++i)
      singly = joined({singly, surface_phases(request.options, count / own)});
  }
  if (passes > 1) placing = joined({placing, singly, {{"join passes", 4.0 * double(passes)}}});
  return joined({placing, surface_phases(request.options, frames), judge_phases()});
}

PhasePlan simulate_phases(const SimulateRequest& request) {
  PhasePlan plan{{"read object", 2.0}};
  const double frames = request.scene.motion.frames.value_or(kFramesOfATurn);
  if (!request.recording.empty()) plan.push_back({"write recording", 0.025 * frames});
  if (request.samples) plan.push_back({"true samples", 0.027 * frames});
  if (!request.coverage.empty())
    plan = joined({plan, {{"coverage", 0.016 * frames}, {"reasons", 0.2}}});
  return plan;
}

PhasePlan capture_phases() {
  return {{"open device", 1.0}, {"connect motor", 1.0}, {"record", kRecordTurn}};
}

PhasePlan scan_phases(const ScanRequest& request) {
  PhasePlan plan{{"open device", 1.0}};
  if (!request.setup.motor_port.empty()) plan.push_back({"connect motor", 1.0});
  plan = joined({plan, {{"look for the turntable", 0.5}}, platter_phases()});
  const PhasePlan wait{{"wait for an object on the platter", 0.0}};
  const bool speed_known = request.setup.options.speed_rad_s.has_value();
  const auto frames = std::size_t(kFramesOfATurn);
  plan = joined({plan, wait, {{"record", kRecordTurn}}});
  if (!speed_known) plan = joined({plan, motion_phases()});
  plan = joined({plan, surface_phases(request.reconstruct, frames)});
  if (speed_known) plan = joined({plan, check_phases()});
  plan = joined({plan, judge_phases()});
  for (int pass = 1; pass < request.passes.value_or(1); ++pass)
    plan = joined({plan,
                   wait,
                   {{"record another side", kRecordTurn}},
                   surface_phases(request.reconstruct, frames),
                   {{"join passes", 4.0}},
                   surface_phases(request.reconstruct, frames),
                   judge_phases()});
  return request.page.empty() ? plan : joined({plan, page_phases()});
}

PhasePlan evaluate_phases(const EvaluateOptions& options) {
  PhasePlan plan;
  if (options.align != Align::kNone) plan.push_back({"align", 0.8});
  return joined({plan, {{"sample", 0.4}, {"accuracy", 1.2}, {"completeness", 1.0}}});
}

PhasePlan seen_phases() { return {{"seen", 0.1}, {"coverage", 2.1}, {"coverage", 3.8}}; }

}  // namespace turnscan
