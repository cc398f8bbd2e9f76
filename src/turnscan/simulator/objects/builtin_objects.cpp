#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/labelled_cylinder.hpp>
#include <turnscan/simulator/objects/object_makers.hpp>

namespace turnscan {

namespace {

constexpr Rgb kWood{198, 156, 104};
constexpr Rgb kCard{150, 160, 172};

/// Front corners of the letter: 0 to 3 outside, from the left foot clockwise; 4 to 7 the gap, from
/// the right foot; 8 to 10 the counter.
std::array<Vec3f, 11> letter_corners() {
  using A = LetterA;
  const double lean = (A::width_m / 2 - A::leg_m / 2) / A::height_m;
  const auto inner = [lean](double y) { return A::width_m / 2 - A::leg_m - lean * y; };
  const double half = A::width_m / 2, low = A::crossbar_low_m, high = A::crossbar_high_m;
  const double apex = (half - A::leg_m) / lean;
  const auto at = [](double x, double y) {
    return Vec3f(Vec3d(x, y, A::thickness_m / 2).cast<float>());
  };
  return {at(-half, 0),
          at(-A::leg_m / 2, A::height_m),
          at(A::leg_m / 2, A::height_m),
          at(half, 0),
          at(inner(0), 0),
          at(inner(low), low),
          at(-inner(low), low),
          at(-inner(0), 0),
          at(-inner(high), high),
          at(inner(high), high),
          at(0, apex)};
}

/// The front's triangles, counter-clockwise, and the loops of its border with the letter on the
/// left.
constexpr std::array<std::array<std::uint32_t, 3>, 11> kLetterFront{{{0, 7, 6},
                                                                     {0, 6, 8},
                                                                     {0, 8, 10},
                                                                     {0, 10, 1},
                                                                     {1, 10, 2},
                                                                     {2, 10, 3},
                                                                     {3, 10, 9},
                                                                     {3, 9, 5},
                                                                     {3, 5, 4},
                                                                     {6, 5, 9},
                                                                     {6, 9, 8}}};
constexpr std::array<std::uint32_t, 8> kLetterOutside{0, 7, 6, 5, 4, 3, 2, 1};
constexpr std::array<std::uint32_t, 3> kLetterCounter{9, 8, 10};

void add_quad(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
              std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

TriangleMesh make_letter() {
  TriangleMesh mesh;
  mesh.name = "letter-a";
  const auto corners = letter_corners();
  const auto n = static_cast<std::uint32_t>(corners.size());
  mesh.vertices.assign(corners.begin(), corners.end());
  for (const Vec3f& p : corners) mesh.vertices.emplace_back(p.x(), p.y(), -p.z());
  for (const auto& t : kLetterFront) {
    mesh.triangles.push_back(t);
    mesh.triangles.push_back({t[0] + n, t[2] + n, t[1] + n});
  }
  const auto wall = [&](const auto& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      add_quad(mesh, b, a, a + n, b + n);
    }
  };
  wall(kLetterOutside);
  wall(kLetterCounter);
  mesh.colors.assign(mesh.vertices.size(), kWood);
  return mesh;
}

TriangleMesh make_cylinder() {
  TriangleMesh mesh;
  mesh.name = "cylinder";
  constexpr auto n = static_cast<std::uint32_t>(SolidCylinder::segments);
  mesh.vertices.reserve(2 * n + 2);
  for (const double y : {0.0, SolidCylinder::height_m}) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = kTurn * i / n, r = SolidCylinder::diameter_m / 2;
      mesh.vertices.push_back(Vec3d(r * std::sin(angle), y, r * std::cos(angle)).cast<float>());
    }
  }
  mesh.vertices.emplace_back(0.0f, 0.0f, 0.0f);
  mesh.vertices.emplace_back(0.0f, float(SolidCylinder::height_m), 0.0f);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    add_quad(mesh, i, j, n + j, n + i);
    mesh.triangles.push_back({2 * n, j, i});
    mesh.triangles.push_back({2 * n + 1, n + i, n + j});
  }
  mesh.colors.assign(mesh.vertices.size(), kCard);
  return mesh;
}

using Maker = Result<TriangleMesh> (*)(const RunContext&);
constexpr std::array<std::pair<std::string_view, Maker>, 11> kObjects{
    {{"letter-a", [](const RunContext&) -> Result<TriangleMesh> { return make_letter(); }},
     {"cylinder", [](const RunContext&) -> Result<TriangleMesh> { return make_cylinder(); }},
     {"labelled-cylinder",
      [](const RunContext&) -> Result<TriangleMesh> {
        return objects::make_labelled_cylinder(make_cylinder());
      }},
     {"doll", objects::make_doll},
     {"scorpion", objects::make_scorpion},
     {"skull", objects::make_skull},
     {"action-figure", objects::make_action_figure},
     {"robed-figure", objects::make_robed_figure},
     {"ball", [](const RunContext&) -> Result<TriangleMesh> { return objects::make_ball(); }},
     {"ball-bar",
      [](const RunContext&) -> Result<TriangleMesh> { return objects::make_ball_bar(); }},
     {"plate", [](const RunContext&) -> Result<TriangleMesh> { return objects::make_plate(); }}}};

}  // namespace

std::vector<std::string> builtin_object_names() {
  std::vector<std::string> names;
  names.reserve(kObjects.size());
  for (const auto& object : kObjects) names.emplace_back(object.first);
  return names;
}

bool is_gauge(std::string_view name) {
  return name == "ball" || name == "ball-bar" || name == "plate";
}

Result<TriangleMesh> builtin_object(std::string_view name, const RunContext& context) {
  for (const auto& object : kObjects)
    if (object.first == name) return object.second(context);
  return fail(ErrorCode::kNotFound, "there is no built-in object '{}'; there are {}", name,
              fmt::join(builtin_object_names(), ", "));
}

TriangleMesh place(TriangleMesh mesh, double x_m, double z_m, double yaw_rad) {
  const Pose turn = rotation_about_y(yaw_rad);
  const Vec3d shift(x_m, 0.0, z_m);
  for (Vec3f& p : mesh.vertices) p = (turn * p.cast<double>() + shift).cast<float>();
  for (Vec3f& n : mesh.normals) n = (turn.linear() * n.cast<double>()).cast<float>();
  return mesh;
}

TriangleMesh stand_on_platter(TriangleMesh mesh, std::optional<double> height_m) {
  Box box;
  for (const Vec3f& p : mesh.vertices)
    if (p.allFinite()) box.add(p.cast<double>());
  if (box.empty()) return mesh;
  const double height = box.size().y();
  const double scale = height_m && height > 0.0 ? *height_m / height : 1.0;
  const Vec3d foot(box.center().x(), box.min.y(), box.center().z());
  for (Vec3f& p : mesh.vertices) p = (scale * (p.cast<double>() - foot)).cast<float>();
  return mesh;
}

}  // namespace turnscan
