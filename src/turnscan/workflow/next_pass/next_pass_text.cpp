#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/workflow/next_pass/next_pass_text.hpp>
#include <vector>

namespace turnscan {

namespace {

constexpr double kSquareCentimetres = 1e4;
constexpr double kLean_rad = 25.0 * kRadiansPerDegree;
constexpr double kOver_rad = 155.0 * kRadiansPerDegree;

struct SideWords {
  const char *side, *way;
};

/// Starting at the sensor, in steps of an eighth of a turn counter-clockwise seen from above.
constexpr std::array<SideWords, 8> kSides{{
    {"front", "towards the sensor"},
    {"front right side", "towards the sensor and to the right"},
    {"right side", "to the right"},
    {"right back side", "away from the sensor and to the right"},
    {"back", "away from the sensor"},
    {"left back side", "away from the sensor and to the left"},
    {"left side", "to the left"},
    {"front left side", "towards the sensor and to the left"},
}};

std::string area_text(double area_m2) {
  return fmt::format("{:.0f} cm2", area_m2 * kSquareCentimetres);
}

const SideWords& words_of(const NextPose& pose) {
  return kSides[std::size_t(std::lround(8.0 * pose.towards_rad / kTurn)) % kSides.size()];
}

}  // namespace

std::string unseen_text(const UnseenSurface& unseen) {
  std::vector<std::string> parts;
  const auto add = [&](const char* name, double area_m2) {
    if (area_m2 >= 0.5 / kSquareCentimetres)
      parts.push_back(fmt::format("{} {}", name, area_text(area_m2)));
  };
  add("base", unseen.base_m2);
  add("underside", unseen.underside_m2);
  add("sides", unseen.sides_m2);
  add("top", unseen.top_m2);
  return fmt::format("No view saw {} of its surface of {}{}{}.", area_text(unseen.unseen_m2()),
                     area_text(unseen.surface_m2), parts.empty() ? "" : ": ",
                     fmt::join(parts, ", "));
}

std::string deed_text(const NextPose& pose) {
  const SideWords& words = words_of(pose);
  if (pose.tip_rad >= kOver_rad) return "turn it upside down";
  if (pose.tip_rad <= kLean_rad) return fmt::format("lean it {}", words.way);
  return fmt::format("lay it on its {}", words.side);
}

std::string pose_text(const NextPose& pose, const std::string& pass) {
  const SideWords& words = words_of(pose);
  return fmt::format(
      "To see about {} of that, {}: seen from the sensor, as it lay at the "
      "beginning of {}, tip it by {:.0f} degrees {}{}.",
      area_text(pose.shows_m2), deed_text(pose), pass.empty() ? "the scan" : pass,
      pose.tip_rad * kDegreesPerRadian, words.way,
      pose.stands ? "" : " and prop it up, because it does not stand so by itself");
}

std::string next_pass_text(const NextPassAdvice& advice) {
  return unseen_text(advice.unseen) + " " +
         (advice.poses.empty() ? "No other way to lay it was found that shows much more."
                               : pose_text(advice.poses.front(), advice.pass));
}

}  // namespace turnscan
