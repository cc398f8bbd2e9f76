#pragma once
// Reads and writes JSON without exceptions: every wrong field becomes an error message that names
// it. Sources that access a Json's contents include <nlohmann/json.hpp>.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/file/read_budget.hpp>
#include <vector>

namespace turnscan::text {

using Json = nlohmann::json;
/// For writing only: parsing into it takes quadratic time in the number of fields.
/// Begin with OrderedJson::object() or array(): a null value that [] or push_back() converts is
/// left unusable, even by its destructor, if memory runs out (version 3.11).
using OrderedJson = nlohmann::ordered_json;

/// In a list that is read as JsonObject::objects().
inline constexpr std::size_t kMaxJsonObjects = 1000000;

/// Location of a value: its path, e.g. "sensors[0].intrinsics", in the text that it was parsed
/// from. Keeps a reference to the text, if there is one.
struct JsonPlace {
  std::string path;
  std::string_view text;

  JsonPlace member(const char* key) const;
  JsonPlace element(std::size_t index) const;
  /// "line 3, column 14: sensors[0].intrinsics"; only the path if there is no text.
  std::string shown() const;
};

/// A JSON object and its location in the file. Keeps references to the Json, and to the text.
/// All readers fail with kFormat; null counts as absent.
class JsonObject {
 public:
  /// text: from which the value was parsed; if given, errors name line and column.
  static Result<JsonObject> from(const Json& value, std::string_view text = {});
  static Result<JsonObject> from(const Json& value, JsonPlace place);

  bool has(const char* key) const { return find(key) != nullptr; }
  const Json* find(const char* key) const;
  std::string place_of(const char* key) const;  ///< as JsonPlace::shown(), for errors

  Result<double> number(const char* key) const;  ///< finite
  Result<double> number_or(const char* key, double fallback) const;
  Result<std::optional<double>> optional_number(const char* key) const;
  Result<int> integer(const char* key, int min, int max) const;
  Result<std::string> text_or(const char* key, std::string fallback) const;
  Result<bool> flag_or(const char* key, bool fallback) const;
  Result<std::vector<double>> numbers(const char* key) const;
  Result<std::vector<std::string>> texts(const char* key) const;
  Result<Vec3d> vector(const char* key) const;
  Result<Pose> pose(const char* key) const;  ///< 16 numbers or four rows of four
  Result<std::vector<Pose>> poses(const char* key) const;
  Result<JsonObject> object(const char* key) const;
  /// Fails with kResourceLimit beyond kMaxJsonObjects, too.
  Result<std::vector<JsonObject>> objects(const char* key) const;

 private:
  JsonObject(const Json& value, JsonPlace place) : value_(&value), place_(std::move(place)) {}
  Result<const Json*> require(const char* key) const;

  const Json* value_;
  JsonPlace place_;
};

/// Fails with kFormat, naming line and column, if text is not JSON, and as check_json_shape(). The
/// budget is that of the file which holds the text.
Result<Json> parse_json(std::string_view text, const file::ReadBudget& budget);
/// The same for a text that is the whole file.
Result<Json> parse_json(std::string_view text, const RunContext& context = RunContext());

/// Reads an object of many members, of which one is in memory at a time: take(name, value) is
/// called for each, in the file's order, until it fails. Fails as parse_json(), take() and, if the
/// text is no object, with kFormat.
Result<> for_each_json_member(std::string_view text, const RunContext& context,
                              const std::function<Result<>(const std::string&, const Json&)>& take);

/// width, height, fx, fy, cx, cy and optionally distortion (k1 k2 p1 p2 k3, and k4 k5 k6); checked.
Result<CameraIntrinsics> intrinsics_from_json(const JsonObject& object);

OrderedJson json_of(const Vec3d& v);
OrderedJson json_of(const Pose& pose);
OrderedJson json_of(const CameraIntrinsics& camera);

/// Indented text in which arrays without objects take one line; ends with a line end.
std::string json_text(const OrderedJson& value);

}  // namespace turnscan::text
