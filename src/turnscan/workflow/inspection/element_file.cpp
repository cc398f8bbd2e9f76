#include <turnscan/workflow/inspection/element_file.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <turnscan/core/angles.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::workflow {

namespace {

using elements::Kind;
using text::JsonObject;
using Names = std::vector<std::string>;

constexpr std::uint64_t kMaxBytes = 1 << 20;
constexpr std::size_t kMaxEntries = 256;  // the work grows with its square
constexpr double kMaxMm = kMaxDistance_m * 1e3;

Result<> check_keys(const text::Json& json, const std::set<std::string>& known) {
  for (const auto& item : json.items())
    if (!known.contains(item.key()))
      return fail(ErrorCode::kFormat, "'{}' is not known here; use {}", item.key(),
                  fmt::join(known, ", "));
  return {};
}

Result<double> number_in(const JsonObject& json, const char* key, double low, double high) {
  TURNSCAN_ASSIGN(const double value, json.number(key));
  if (!(value > low && value <= high))
    return fail(ErrorCode::kFormat,
                "{} = {} is out of range; it must be above {:g} and at most {:g}",
                json.place_of(key), value, low, high);
  return value;
}

Result<Vec3d> point_m(const JsonObject& json, const char* key) {
  TURNSCAN_ASSIGN(const Vec3d mm, json.vector(key));
  if (!(mm.cwiseAbs().maxCoeff() <= kMaxMm))
    return fail(ErrorCode::kFormat, "{} is farther away than {:g} mm", json.place_of(key), kMaxMm);
  return Vec3d(mm * 1e-3);
}

Result<Vec3d> direction_of(const JsonObject& json, const char* key) {
  TURNSCAN_ASSIGN(const Vec3d v, json.vector(key));
  const double length = v.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length))
    return fail(ErrorCode::kFormat, "{} has no direction", json.place_of(key));
  return Vec3d(v / length);
}

/// The index of an element among the first `count`.
Result<std::size_t> index_of(const std::string& name, const Names& names) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    return fail(ErrorCode::kFormat, "there is no element '{}' {}", name,
                names.empty()
                    ? "before it"
                    : "before it; there are " + fmt::format("{}", fmt::join(names, ", ")));
  return static_cast<std::size_t>(at - names.begin());
}

Result<std::array<std::size_t, 2>> two_of(const JsonObject& json, const Names& names) {
  TURNSCAN_ASSIGN(const Names of, json.texts("of"));
  if (of.size() != 2)
    return fail(ErrorCode::kFormat, "{} has {} names, not 2", json.place_of("of"), of.size());
  TURNSCAN_ASSIGN(const std::size_t a, index_of(of[0], names));
  TURNSCAN_ASSIGN(const std::size_t b, index_of(of[1], names));
  if (a == b) return fail(ErrorCode::kFormat, "'{}' is named twice in 'of'", of[0]);
  return std::array{a, b};
}

Result<Kind> kind_of(const std::string& type) {
  for (const Kind kind :
       {Kind::kSphere, Kind::kCylinder, Kind::kCone, Kind::kPlane, Kind::kCircle, Kind::kLine})
    if (type == elements::name_of(kind)) return kind;
  return fail(ErrorCode::kFormat,
              "its type '{}' is none of sphere, cylinder, cone, plane, circle, line, intersection",
              type);
}

Result<elements::Shape> shape_of(const JsonObject& json, Kind kind) {
  elements::Shape shape;
  shape.kind = kind;
  TURNSCAN_ASSIGN(shape.point, point_m(json, "point_mm"));
  if (elements::has_direction(kind)) {
    TURNSCAN_ASSIGN(shape.direction, direction_of(json, "direction"));
    shape.section_normal = shape.direction;
  }
  if (elements::has_radius(kind)) {
    TURNSCAN_ASSIGN(const double mm, number_in(json, "diameter_mm", 0.0, kMaxMm));
    shape.radius_m = 0.5e-3 * mm;
  }
  if (kind == Kind::kCone) {
    TURNSCAN_ASSIGN(const double deg, number_in(json, "angle_deg", 0.0, 179.0));
    shape.half_angle_rad = 0.5 * deg / kDegreesPerRadian;
  }
  if (kind != Kind::kLine) return shape;
  TURNSCAN_ASSIGN(const Vec3d normal, direction_of(json, "normal"));
  const Vec3d across = normal - normal.dot(shape.direction) * shape.direction;
  if (!(across.norm() > 0.5))
    return fail(ErrorCode::kFormat,
                "{} is along its direction; it is that of the plane in which the line is measured",
                json.place_of("normal"));
  shape.section_normal = across.normalized();
  return shape;
}

std::set<std::string> keys_of(Kind kind) {
  std::set<std::string> keys{"name", "type", "point_mm", "within_mm", "min_mm", "max_mm"};
  if (elements::has_direction(kind)) keys.insert("direction");
  if (elements::has_radius(kind)) keys.insert("diameter_mm");
  if (kind == Kind::kCone) keys.insert("angle_deg");
  if (kind == Kind::kLine) keys.insert("normal");
  return keys;
}

Result<> read_element(const JsonObject& json, const text::Json& fields, const Names& names,
                      ElementRequest& out) {
  TURNSCAN_ASSIGN(const std::string type, json.text_or("type", ""));
  if (type == "intersection") {
    TURNSCAN_TRY(check_keys(fields, {"name", "type", "of"}));
    TURNSCAN_ASSIGN(out.of, two_of(json, names));
    return {};
  }
  TURNSCAN_ASSIGN(const Kind kind, kind_of(type));
  TURNSCAN_TRY(check_keys(fields, keys_of(kind)));
  TURNSCAN_ASSIGN(out.nominal, shape_of(json, kind));
  TURNSCAN_ASSIGN(const double within_mm, number_in(json, "within_mm", 0.0, kMaxMm));
  out.within_m = within_mm * 1e-3;
  if (json.has("min_mm")) {
    TURNSCAN_ASSIGN(out.low_m, point_m(json, "min_mm"));
  }
  if (json.has("max_mm")) {
    TURNSCAN_ASSIGN(out.high_m, point_m(json, "max_mm"));
  }
  if (!(out.low_m.array() < out.high_m.array()).all())
    return fail(ErrorCode::kFormat, "{} is not below max_mm", json.place_of("min_mm"));
  return {};
}

Result<> read_relation(const JsonObject& json, const text::Json& fields, const Names& names,
                       RelationRequest& out) {
  TURNSCAN_TRY(check_keys(fields, {"name", "type", "of"}));
  TURNSCAN_ASSIGN(const std::string type, json.text_or("type", ""));
  if (type != "distance" && type != "angle")
    return fail(ErrorCode::kFormat, "its type '{}' is neither distance nor angle", type);
  out.angle = type == "angle";
  TURNSCAN_ASSIGN(out.of, two_of(json, names));
  return {};
}

/// Reads a list whose entries have different names. read: from the object, its fields and the names
/// before it, into the entry.
template <class Entry, class Read>
Result<> read_list(const JsonObject& json, const char* key, const char* what,
                   const std::function<const Names&(const Names&)>& known, const Read& read,
                   std::vector<Entry>& out) {
  TURNSCAN_ASSIGN(const std::vector<JsonObject> objects, json.objects(key));
  if (objects.size() > kMaxEntries)
    return fail(ErrorCode::kFormat, "{} has {} entries, more than {}", json.place_of(key),
                objects.size(), kMaxEntries);
  Names names;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    Entry entry;
    TURNSCAN_ASSIGN(entry.name, objects[i].text_or("name", ""));
    if (entry.name.empty())
      return fail(ErrorCode::kFormat, "{} is missing", objects[i].place_of("name"));
    if (std::find(names.begin(), names.end(), entry.name) != names.end())
      return fail(ErrorCode::kFormat, "{} '{}' is there twice; give it another name", what,
                  entry.name);
    if (const auto done = read(objects[i], (*json.find(key))[i], known(names), entry); !done)
      return fail(done.error().code, "{} '{}': {}", what, entry.name, done.error().message);
    names.push_back(entry.name);
    out.push_back(std::move(entry));
  }
  return {};
}

Result<DatumRequest> read_datum(const JsonObject& json, const text::Json& fields,
                                const Names& names) {
  TURNSCAN_TRY(check_keys(fields, {"plane", "line", "point"}));
  DatumRequest out;
  for (const auto& [key, index] : {std::pair("plane", &out.plane), std::pair("line", &out.line),
                                   std::pair("point", &out.point)}) {
    TURNSCAN_ASSIGN(const std::string name, json.text_or(key, ""));
    const auto found = index_of(name, names);
    if (!found) return fail(ErrorCode::kFormat, "datum: {} = '{}' is no element", key, name);
    *index = *found;
  }
  return out;
}

}  // namespace

Result<ElementPlan> parse_elements(std::string_view text, const RunContext& context) {
  TURNSCAN_ASSIGN(const text::Json json, text::parse_json(text, context));
  TURNSCAN_ASSIGN(const JsonObject root, JsonObject::from(json, text));
  TURNSCAN_TRY(check_keys(json, {"elements", "relations", "datum"}));
  ElementPlan plan;
  const auto before = [](const Names& names) -> const Names& { return names; };
  TURNSCAN_TRY(read_list(root, "elements", "element", before, read_element, plan.elements));
  if (plan.elements.empty())
    return fail(ErrorCode::kFormat, "{} is empty", root.place_of("elements"));
  Names all;
  for (const ElementRequest& e : plan.elements) all.push_back(e.name);
  if (root.has("relations")) {
    const auto every = [&](const Names&) -> const Names& { return all; };
    TURNSCAN_TRY(read_list(root, "relations", "relation", every, read_relation, plan.relations));
  }
  if (root.has("datum")) {
    TURNSCAN_ASSIGN(const JsonObject datum, root.object("datum"));
    TURNSCAN_ASSIGN(plan.datum, read_datum(datum, *root.find("datum"), all));
  }
  return plan;
}

Result<ElementPlan> read_elements(const std::filesystem::path& path, const RunContext& context) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxBytes));
  auto plan = parse_elements(text, context);
  if (!plan) {
    plan.error().path = path.string();
    if (plan.error().message.find("; ") == std::string::npos)
      plan.error().message += "; docs/reference/evaluation.md describes the file";
  }
  return plan;
}

}  // namespace turnscan::workflow
