#pragma once
// Reading and writing JSON without exceptions: every wrong field becomes a sentence that names it.
// Sources that look into a Json include <nlohmann/json.hpp>.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::text {

using Json = nlohmann::json;
/// For writing only: parsing into it takes quadratic time in the number of fields.
/// Begin with OrderedJson::object() or array(): a null value that [] or push_back() turns into one
/// is left unusable, even to its destructor, when no memory is to be had for that (version 3.11).
using OrderedJson = nlohmann::ordered_json;

/// One JSON object and its place in the file, e.g. "sensors[0].intrinsics". Refers to the Json.
/// All readers fail with kFormat; null counts as absent.
class JsonObject {
 public:
  static Result<JsonObject> from(const Json& value, std::string place);

  bool has(const char* key) const { return find(key) != nullptr; }
  const Json* find(const char* key) const;
  std::string place_of(const char* key) const;

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
  Result<JsonObject> object(const char* key) const;
  Result<std::vector<JsonObject>> objects(const char* key) const;

 private:
  JsonObject(const Json& value, std::string place) : value_(&value), place_(std::move(place)) {}
  Result<const Json*> require(const char* key) const;

  const Json* value_;
  std::string place_;
};

/// Fails with kFormat when text is not JSON, or as check_json_depth().
Result<Json> parse_json(std::string_view text);

/// 16 numbers or four rows of four. place is for the error.
Result<Pose> pose_from_json(const Json& value, const std::string& place);
/// width, height, fx, fy, cx, cy and optionally distortion (k1 k2 p1 p2 k3, and k4 k5 k6); checked.
Result<CameraIntrinsics> intrinsics_from_json(const JsonObject& object);

OrderedJson json_of(const Vec3d& v);
OrderedJson json_of(const Pose& pose);
OrderedJson json_of(const CameraIntrinsics& camera);

/// Indented text in which arrays without objects take one line; ends with a line end.
std::string json_text(const OrderedJson& value);

}  // namespace turnscan::text
