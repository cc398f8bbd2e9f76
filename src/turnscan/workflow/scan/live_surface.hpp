#pragma once
// The surface of an object, updated during recording.

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <vector>

namespace turnscan {

/// Rotation of a table whose axis is known.
struct LiveMotion {
  TurntableInfo table;
  std::optional<double> speed_rad_s;  ///< nullopt: frames have angles
  double start_s = 0.0;               ///< start of the rotation, in the frames' time

  /// Angle of the table at a frame, radians; nullopt if it is not known.
  std::optional<double> turned_rad(const FrameInfo& info) const;
};

/// Combines the table pose in `known` (nullptr: not known) with what the motion has shown (nullptr:
/// nothing yet); the pose of the former takes precedence. first_s: time of the first frame.
/// nullopt: not enough is known. A known speed or known angles are passed as `speed` or has_angles.
std::optional<LiveMotion> live_motion(const TurntableInfo* known, const Calibration* shown,
                                      std::optional<double> speed_rad_s, bool has_angles,
                                      double first_s);

/// Finds the rotation as frames arrive, by live_motion().
class LiveMotionFinder {
 public:
  /// Of a recording's header and speed, as far as they are known.
  LiveMotionFinder(const SequenceHeader& header, std::optional<double> speed_rad_s);

  /// The motion, if a frame or a new estimate shows it; nullopt: not yet, or the same as before.
  std::optional<LiveMotion> take(const FrameInfo& frame);
  std::optional<LiveMotion> take(const std::shared_ptr<const Calibration>& shown);

 private:
  std::optional<TurntableInfo> table_;
  std::optional<double> speed_rad_s_, first_s_;
  std::shared_ptr<const Calibration> shown_;  ///< the last estimate
  bool found_ = false;
};

/// Adds an evenly spaced subset of the frames so far to a reconstruction on a separate thread, and
/// makes coarse closed meshes from it. Callers never block: frames that it has no time for are
/// included in the next mesh.
class LiveSurface {
 public:
  static constexpr std::size_t kMaxFrames = 128;  ///< in memory
  static constexpr double kMinPause_s = 0.4;      ///< between meshes

  /// header: of the frames; only sensor 0 is used.
  explicit LiveSurface(SequenceHeader header);
  ~LiveSurface();  ///< waits for the mesh in progress
  LiveSurface(const LiveSurface&) = delete;
  LiveSurface& operator=(const LiveSurface&) = delete;

  /// Adds a frame; frames must be in order of time. Dropped frames and those of other sensors are
  /// ignored.
  void add(const Frame& frame);
  /// Changes the motion: all frames so far are posed anew.
  void set_motion(const LiveMotion& motion);
  /// While it rests, frames are kept and no mesh is made.
  void rest(bool resting);
  /// The kept frames, oldest first.
  std::vector<std::shared_ptr<const Frame>> frames() const;

  struct Update {
    TriangleMesh mesh;       ///< table frame, with the rotation removed
    std::size_t frames = 0;  ///< that it was made from
  };
  /// The newest mesh, if it was not taken yet.
  std::optional<Update> take();

 private:
  struct Kept {
    std::uint64_t number;
    std::shared_ptr<const Frame> frame;
  };
  void run();
  /// Waits for the next frames to add. False: the thread has to end.
  bool wait_for_work(std::vector<Kept>& batch, std::optional<LiveMotion>& anew);
  Result<> work(const std::vector<Kept>& batch, const std::optional<LiveMotion>& anew);

  const SequenceHeader header_;
  RunContext context_;

  mutable std::mutex mutex_;  // guards the following members
  std::condition_variable wake_;
  std::vector<Kept> kept_;
  /// next_: number of the first frame not yet added.
  std::uint64_t came_ = 0, every_ = 1, next_ = 0;
  std::optional<LiveMotion> motion_;
  bool anew_ = false, closing_ = false, resting_ = false;
  std::optional<Update> update_;

  // Used by the thread only.
  std::optional<ReconstructionStream> stream_;
  LiveMotion placed_;
  std::size_t added_ = 0;
  bool pending_ = false;  ///< frames were added since the last mesh
  std::thread thread_;
};

}  // namespace turnscan
