#include <filesystem>
#include <limits>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/geometry/rays/coverage.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/workflow/plan/plan_trial.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan::workflow {

namespace {

namespace fs = std::filesystem;

constexpr int kJudgedSamples = 40000;
constexpr std::uint64_t kTaskBytes = 600u << 20;

/// Seen in any of the passes; points are in the table's frame of the first.
SeenTest seen_in_any(const Simulation& simulation, const RunContext& context) {
  return
      [&simulation, &context](std::span<const Vec3f> points,
                              std::span<const Vec3f> normals) -> Result<std::vector<std::uint8_t>> {
        std::vector<std::uint8_t> seen(points.size(), 0);
        const Pose T_first = simulation.placed.front().T_table_object.inverse();
        for (std::size_t k = 0; k < simulation.scan.count(); ++k) {
          const VirtualScan& pass = simulation.scan.pass(k);
          const Pose T = pass.T_table_given() * simulation.placed[k].T_table_object * T_first *
                         simulation.scan.pass(0).T_table_given().inverse();
          std::vector<Vec3f> p(points.size()), n(points.size());
          for (std::size_t i = 0; i < p.size(); ++i) {
            p[i] = (T * points[i].cast<double>()).cast<float>();
            n[i] = (T.linear() * normals[i].cast<double>()).cast<float>();
          }
          TURNSCAN_ASSIGN(const auto mask, seen_mask(pass.scene(), pass, p, n, context));
          for (std::size_t i = 0; i < seen.size(); ++i) seen[i] |= mask[i];
        }
        return seen;
      };
}

Result<double> median_error(const TriangleMesh& mesh, const Simulation& simulation,
                            const RunContext& context) {
  EvaluateOptions options;
  options.samples = kJudgedSamples;
  TURNSCAN_ASSIGN(const Evaluation result,
                  evaluate(mesh, simulation.scan.pass(0).objects().front(), options,
                           seen_in_any(simulation, context), context));
  return result.accuracy.median;
}

/// Trial of a recorded scan; made() returns its mesh.
template <class Made>
Result<PlanTrial> judged(const Simulation& simulation, const Made& made,
                         const RunContext& context) {
  PlanTrial trial;
  trial.median_error_m = std::numeric_limits<double>::quiet_NaN();
  TURNSCAN_ASSIGN(const CoverageMap map, coverage_of(simulation, {}, context));
  trial.covered = map.covered();
  const Result<TriangleMesh> mesh = made();
  const Result<double> error =
      mesh ? median_error(*mesh, simulation, context) : tl::unexpected<Error>(mesh.error());
  TURNSCAN_TRY(context.check());
  if (error)
    trial.median_error_m = *error;
  else
    trial.failure = error.error().message;
  return trial;
}

}  // namespace

Result<std::vector<PlanTrial>> TrialRunner::run_here(const std::vector<TrialScene>& scenes,
                                                     const RunContext& context) const {
  std::vector<PlanTrial> out;
  for (const TrialScene& one : scenes) {
    TURNSCAN_ASSIGN(const Simulation simulation,
                    prepare_simulation(one.scene, *one.object, context));
    TURNSCAN_ASSIGN(PlanTrial trial,
                    judged(
                        simulation,
                        [&]() -> Result<TriangleMesh> {
                          ReconstructRequest request;
                          request.judge = false;
                          TURNSCAN_ASSIGN(ReconstructRun run,
                                          run_reconstruction(simulation.scan, request, context));
                          if (!run.reconstruction.objects.empty())
                            return run.reconstruction.objects.front().mesh;
                          TURNSCAN_TRY(check_joined(run.apart));  // no separate passes
                          return fail(ErrorCode::kMissingData, "no object was found");
                        },
                        context));
    out.push_back(std::move(trial));
  }
  return out;
}

Result<> TrialRunner::run_tasks(const std::string& folder, const std::vector<BatchTask>& tasks,
                                const RunContext& context) const {
  if (tasks.empty()) return {};
  TURNSCAN_TRY(save_batch(folder, tasks));
  BatchRequest batch;
  batch.folder = folder;
  batch.options = request_.engine;
  batch.program = request_.program;
  batch.on_status = request_.on_status;
  TURNSCAN_TRY(run_batch(batch, context));
  return {};
}

Result<std::vector<PlanTrial>> TrialRunner::run_batches(const std::vector<TrialScene>& scenes,
                                                        const RunContext& context) {
  const fs::path folder = fs::absolute(request_.folder) / "trials";
  std::error_code error;
  fs::create_directories(folder / "scenes", error);
  if (error)
    return fail_at(folder.string(), ErrorCode::kIo, "the folder of the trials cannot be made: {}",
                   error.message());
  for (const TrialScene& one : scenes) {
    const fs::path file = folder / "scenes" / (one.name + ".toml");
    TURNSCAN_TRY(write_file_atomically(file, scene_toml(one.scene)));
    BatchTask& task = scans_.emplace_back();
    task.name = one.name;
    task.command = "simulate";
    const bool builtin = one.scene.object.starts_with("builtin:");
    task.inputs = {builtin ? one.scene.object : fs::absolute(one.scene.object).string()};
    task.options = {{"scene", file.string()}};
    task.frames = std::uint64_t(one.scene.motion.frames.value_or(1));
    task.peak_bytes = kTaskBytes;
  }
  TURNSCAN_TRY(run_tasks((folder / "scans").string(), scans_, context));
  const auto result = [&](const char* batch, const std::string& name, const char* file) {
    return folder / batch / "tasks" / name / "result" / file;
  };
  for (const TrialScene& one : scenes) {
    const fs::path recording = result("scans", one.name, "recording");
    if (!fs::exists(recording, error)) continue;
    BatchTask& task = meshes_.emplace_back();
    task.name = one.name;
    task.inputs = {recording.string()};
    task.frames = std::uint64_t(one.scene.motion.frames.value_or(1));
    task.peak_bytes = kTaskBytes;
  }
  TURNSCAN_TRY(run_tasks((folder / "meshes").string(), meshes_, context));
  std::vector<PlanTrial> out;
  for (const TrialScene& one : scenes) {
    TURNSCAN_ASSIGN(const Simulation simulation,
                    prepare_simulation(one.scene, *one.object, context));
    const fs::path mesh = result("meshes", one.name, "mesh.ply");
    const auto made = [&]() -> Result<TriangleMesh> {
      if (fs::exists(mesh, error)) return read_mesh(mesh, {}, context);
      return fail(ErrorCode::kMissingData, "no mesh; see 'turnscan batch status {}'",
                  (folder / "meshes").string());
    };
    TURNSCAN_ASSIGN(PlanTrial trial, judged(simulation, made, context));
    out.push_back(std::move(trial));
  }
  return out;
}

Result<std::vector<PlanTrial>> TrialRunner::run(const std::vector<TrialScene>& scenes,
                                                const RunContext& context) {
  if (request_.folder.empty() || request_.program.empty()) return run_here(scenes, context);
  return run_batches(scenes, context);
}

}  // namespace turnscan::workflow
