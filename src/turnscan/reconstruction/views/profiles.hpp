#pragma once
// Frames of a line scanner. Each contains the points of one light sheet: neither a surface nor
// anything beside the sheet. Consecutive ones together make a range scan.

#include <optional>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::views {

/// The plane, through the viewpoint, that contains all points of a line scanner's frames. Sensor
/// frame: `along` and `across` span it, `across` along the line.
struct LightSheet {
  Vec3d along = Vec3d::UnitZ(), across = Vec3d::UnitX();
};

/// The sheet, if the frame's points (at least 10) are in one plane and form a line rather than a
/// dot as seen from the viewpoint.
std::optional<LightSheet> find_sheet(const FramePoints& points);

/// Points in their order in the sheet, with consecutive cells except at gaps of more than three
/// usual steps. One row.
FramePoints in_sheet_order(const FramePoints& points, const LightSheet& sheet);

/// One frame of a line scanner, in the form of in_sheet_order, and its pose.
struct Profile {
  FramePoints points;
  Pose T_table_sensor;
};

/// Collects the profiles of one sensor into groups with nearly the same viewpoint.
class ProfileGroups {
 public:
  /// Adds a profile; returns the group that ends before it, if one does. A group's last profile is
  /// the first of the next.
  std::vector<Profile> add(Profile profile);
  /// The last group, possibly without a point.
  std::vector<Profile> flush();

 private:
  bool fits(const Profile& profile) const;
  std::vector<Profile> group_;
};

/// Renders a group as an image from the viewpoint of its middle profile, with triangles between
/// neighbouring profiles. Empty if there is no point.
DepthView view_of_profiles(std::span<const Profile> group, const LightSheet& sheet,
                           const ViewScale& scale);

}  // namespace turnscan::views
