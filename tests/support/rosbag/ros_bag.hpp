#pragma once
// Bags as ROS's own library writes them (Debian: librosbag-storage-dev), with the messages of ROS's
// headers. These are C++17, so nothing of turnscan is here.

#include <array>
#include <cstdint>
#include <memory>
#include <string>

namespace turnscan::testing {

enum class BagPacking { kNone, kBz2, kLz4 };

struct BagImage {
  std::uint32_t seq = 0;
  double stamp_s = 0.0;     ///< of the header
  double recorded_s = 0.0;  ///< of the bag
  std::string frame_id = "0";
  std::string encoding;
  int width = 0, height = 0, row_bytes = 0;
  std::string pixels;
  float depth_units = 0.0f;  ///< not zero: appended, as librealsense does
};

struct BagCamera {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::array<double, 5> distortion{};
};

/// Translation, then the quaternion x y z w.
using BagPose = std::array<double, 7>;

class ReferenceBag {
 public:
  explicit ReferenceBag(const std::string& path, BagPacking packing = BagPacking::kNone,
                        std::uint32_t chunk_bytes = 768 * 1024);
  ~ReferenceBag();  ///< closes it
  ReferenceBag(const ReferenceBag&) = delete;
  ReferenceBag& operator=(const ReferenceBag&) = delete;

  void image(const std::string& topic, const BagImage& image);
  void compressed(const std::string& topic, const BagImage& image, const std::string& format);
  void camera(const std::string& topic, const BagCamera& camera, const std::string& model,
              const std::string& frame_id = "0");
  void number(const std::string& topic, float value);
  void key_value(const std::string& topic, const std::string& key, const std::string& value);
  void transform(const std::string& topic, const BagPose& pose);
  /// tf2_msgs/TFMessage
  void frames(const std::string& topic, const std::string& parent, const std::string& child,
              const BagPose& T_parent_child);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace turnscan::testing
