#pragma once
// Measures the rotation of the table since the recording began.

#include <future>
#include <memory>
#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan::session {

/// Uses the frames' own angles; or a known speed and the frames' times; or the speed estimated from
/// the motion seen in the first seconds (turntable/motion/motion.hpp, on a separate thread), and
/// estimated again after half a turn, which is ten times as accurate.
class TurnCounter {
 public:
  /// wait: frames wait while the speed is estimated, so that the same frames always give the same
  /// end.
  TurnCounter(const SequenceHeader& header, std::optional<double> speed_rad_s, bool find_speed,
              bool wait, const RunContext& context);
  ~TurnCounter();
  TurnCounter(const TurnCounter&) = delete;
  TurnCounter& operator=(const TurnCounter&) = delete;

  /// Adds the next frame of the recording; frames must be in order.
  void add(const Frame& frame);
  /// Rotation since the first frame, radians, unsigned; nullopt: not known yet.
  std::optional<double> turned_rad() const { return turned_; }
  /// "angles of the frames", "stated speed", "motion"; empty: not known yet.
  const std::string& found() const { return found_; }
  std::optional<double> speed_rad_s() const { return speed_; }
  /// The motion estimated so far if found() is "motion"; else nullptr.
  const std::shared_ptr<const Calibration>& motion() const { return motion_; }
  /// Why the speed has not been found so far; empty: no attempt has failed.
  const std::string& trouble() const { return trouble_; }

 private:
  void look_for_speed(const Frame& frame);
  bool time_to_look() const;
  void take_result();

  RunContext quiet_;
  SequenceHeader header_;
  std::optional<double> speed_;
  bool find_speed_, wait_;
  bool found_well_ = false;  ///< estimated from half a turn
  std::optional<double> first_time_, last_time_, first_angle_, start_time_;
  std::optional<double> turned_;
  std::string found_, trouble_;
  std::shared_ptr<const Calibration> motion_;

  std::vector<std::shared_ptr<const Frame>> kept_;
  std::size_t every_ = 1, seen_ = 0;
  double attempt_s_;
  std::future<Result<Calibration>> search_;
  bool last_search_ = false;  ///< search_ is the one after half a turn
};

}  // namespace turnscan::session
