#include <turnscan/workflow/page/page_model.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <turnscan/geometry/mesh/pack_mesh.hpp>
#include <turnscan/workflow/page/encoding.hpp>

namespace turnscan::page {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kLevels = 65534.0;  // of a quantised value
constexpr std::uint16_t kNotKnown = 65535;
constexpr std::size_t kPositionBytes = 6;  // three coordinates of two bytes
constexpr std::size_t kColorBytes = 3;

/// One vertex after another, little-endian.
class Records {
 public:
  Records(std::size_t count, std::size_t bytes_each)
      : stride_((bytes_each + 3) / 4 * 4), bytes_(count * stride_, 0) {}

  void put(std::size_t vertex, std::size_t offset, std::uint16_t value) {
    bytes_[vertex * stride_ + offset] = static_cast<std::uint8_t>(value & 0xff);
    bytes_[vertex * stride_ + offset + 1] = static_cast<std::uint8_t>(value >> 8);
  }
  void put_byte(std::size_t vertex, std::size_t offset, std::uint8_t value) {
    bytes_[vertex * stride_ + offset] = value;
  }
  std::size_t stride() const { return stride_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::size_t stride_;
  std::vector<std::uint8_t> bytes_;
};

std::uint16_t quantised(double value, double from, double to) {
  if (!std::isfinite(value)) return kNotKnown;
  const double share = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return static_cast<std::uint16_t>(std::lround(share * kLevels));
}

OrderedJson object_json(const PageObject& object, const std::vector<Field>& fields,
                        const Vec3d& origin, double extent) {
  const TriangleMesh& mesh = object.mesh;
  std::size_t bytes = kPositionBytes;
  OrderedJson offsets = OrderedJson::object();
  std::vector<std::pair<const Field*, std::vector<float>>> known;
  for (const Field& field : fields) {
    std::vector<float> values = field.values(object);
    if (values.empty()) continue;
    offsets[field.id] = bytes;
    bytes += 2;
    known.emplace_back(&field, std::move(values));
  }
  if (!mesh.colors.empty()) {
    offsets["colour"] = bytes;
    bytes += kColorBytes;
  }
  Records records(mesh.vertices.size(), bytes);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      records.put(v, 2 * axis, quantised(double(mesh.vertices[v][i]) - origin[i], 0.0, extent));
    }
    std::size_t offset = kPositionBytes;
    for (const auto& [field, values] : known) {
      records.put(v, offset, quantised(double(values[v]), field->from, field->to));
      offset += 2;
    }
    if (mesh.colors.empty()) continue;
    const Rgb c = mesh.colors[v];
    records.put_byte(v, offset, c.r);
    records.put_byte(v, offset + 1, c.g);
    records.put_byte(v, offset + 2, c.b);
  }
  const PackedMesh packed = pack_mesh(mesh.triangles, records.bytes(), records.stride());
  return {{"name", mesh.name},
          {"vertices", packed.vertices},
          {"triangles", packed.triangles},
          {"stride", records.stride()},
          {"offsets", std::move(offsets)},
          {"origin_mm", {origin.x() * 1e3, origin.y() * 1e3, origin.z() * 1e3}},
          {"step_mm", extent / kLevels * 1e3},
          {"vertex_stream", base64(packed.vertex_stream)},
          {"index_stream", base64(packed.index_stream)}};
}

OrderedJson field_json(const Field& field) {
  OrderedJson json = {{"id", field.id},     {"label", field.label}, {"help", field.help},
                      {"unit", field.unit}, {"map", field.map},     {"from", field.from},
                      {"to", field.to}};
  if (!field.classes.empty()) json["classes"] = field.classes;
  return json;
}

}  // namespace

std::string model_json(const std::vector<PageObject>& objects, const std::vector<Field>& fields) {
  Box box;
  bool colored = false;
  for (const PageObject& object : objects) {
    for (const auto& t : object.mesh.triangles)
      for (const std::uint32_t v : t) box.add(object.mesh.vertices[v].cast<double>());
    colored = colored || !object.mesh.colors.empty();
  }
  const double extent = std::max(box.size().maxCoeff(), 1e-9);
  OrderedJson json = {
      {"has_colour", colored}, {"fields", OrderedJson::array()}, {"objects", OrderedJson::array()}};
  for (const Field& field : fields) json["fields"].push_back(field_json(field));
  for (std::size_t i = 0; i < objects.size(); ++i) {
    OrderedJson object = object_json(objects[i], fields, box.min, extent);
    if (objects[i].mesh.name.empty()) object["name"] = fmt::format("object {}", i + 1);
    json["objects"].push_back(std::move(object));
  }
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace turnscan::page
