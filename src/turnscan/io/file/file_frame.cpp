#include <fmt/format.h>

#include <charconv>
#include <system_error>
#include <turnscan/io/file/file_frame.hpp>

namespace turnscan::file {

namespace {

constexpr std::string_view kMark = "z up, base at ";

}  // namespace

void to_file(const FileFrame& frame, std::vector<Vec3f>& points, std::vector<Vec3f>& normals) {
  if (!frame.z_up) return;
  for (Vec3f& p : points)
    p = Vec3f(p.x(), -p.z(), static_cast<float>(static_cast<double>(p.y()) - frame.base));
  for (Vec3f& n : normals) n = Vec3f(n.x(), -n.z(), n.y());
}

void from_file(const FileFrame& frame, std::vector<Vec3f>& points, std::vector<Vec3f>& normals) {
  if (!frame.z_up) return;
  for (Vec3f& p : points)
    p = Vec3f(p.x(), static_cast<float>(static_cast<double>(p.z()) + frame.base), -p.y());
  for (Vec3f& n : normals) n = Vec3f(n.x(), n.z(), -n.y());
}

std::string mark_of(const FileFrame& frame, double units_per_metre) {
  // Nine digits represent any float, and fit into the header of an STL together with the preceding
  // text.
  return frame.z_up ? fmt::format("{}{:.9g}", kMark, frame.base * units_per_metre) : "";
}

FileFrame frame_of_mark(std::string_view mark) {
  FileFrame frame;
  if (!mark.starts_with(kMark)) return frame;
  mark.remove_prefix(kMark.size());
  const char* const end = mark.data() + mark.size();
  const auto [last, error] = std::from_chars(mark.data(), end, frame.base);
  frame.z_up =
      error == std::errc() && (last == end || std::string_view(" \t\r\n").find(*last) != mark.npos);
  return frame;
}

}  // namespace turnscan::file
