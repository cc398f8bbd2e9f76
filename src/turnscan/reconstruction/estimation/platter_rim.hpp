#pragma once

#include <array>
#include <turnscan/core/frame.hpp>

namespace turnscan::estimation {

/// In which directions from the axis a platter's rim is seen, of those in which depth images show
/// what is there: where the object stands in front they tell nothing.
class PlatterRim {
 public:
  /// The part of a platter farther out than this share of its radius: only large objects stand
  /// there.
  static constexpr double kInnerShare = 0.75;

  explicit PlatterRim(double radius_m) : radius_m_(radius_m) {}

  /// A frame of a depth camera without kOutsideCrop; the table's frame has y = 0 on the platter.
  /// What lies within PlatterReturns::kReach_m of it is taken for the platter; what lies lower, or
  /// returns nothing, is seen past it.
  void add(const Frame& frame, const SensorInfo& sensor, const Pose& T_table_sensor);

  /// Of the directions that tell, those in which it is seen; 0 where they cover less than 30
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
