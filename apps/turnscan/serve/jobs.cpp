#include "serve/jobs.hpp"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/scan/capture_outcome.hpp>
#include <turnscan/workflow/text/capture_text.hpp>
#include <turnscan/workflow/text/reconstruction_text.hpp>

namespace turnscan::serve {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRecordSteps = 1000;  // of the phase "record"
constexpr std::chrono::milliseconds kBetweenFrames{200};
constexpr const char* kFirstMesh = "mesh.glb";  // what the page draws
constexpr const char* kOtherMeshes[] = {"mesh.3mf", "mesh.stl", "mesh.ply"};

ReconstructFiles files_in(const fs::path& folder, const ScanRequest& settings) {
  ReconstructFiles files;
  files.mesh = (folder / kFirstMesh).string();
  files.mesh_options = settings.mesh_options;
  files.report = (folder / "report.json").string();
  files.page = (folder / "report.html").string();
  files.advice_picture = (folder / "advice.png").string();
  return files;
}

}  // namespace

Jobs::Jobs(ScanStore store, ScanRequest settings)
    : store_(std::move(store)), settings_(std::move(settings)) {
  // So that reconstructing the recording again gives the same bytes.
  settings_.ahead.share.reset();
}

Jobs::~Jobs() {
  end(std::chrono::milliseconds(0));
  if (thread_.joinable()) thread_.join();
}

Result<> Jobs::check_free() const {
  if (!running_id().empty())
    return fail(ErrorCode::kDeviceBusy, "the rig is at work; wait for it or cancel");
  return {};
}

Result<std::string> Jobs::new_scan() {
  TURNSCAN_TRY(check_free());
  return store_.create();
}

Result<std::string> Jobs::start_scan(const std::vector<std::string>& devices,
                                     std::optional<int> passes) {
  const std::lock_guard starting(starting_);
  TURNSCAN_ASSIGN(const std::string id, new_scan());
  TURNSCAN_ASSIGN(const fs::path folder, store_.folder(id));
  ScanRequest request = settings_;
  request.setup.devices = devices;
  request.passes = passes;
  begin_scan(id, std::move(request), folder);
  return id;
}

Result<std::string> Jobs::start_recording(const std::vector<std::string>& devices) {
  const std::lock_guard starting(starting_);
  TURNSCAN_ASSIGN(const std::string id, new_scan());
  TURNSCAN_ASSIGN(const fs::path folder, store_.folder(id));
  CaptureSetup setup = settings_.setup;
  setup.devices = devices;
  setup.options.speed_rad_s = settings_.reconstruct.merge.speed_rad_s;
  start(id, "record", capture_phases(),
        [this, setup, recording = (folder / "recording").string()](Job& job) {
          return record(setup, recording, job);
        });
  return id;
}

Result<> Jobs::resume_scan(const std::string& id, const std::vector<std::string>& devices) {
  const std::lock_guard starting(starting_);
  TURNSCAN_TRY(check_free());
  TURNSCAN_ASSIGN(const fs::path folder, store_.folder(id));
  ScanRequest request = settings_;
  request.setup.devices = devices;
  request.setup.options.resume = true;
  request.passes.reset();
  begin_scan(id, std::move(request), folder);
  return {};
}

Result<> Jobs::remove(const std::string& id) {
  const std::lock_guard starting(starting_);
  if (running_id() == id)
    return fail(ErrorCode::kDeviceBusy, "the rig is at work on this scan; wait for it or cancel");
  return store_.remove(id);
}

void Jobs::begin_scan(const std::string& id, ScanRequest request, const fs::path& folder) {
  const ReconstructFiles files = files_in(folder, settings_);
  request.mesh = files.mesh;
  request.recording = (folder / "recording").string();
  request.report = files.report;
  request.page = files.page;
  request.advice_picture = files.advice_picture;
  PhasePlan plan = scan_phases(request);
  start(id, "scan", std::move(plan),
        [this, request = std::move(request)](Job& job) { return scan(request, job); });
}

Result<> Jobs::start_reconstruction(const std::string& id) {
  const std::lock_guard starting(starting_);
  TURNSCAN_TRY(check_free());
  TURNSCAN_ASSIGN(const fs::path folder, store_.folder(id));
  start(id, "reconstruct", {}, [this, folder](Job& job) { return reconstruct(folder, job); });
  return {};
}

void Jobs::start(const std::string& id, const char* kind, PhasePlan plan, Work work) {
  if (thread_.joinable()) thread_.join();
  auto job = std::make_shared<Job>();
  job->id = id;
  job->kind = kind;
  job->overall.plan(std::move(plan));
  surface_.clear();
  // Not the job itself: a context must not own what owns it.
  job->context.set_listener([this, raw = job.get()](const Progress& progress) {
    const std::lock_guard lock(mutex_);
    raw->progress = progress;
    raw->overall.update(progress, seconds_since(raw->begin));
    changed();
  });
  {
    const std::lock_guard lock(mutex_);
    job_ = job;
    frame_.reset();
    changed();
  }
  thread_ = std::thread([this, job, work = std::move(work)] {
    Result<Made> result =
        fail(ErrorCode::kLibrary, "the rig has run out of memory; use larger voxels");
    try {
      result = work(*job);
    } catch (const std::bad_alloc&) {
    } catch (const std::exception& error) {
      result = fail(ErrorCode::kLibrary, "internal error: {}; please report it", error.what());
    }
    job->context.set_listener({});
    finish(result);
  });
}

void Jobs::finish(const Result<Made>& made) {
  std::string id;
  {
    const std::lock_guard lock(mutex_);
    Job& job = *job_;
    id = job.id;
    if (made) {
      job.state = State::kDone;
      job.text = without_folder(made->text);
      for (const std::string& note : made->notes) job.notes.push_back(without_folder(note));
    } else {
      job.state = made.error().code == ErrorCode::kCancelled ? State::kCancelled : State::kFailed;
    }
    if (const Error* error = !made           ? &made.error()
                             : !made->joined ? &made->joined.error()
                                             : nullptr) {
      job.error = without_folder(error->text());
      job.code = name_of(error->code);
    }
  }
  store_.remove_if_empty(id);
  // The heaps keep what the job has freed.
  malloc_trim(0);
  const std::lock_guard lock(mutex_);
  changed();
}

void Jobs::changed() {
  ++version_;
  wake_.notify_all();
}

Result<Jobs::Made> Jobs::scan(ScanRequest request, Job& job) {
  ScanHooks hooks;
  hooks.progress = [&](const CaptureProgress& progress) { take_progress(job, progress); };
  hooks.begin = [this](const CaptureSetup& setup) { surface_.begin(setup); };
  hooks.frame = [this](const Frame& frame) { take_frame(frame); };
  hooks.recorded = [this] { surface_.end(); };
  hooks.another_side = [&](const std::string& advice, std::uint32_t pass) {
    return ask(job, advice, pass);
  };
  const fs::path folder = fs::path(request.mesh).parent_path();
  TURNSCAN_ASSIGN(ScanOutcome outcome, run_scan(std::move(request), hooks, job.context));
  TURNSCAN_TRY(write_other_meshes(outcome.run, folder));
  // Apart from the text, as are the files.
  std::vector<std::string> notes = std::move(outcome.notes);
  outcome.notes.clear();
  outcome.files.clear();
  return Made{scan_text(outcome), std::move(notes), check_joined(outcome.run.apart)};
}

Result<Jobs::Made> Jobs::record(CaptureSetup setup, const std::string& folder, Job& job) {
  TURNSCAN_ASSIGN(const auto source, setup.open(job.context));
  TURNSCAN_ASSIGN(std::optional<Motor> motor, setup.open_motor(job.context));
  CaptureHooks hooks;
  hooks.motor = motor ? &*motor : nullptr;
  hooks.progress = [&](const CaptureProgress& progress) { take_progress(job, progress); };
  hooks.frame = [this](const Frame& frame) -> Result<> {
    take_frame(frame);
    return {};
  };
  TURNSCAN_TRY(source->start());
  surface_.begin(setup);
  job.context.begin_phase("record", kRecordSteps);
  const auto recorded =
      capture(*source, folder, setup.header, setup.settings, setup.options, hooks, job.context);
  surface_.end();
  source->stop();
  if (!recorded) return tl::unexpected<Error>(recorded.error());
  TURNSCAN_TRY(capture_outcome(*recorded, folder));
  return Made{capture_text(*recorded, folder), {}, {}};
}

Result<Jobs::Made> Jobs::reconstruct(const fs::path& folder, Job& job) {
  TURNSCAN_ASSIGN(const Recording recording, Recording::open(folder / "recording", job.context));
  ReconstructRequest request;
  request.options = settings_.reconstruct;
  request.turntable = settings_.setup.turntable_file;
  request.allow_open = settings_.allow_open;
  const ReconstructFiles files = files_in(folder, settings_);
  TURNSCAN_TRY(check_outputs(files));
  const std::vector<NamedSequence> named{{"recording", &recording}};
  {
    const std::lock_guard lock(mutex_);
    job.overall.plan(joined({reconstruct_phases(named, request), page_phases()}));
  }
  const auto write_meshes = [&](const ReconstructRun& run) -> Result<> {
    TURNSCAN_TRY(write_run_meshes(files, run));
    return write_other_meshes(run, folder);
  };
  TURNSCAN_ASSIGN(const ReconstructRun run,
                  run_reconstruction(named, request, job.context, write_meshes));
  TURNSCAN_TRY(write_beside(files, run, run_report(run, request.options), job.context));
  return Made{reconstruction_text(run.reconstruction), {}, check_joined(run.apart)};
}

Result<> Jobs::write_other_meshes(const ReconstructRun& run, const fs::path& folder) {
  ReconstructFiles files;
  files.mesh_options = settings_.mesh_options;
  for (const char* name : kOtherMeshes) {
    files.mesh = (folder / name).string();
    // Not every format holds a texture.
    if (check_textured_mesh_file(files.mesh, settings_.reconstruct.texture, files.mesh_options))
      TURNSCAN_TRY(write_run_meshes(files, run));
  }
  return {};
}

Result<bool> Jobs::ask(Job& job, const std::string& advice, std::uint32_t pass) {
  std::unique_lock lock(mutex_);
  job.state = State::kAsking;
  job.advice = advice;
  job.pass = pass;
  job.answer.reset();
  changed();
  wake_.wait(lock, [&] { return job.answer || job.context.cancelled(); });
  job.state = State::kRunning;
  changed();
  TURNSCAN_TRY(job.context.check());
  return *job.answer;
}

void Jobs::take_progress(Job& job, const CaptureProgress& progress) {
  std::uint64_t steps = 0;
  {
    const std::lock_guard lock(mutex_);
    const double before = progress.fraction < job.captured.fraction ? 0.0 : job.captured.fraction;
    steps = std::uint64_t(progress.fraction * double(kRecordSteps)) -
            std::uint64_t(before * double(kRecordSteps));
    job.captured = progress;
    changed();
  }
  if (steps > 0) job.context.advance(steps);
  surface_.take(progress.motion);
}

void Jobs::take_frame(const Frame& frame) {
  surface_.add(frame);
  const auto now = std::chrono::steady_clock::now();
  const std::lock_guard lock(mutex_);
  if (frame.info.sensor != 0 || frame.depth.empty() || now - frame_time_ < kBetweenFrames) return;
  frame_time_ = now;
  frame_ = std::make_shared<const LiveFrame>(LiveFrame{++frames_taken_, frame.depth, frame.color});
}

Result<> Jobs::answer(bool another_side) {
  const std::lock_guard lock(mutex_);
  if (!job_ || job_->state != State::kAsking)
    return fail(ErrorCode::kMissingData, "nothing was asked");
  job_->answer = another_side;
  job_->state = State::kRunning;  // at once: whoever looks again is not asked again
  changed();
  return {};
}

Result<> Jobs::cancel() {
  if (running_id().empty()) return fail(ErrorCode::kMissingData, "the rig does nothing");
  end(std::chrono::milliseconds(0));
  return {};
}

std::string Jobs::running_id() const {
  const std::lock_guard lock(mutex_);
  return job_ && !job_->ended() ? job_->id : "";
}

bool Jobs::end(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  if (!job_) return true;
  job_->context.cancel();
  changed();
  return wake_.wait_for(lock, most, [this] { return job_->ended(); });
}

Json Jobs::state() const {
  const std::lock_guard lock(mutex_);
  if (!job_) return nullptr;
  static constexpr const char* kNames[] = {"running", "asking", "done", "failed", "cancelled"};
  const Job& job = *job_;
  const bool runs = job.state == State::kRunning;
  const auto fraction = runs ? job.overall.fraction() : std::nullopt;
  const auto left = runs ? job.overall.seconds_left() : std::nullopt;
  Json out{{"id", job.id}, {"kind", job.kind}, {"state", kNames[int(job.state)]}};
  out["phase"] = job.progress.phase;
  out["fraction"] = fraction ? Json(std::floor(*fraction * 1000.0) / 1000.0) : Json();
  out["seconds_left"] = left ? Json(std::ceil(*left)) : Json();
  out["frames"] = job.captured.frames;
  const bool records = runs && frame_ && job.progress.phase.starts_with("record");
  out["picture"] = records ? Json(frame_->number) : Json();
  out["question"] =
      job.state == State::kAsking ? Json{{"advice", job.advice}, {"pass", job.pass}} : Json();
  const auto known = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
  out["error"] = known(job.error);
  out["code"] = known(job.code);
  out["text"] = known(job.text);
  out["notes"] = job.notes;
  return out;
}

void Jobs::wait_for_change(std::uint64_t& version, std::chrono::milliseconds most) const {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, most, [&] { return version_ != version; });
  version = version_;
}

std::shared_ptr<const LiveFrame> Jobs::live_frame() const {
  const std::lock_guard lock(mutex_);
  return frame_;
}

/// Where the scans are is nothing that a viewer needs to know.
std::string Jobs::without_folder(std::string text) const {
  const std::string folder = store_.root().string() + "/";
  for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
    text.erase(at, folder.size());
  return text;
}

}  // namespace turnscan::serve
