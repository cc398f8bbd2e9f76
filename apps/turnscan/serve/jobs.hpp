#pragma once
// What the rig is doing: one scan, recording or reconstruction at a time, on a thread of its own,
// by the calls of the workflow that the commands make. It goes on whoever looks or not.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <turnscan/core/image.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>
#include <turnscan/workflow/scan/scan.hpp>

#include "serve/growing_surface.hpp"
#include "serve/scan_store.hpp"

namespace turnscan::serve {

/// A frame of the running scan. colour is empty if the sensor has none.
struct LiveFrame {
  std::uint64_t number = 0;
  DepthImage depth;
  ColorImage color;
};

class Jobs {
 public:
  /// settings: of every scan and reconstruction; its devices, mesh and recording are set for each.
  Jobs(ScanStore store, ScanRequest settings);
  ~Jobs();  ///< cancels, and waits
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Returns the id of the scan. passes: nullopt asks after each (state "asking"). Fails with
  /// kDeviceBusy while a job runs, and as ScanStore::create().
  Result<std::string> start_scan(const std::vector<std::string>& devices,
                                 std::optional<int> passes);
  /// As start_scan(), but makes no mesh of what it records, which is one pass.
  Result<std::string> start_recording(const std::vector<std::string>& devices);
  /// Goes on with a recording that was not finished, and asks after each pass. Fails with
  /// kDeviceBusy, and with kNotFound for an id without a scan.
  Result<> resume_scan(const std::string& id, const std::vector<std::string>& devices);
  /// Fails with kDeviceBusy, and with kNotFound for an id without a scan.
  Result<> start_reconstruction(const std::string& id);
  /// Deletes a scan. Fails with kDeviceBusy if the job is at work on it, and as
  /// ScanStore::remove().
  Result<> remove(const std::string& id);
  /// Whether the object lies another way now (true), or there is no further pass. Fails with
  /// kMissingData if nobody asks.
  Result<> answer(bool another_side);
  /// Ends the job; what was recorded stays. Fails with kMissingData if there is none.
  Result<> cancel();

  /// Of the job that runs, or asks; empty: none does.
  std::string running_id() const;
  /// The last job: {id, kind, state, phase, fraction, seconds_left, frames, picture, question,
  /// error, notes}; null before the first.
  Json state() const;
  /// Returns after a change since `version`, which becomes the current one, or after some time.
  void wait_for_change(std::uint64_t& version, std::chrono::milliseconds most) const;
  /// The last frame of the last job; nullptr before there is one.
  std::shared_ptr<const LiveFrame> live_frame() const;
  GrowingSurface& surface() { return surface_; }

  /// Cancels the job, and waits so long for its end; false: it has not ended.
  bool end(std::chrono::milliseconds most);

 private:
  enum class State { kRunning, kAsking, kDone, kFailed, kCancelled };
  struct Job {
    std::string id;
    const char* kind = "";
    State state = State::kRunning;
    RunContext context;
    OverallProgress overall;
    Progress progress;
    CaptureProgress captured;
    std::string advice;
    std::uint32_t pass = 0;
    std::optional<bool> answer;
    std::string error, code, text;
    std::vector<std::string> notes;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    bool ended() const { return state != State::kRunning && state != State::kAsking; }
  };
  void begin_scan(const std::string& id, ScanRequest request, const std::filesystem::path& folder);
  /// The id of a scan that is new on the disk.
  Result<std::string> new_scan();
  /// What a job has made.
  struct Made {
    std::string text;
    std::vector<std::string> notes;
    Result<> joined;  ///< check_joined()
  };
  using Work = std::function<Result<Made>(Job&)>;

  Result<> check_free() const;
  void start(const std::string& id, const char* kind, PhasePlan plan, Work work);
  void finish(const Result<Made>& made);
  void changed();

  Result<Made> scan(ScanRequest request, Job& job);
  Result<Made> record(CaptureSetup setup, const std::string& folder, Job& job);
  Result<Made> reconstruct(const std::filesystem::path& folder, Job& job);
  Result<> write_other_meshes(const ReconstructRun& run, const std::filesystem::path& folder);
  Result<bool> ask(Job& job, const std::string& advice, std::uint32_t pass);
  void take_progress(Job& job, const CaptureProgress& progress);
  void take_frame(const Frame& frame);
  std::string without_folder(std::string text) const;

  ScanStore store_;
  ScanRequest settings_;
  std::mutex starting_;  // of two that want to start a job
  mutable std::mutex mutex_;
  mutable std::condition_variable wake_;
  std::uint64_t version_ = 0;
  std::shared_ptr<Job> job_;
  std::shared_ptr<const LiveFrame> frame_;
  std::uint64_t frames_taken_ = 0;
  std::chrono::steady_clock::time_point frame_time_;
  GrowingSurface surface_;
  std::thread thread_;
};

}  // namespace turnscan::serve
