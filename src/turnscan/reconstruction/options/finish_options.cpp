#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <turnscan/core/units.hpp>
#include <turnscan/reconstruction/options/finish_options.hpp>

namespace turnscan {

namespace {

using SixNumbers = std::array<std::optional<double>, 6>;

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = text.find(',', begin);
    parts.push_back(text.substr(begin, comma - begin));
    if (comma == std::string_view::npos) return parts;
    begin = comma + 1;
  }
}

/// Parses six comma-separated entries, each converted by read(index, entry); empty ones are
/// skipped.
template <class Read>
Result<SixNumbers> six_numbers(const char* name, std::string_view text, const char* form,
                               const Read& read) {
  const std::vector<std::string_view> entries = split_at_commas(text);
  SixNumbers out;
  if (entries.size() != out.size())
    return fail(ErrorCode::kInvalidOption, "{} = {} does not have the form {}", name, text, form);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (entries[i].empty()) continue;
    const Result<double> value = read(i, entries[i]);
    if (!value) return fail(ErrorCode::kInvalidOption, "{}: {}", name, value.error().message);
    out[i] = *value;
  }
  return out;
}

Result<double> read_length(std::string_view text) {
  return parse_quantity(text, Quantity::kLength);
}

Result<std::vector<HalfSpace>> box_sides(std::string_view text) {
  std::vector<HalfSpace> out;
  if (text.empty()) return out;
  TURNSCAN_ASSIGN(const SixNumbers n, six_numbers("keep-box", text, "X0,Y0,Z0,X1,Y1,Z1",
                                                  [](std::size_t, std::string_view entry) {
                                                    return read_length(entry);
                                                  }));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto &low = n[axis], &high = n[axis + 3];
    if (low && high && !(*low < *high))
      return fail(ErrorCode::kInvalidOption, "keep-box = {} holds nothing: {} is not below {}",
                  text, format_quantity(*low, Quantity::kLength),
                  format_quantity(*high, Quantity::kLength));
    if (low) out.push_back({Vec3d::Unit(int(axis)), *low});
    if (high) out.push_back({-Vec3d::Unit(int(axis)), -*high});
  }
  return out;
}

Result<std::vector<HalfSpace>> plane_side(std::string_view text) {
  if (text.empty()) return std::vector<HalfSpace>();
  TURNSCAN_ASSIGN(
      const SixNumbers n,
      six_numbers("cut-plane", text, "X,Y,Z,NX,NY,NZ", [](std::size_t i, std::string_view entry) {
        return i < 3 ? read_length(entry) : parse_number(entry);
      }));
  const Vec3d place(n[0].value_or(0.0), n[1].value_or(0.0), n[2].value_or(0.0));
  const Vec3d away(n[3].value_or(0.0), n[4].value_or(0.0), n[5].value_or(0.0));
  if (!(away.stableNorm() > 1e-6 && away.stableNorm() < 1e6))
    return fail(ErrorCode::kInvalidOption, "cut-plane = {} does not give a direction", text);
  const Vec3d inward = -away.normalized();
  return std::vector<HalfSpace>{{inward, inward.dot(place)}};
}

}  // namespace

OptionTable describe(FinishOptions& o) {
  OptionTable table;
  table
      .choice("holes", o.holes, {"smooth", "flat", "open"},
              "What to do with unmeasured surface, the underside included: close it smoothly, "
              "close it by a surface of least area, or leave it open. Needs the repair")
      .number("hole-size", o.hole_size_m, Quantity::kLength, {0.0, 1.0},
              "Longest side from which --holes flat and open apply; smaller holes are closed "
              "smoothly")
      .number("smooth", o.smooth_m, Quantity::kLength, {0.0, 0.02},
              "Smooth the mesh: waves of this length lose half of their height, shorter ones more; "
              "0 is off")
      .text("keep-box", o.keep_box,
            "Cut away what lies outside a box and close the cuts flat: X0,Y0,Z0,X1,Y1,Z1 in the "
            "table's frame, y up from the platter; an empty entry does not limit: \",2mm,,,,\" "
            "cuts off the lowest 2 mm",
            [](std::string_view text) -> Result<> {
              TURNSCAN_TRY(box_sides(text));
              return {};
            })
      .text("cut-plane", o.cut_plane,
            "Cut away one side of a plane and close the cut flat: X,Y,Z,NX,NY,NZ, a place on it in "
            "the table's frame and the direction of what is cut away",
            [](std::string_view text) -> Result<> {
              TURNSCAN_TRY(plane_side(text));
              return {};
            })
      .number("smallest-part", o.smallest_part_m, Quantity::kLength, {0.0, 10.0},
              "Drop parts of a mesh, not connected to the rest, whose longest side is shorter")
      .number("only-object", o.object, {1, 1000000},
              "Keep only the object of this number, the largest being 1; automatic: all")
      .text("triangles", o.triangles,
            "Number of triangles of an object, which stays closed: at most this number; all; or "
            "auto, which removes triangles within an eighth of the expected error, at most a "
            "quarter of a voxel (of points: a twentieth), but none where vertices carry --colour",
            [](std::string_view text) -> Result<> {
              TURNSCAN_TRY(triangles_wanted(text));
              return {};
            })
      .number(
          "max-error", o.max_error_m, Quantity::kLength, {1e-6, 1.0},
          "Remove triangles as long as the surface moves by less than this; together with a number "
          "of --triangles, until either limit is reached; automatic: as --triangles says");
  return table;
}

Result<std::optional<std::size_t>> triangles_wanted(std::string_view text) {
  if (text == "auto") return std::nullopt;
  if (text == "all") return kAllTriangles;
  const auto number = parse_number(text);
  if (!number || !(*number >= 4.0) || *number > 1e9 || *number != std::floor(*number))
    return fail(ErrorCode::kInvalidOption,
                "triangles = {} is neither auto, all nor a whole number from 4 to 1000000000",
                text);
  return static_cast<std::size_t>(*number);
}

Result<std::vector<HalfSpace>> kept_half_spaces(const FinishOptions& options) {
  TURNSCAN_ASSIGN(std::vector<HalfSpace> out, box_sides(options.keep_box));
  TURNSCAN_ASSIGN(const std::vector<HalfSpace> plane, plane_side(options.cut_plane));
  out.insert(out.end(), plane.begin(), plane.end());
  return out;
}

}  // namespace turnscan
