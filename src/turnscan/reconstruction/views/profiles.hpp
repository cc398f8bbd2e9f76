#pragma once
// Frames of a line scanner. One holds the points of one sheet of light: no surface, and nothing
// that lies beside it. Consecutive ones together make a range scan.

#include <optional>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::views {

/// The plane, through the viewpoint, in which all points of a line scanner's frames lie. Sensor
/// frame: `along` and `across` span it, `across` along the line.
struct LightSheet {
  Vec3d along = Vec3d::UnitZ(), across = Vec3d::UnitX();
};

/// The sheet, if the frame's points (at least 10) lie in one and are a line seen from the
/// viewpoint, not a dot.
std::optional<LightSheet> find_sheet(const FramePoints& points);

/// Points in the order in which they lie in the sheet, with cells that follow each other but where
/// there is a gap of more than three usual steps. One row.
FramePoints in_sheet_order(const FramePoints& points, const LightSheet& sheet);

/// One frame of a line scanner, as in_sheet_order gives it, and its place.
struct Profile {
  FramePoints points;
  Pose T_table_sensor;
};

/// Collects the profiles of one sensor into groups that are seen from nearly the same place.
class ProfileGroups {
 public:
  /// Takes the next profile; gives the group that ends before it, if one does. A group's last
  /// profile is the first of the next.
  std::vector<Profile> add(Profile profile);
  /// The last group, perhaps without a point.
  std::vector<Profile> flush();

 private:
  bool fits(const Profile& profile) const;
  std::vector<Profile> group_;
};

/// What a group saw, as an image from the middle one's place, with triangles between neighbouring
/// profiles. Empty if there is no point.
DepthView view_of_profiles(std::span<const Profile> group, const LightSheet& sheet,
                           const ViewScale& scale);

}  // namespace turnscan::views
