#pragma once

#include <array>
#include <turnscan/core/frame.hpp>

namespace turnscan::estimation {

/// Share of the directions from the axis in which a platter's rim is seen, among those that depth
/// images observe: where the object occludes the rim they are not counted.
class PlatterRim {
 public:
  /// The part of a platter outside this share of its radius, which only large objects cover.
  static constexpr double kInnerShare = 0.75;

  explicit PlatterRim(double radius_m) : radius_m_(radius_m) {}

  /// Adds a frame of a depth camera without kOutsideCrop; the table frame has y = 0 on the platter.
  /// Returns within PlatterReturns::kReach_m of it count as the platter; where returns are lower,
  /// or missing, the view passes the platter.
  void add(const Frame& frame, const SensorInfo& sensor, const Pose& T_table_sensor);

  /// Share of the observed directions in which the rim is seen; 0 if these cover less than 30
  /// degrees.
  double share_seen() const;

 private:
  static constexpr std::size_t kSectors = 36;
  struct Looks {
    int on = 0, past = 0;
  };
  double radius_m_;
  std::array<Looks, kSectors> looks_{};
};

}  // namespace turnscan::estimation
