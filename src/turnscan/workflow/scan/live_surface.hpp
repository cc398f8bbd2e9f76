#pragma once
// The surface of an object as it grows while it is recorded.

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

/// How a table turns whose place is known.
struct LiveMotion {
  TurntableInfo table;
  std::optional<double> speed_rad_s;  ///< nullopt: frames have angles
  double start_s = 0.0;               ///< when it began to turn, in the frames' time

  /// How far it had turned at a frame, radians; nullopt where nothing says that.
  std::optional<double> turned_rad(const FrameInfo& info) const;
};

/// Of a table that stands where `known` says (nullptr: not known) and of what the motion has shown
/// (nullptr: nothing yet); the place of the first takes precedence. first_s: time of the first
/// frame. nullopt: that is not enough. Whoever knows the speed, or has angles, gives it in `speed`
/// or by has_angles.
std::optional<LiveMotion> live_motion(const TurntableInfo* known, const Calibration* shown,
                                      std::optional<double> speed_rad_s, bool has_angles,
                                      double first_s);

/// Adds some of the frames, evenly spread over the time so far, to a reconstruction on one thread
/// of its own, and makes rough closed meshes of it. Nobody waits for it: what it has no time for
/// comes with the next mesh.
class LiveSurface {
 public:
  static constexpr std::size_t kMaxFrames = 128;  ///< in memory
  static constexpr double kMinPause_s = 0.4;      ///< from one mesh to the next

  /// header: of the frames, whose sensor 0 is used.
  explicit LiveSurface(SequenceHeader header);
  ~LiveSurface();  ///< waits for the mesh that is being made
  LiveSurface(const LiveSurface&) = delete;
  LiveSurface& operator=(const LiveSurface&) = delete;

  /// In the order in which they were taken. Dropped frames and those of other sensors are left out.
  void add(const Frame& frame);
  /// From now on: all frames so far are placed anew.
  void set_motion(const LiveMotion& motion);
  /// Those that are kept, oldest first.
  std::vector<std::shared_ptr<const Frame>> frames() const;

  struct Update {
    TriangleMesh mesh;       ///< table frame, the platter turned back
    std::size_t frames = 0;  ///< that it was made of
  };
  /// The newest mesh that was not taken yet.
  std::optional<Update> take();

 private:
  struct Kept {
    std::uint64_t number;
    std::shared_ptr<const Frame> frame;
  };
  void run();
  /// What is to be added next; waits for it. False: it ends.
  bool wait_for_work(std::vector<Kept>& batch, std::optional<LiveMotion>& anew);
  Result<> work(const std::vector<Kept>& batch, const std::optional<LiveMotion>& anew);

  const SequenceHeader header_;
  RunContext context_;

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  std::vector<Kept> kept_;
  std::uint64_t came_ = 0, every_ = 1, next_ = 0;  ///< next_: number of the first not yet added
  std::optional<LiveMotion> motion_;
  bool anew_ = false, closing_ = false;
  std::optional<Update> update_;

  // Of the thread.
  std::optional<ReconstructionStream> stream_;
  LiveMotion placed_;
  std::size_t added_ = 0;
  bool pending_ = false;  ///< frames were added since the last mesh
  std::thread thread_;
};

}  // namespace turnscan
