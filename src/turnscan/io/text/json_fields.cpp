#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <turnscan/io/text/json_bytes.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::text {

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBrown = 5;  // coefficients without the rational model's denominator

Result<double> finite_number(const Json& value, const JsonPlace& place) {
  if (!value.is_number()) return fail(ErrorCode::kFormat, "{} is not a number", place.shown());
  const double number = value.get<double>();
  if (!std::isfinite(number)) return fail(ErrorCode::kFormat, "{} is not finite", place.shown());
  return number;
}

Result<> append_numbers(const Json& value, const JsonPlace& place, std::vector<double>& out) {
  if (!value.is_array())
    return fail(ErrorCode::kFormat, "{} is not a list of numbers", place.shown());
  out.reserve(out.size() + value.size());
  for (std::size_t i = 0; i < value.size(); ++i) {
    const double number = value[i].is_number() ? value[i].get<double>() : kNoNumber;
    // The place is named only where it is needed: a list may have millions of numbers.
    if (!std::isfinite(number)) TURNSCAN_TRY(finite_number(value[i], place.element(i)));
    out.push_back(number);
  }
  return {};
}

/// 16 numbers or four rows of four.
Result<Pose> pose_from_json(const Json& value, const JsonPlace& place) {
  std::vector<double> numbers;
  const bool rows = value.is_array() && value.size() == 4;
  if (rows) {
    for (std::size_t i = 0; i < 4; ++i)
      TURNSCAN_TRY(append_numbers(value[i], place.element(i), numbers));
  } else {
    TURNSCAN_TRY(append_numbers(value, place, numbers));
  }
  auto pose = pose_from_rows(numbers);
  if (!pose) return fail(ErrorCode::kFormat, "{}: {}", place.shown(), pose.error().message);
  return pose;
}

/// Beginning of the word, number or string whose last byte is at `last`.
std::size_t begin_of_token(std::string_view text, std::size_t last) {
  std::size_t i = std::min(last, text.size());
  if (i == text.size() || i == 0) return i;
  if (text[i] == '"') {
    const std::size_t open = text.rfind('"', i - 1);
    return open == std::string_view::npos ? i : open;
  }
  while (i > 0 && std::string_view(" \t\r\n,:[]{}\"").find(text[i - 1]) == std::string_view::npos)
    --i;
  return i;
}

/// The bytes of a text for the parser. They end early once the reading is cancelled.
class TextBytes {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  TextBytes(const char* at, const char* end, const file::ReadBudget& budget)
      : at_(at), end_(end), budget_(&budget) {}
  reference operator*() const { return *at_; }
  TextBytes& operator++() {
    ++at_;
    if ((++passed_ & kBetweenLooks) == 0 && !budget_->state()) at_ = end_;
    return *this;
  }
  bool operator==(const TextBytes& other) const { return at_ == other.at_; }
  bool operator!=(const TextBytes& other) const { return at_ != other.at_; }

 private:
  static constexpr std::size_t kBetweenLooks = 0xffff;  // bytes
  const char *at_, *end_;
  const file::ReadBudget* budget_;
  std::size_t passed_ = 0;
};

/// The parser's error message, preceded by the position.
std::string syntax_error_of(std::string_view text, const Json::parse_error& error) {
  // "[...] parse error at line 1, column 8: syntax error while parsing object - unexpected X;
  // last read: 'Y'; expected Z"
  std::string said = error.what();
  if (const auto dash = said.rfind(" - "); dash != std::string::npos) said.erase(0, dash + 3);
  const auto read = said.find("; last read: "), expected = said.rfind("; expected ");
  if (read != std::string::npos)
    said.erase(read,
               (expected != std::string::npos && expected > read ? expected : said.size()) - read);
  std::replace(said.begin(), said.end(), ';', ',');
  return fmt::format(
      "{}: {}", line_and_column(text, begin_of_token(text, error.byte > 0 ? error.byte - 1 : 0)),
      said);
}

/// The value, or why the text is not JSON; either may be wrong when cancelled.
Result<Json> parsed(std::string_view text, const file::ReadBudget& budget,
                    const Json::parser_callback_t& keep = nullptr) {
  const char *begin = text.data(), *end = begin + text.size();
  std::string why = "a number is too large";
  try {
    return Json::parse(TextBytes(begin, end, budget), TextBytes(end, end, budget), keep);
  } catch (const Json::parse_error& error) {
    why = syntax_error_of(text, error);
  } catch (const Json::exception&) {
  }
  return fail(ErrorCode::kFormat, "not valid JSON: {}", why);
}

Result<Json> checked(std::string_view text, const file::ReadBudget& budget,
                     const Json::parser_callback_t& keep) {
  TURNSCAN_TRY(check_json_shape(text, budget));
  // The parser treats a zero byte as the end, and does not read what follows.
  if (text.find('\0') != std::string_view::npos)
    return fail(ErrorCode::kFormat, "not valid JSON: it holds a zero byte");
  auto value = parsed(text, budget, keep);
  TURNSCAN_TRY(budget.state());
  return value;
}

bool holds_objects(const OrderedJson& value) {
  return std::any_of(value.begin(), value.end(), [](const OrderedJson& v) {
    return v.is_object() || (v.is_array() && holds_objects(v));
  });
}

std::string one_line(const OrderedJson& value) {
  return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

void write(const OrderedJson& value, const std::string& indent, std::string& out) {
  const bool nested = value.is_object() || (value.is_array() && holds_objects(value));
  if (!nested || value.empty()) {
    out += one_line(value);
    return;
  }
  const std::string inner = indent + "  ";
  const char* separator = "\n";
  out += value.is_object() ? '{' : '[';
  for (const auto& item : value.items()) {
    out += separator + inner;
    if (value.is_object()) out += one_line(item.key()) + ": ";
    write(item.value(), inner, out);
    separator = ",\n";
  }
  out += '\n' + indent + (value.is_object() ? '}' : ']');
}

}  // namespace

Result<Json> parse_json(std::string_view text, const RunContext& context) {
  return parse_json(text, file::ReadBudget(text.size(), context));
}

Result<Json> parse_json(std::string_view text, const file::ReadBudget& budget) {
  return checked(text, budget, nullptr);
}

Result<> for_each_json_member(
    std::string_view text, const RunContext& context,
    const std::function<Result<>(const std::string&, const Json&)>& take) {
  constexpr int kOfMembers = 1;  // depth
  std::string name;
  Result<> taken;
  const auto keep = [&](int depth, Json::parse_event_t event, Json& value) {
    using Event = Json::parse_event_t;
    if (depth != kOfMembers || event == Event::object_start || event == Event::array_start)
      return true;
    if (event == Event::key) {
      name = value.get<std::string>();
      return true;
    }
    if (taken) taken = take(name, value);
    return false;
  };
  TURNSCAN_ASSIGN(const Json rest, checked(text, file::ReadBudget(text.size(), context), keep));
  TURNSCAN_TRY(JsonObject::from(rest, text));
  return taken;
}

JsonPlace JsonPlace::member(const char* key) const {
  return {path.empty() ? std::string(key) : path + "." + key, text};
}

JsonPlace JsonPlace::element(std::size_t index) const {
  return {fmt::format("{}[{}]", path, index), text};
}

std::string JsonPlace::shown() const {
  if (text.empty()) return path;
  return fmt::format("{}: {}", line_and_column(text, json_offset(text, path)), path);
}

Result<JsonObject> JsonObject::from(const Json& value, std::string_view text) {
  return from(value, JsonPlace{"", text});
}

Result<JsonObject> JsonObject::from(const Json& value, JsonPlace place) {
  if (!value.is_object())
    return fail(ErrorCode::kFormat, "{} is not a JSON object",
                place.path.empty() ? "the file's content" : place.shown());
  return JsonObject(value, std::move(place));
}

const Json* JsonObject::find(const char* key) const {
  const auto found = value_->find(key);
  return found == value_->end() || found->is_null() ? nullptr : &*found;
}

std::string JsonObject::place_of(const char* key) const { return place_.member(key).shown(); }

Result<const Json*> JsonObject::require(const char* key) const {
  const Json* value = find(key);
  if (value == nullptr) return fail(ErrorCode::kFormat, "{} is missing", place_of(key));
  return value;
}

Result<double> JsonObject::number(const char* key) const {
  TURNSCAN_ASSIGN(const Json* value, require(key));
  return finite_number(*value, place_.member(key));
}

Result<double> JsonObject::number_or(const char* key, double fallback) const {
  return has(key) ? number(key) : fallback;
}

Result<std::optional<double>> JsonObject::optional_number(const char* key) const {
  if (!has(key)) return std::optional<double>();
  TURNSCAN_ASSIGN(const double value, number(key));
  return std::optional<double>(value);
}

Result<int> JsonObject::integer(const char* key, int min, int max) const {
  TURNSCAN_ASSIGN(const double value, number(key));
  if (!(value >= min && value <= max) || value != std::floor(value))
    return fail(ErrorCode::kFormat, "{} = {} is not a whole number from {} to {}", place_of(key),
                value, min, max);
  return static_cast<int>(value);
}

Result<std::string> JsonObject::text_or(const char* key, std::string fallback) const {
  const Json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_string()) return fail(ErrorCode::kFormat, "{} is not a text", place_of(key));
  return value->get<std::string>();
}

Result<bool> JsonObject::flag_or(const char* key, bool fallback) const {
  const Json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_boolean())
    return fail(ErrorCode::kFormat, "{} is neither true nor false", place_of(key));
  return value->get<bool>();
}

Result<std::vector<double>> JsonObject::numbers(const char* key) const {
  TURNSCAN_ASSIGN(const Json* value, require(key));
  std::vector<double> out;
  TURNSCAN_TRY(append_numbers(*value, place_.member(key), out));
  return out;
}

Result<std::vector<std::string>> JsonObject::texts(const char* key) const {
  TURNSCAN_ASSIGN(const Json* value, require(key));
  const bool good = value->is_array() && std::all_of(value->begin(), value->end(),
                                                     [](auto& v) { return v.is_string(); });
  if (!good) return fail(ErrorCode::kFormat, "{} is not a list of texts", place_of(key));
  return value->get<std::vector<std::string>>();
}

Result<Vec3d> JsonObject::vector(const char* key) const {
  TURNSCAN_ASSIGN(const std::vector<double> v, numbers(key));
  if (v.size() != 3)
    return fail(ErrorCode::kFormat, "{} has {} numbers, not 3", place_of(key), v.size());
  return Vec3d(v[0], v[1], v[2]);
}

Result<Pose> JsonObject::pose(const char* key) const {
  TURNSCAN_ASSIGN(const Json* value, require(key));
  return pose_from_json(*value, place_.member(key));
}

Result<std::vector<Pose>> JsonObject::poses(const char* key) const {
  TURNSCAN_ASSIGN(const Json* list, require(key));
  if (!list->is_array()) return fail(ErrorCode::kFormat, "{} is not a list", place_of(key));
  std::vector<Pose> out;
  for (std::size_t i = 0; i < list->size(); ++i) {
    TURNSCAN_ASSIGN(const Pose pose, pose_from_json((*list)[i], place_.member(key).element(i)));
    out.push_back(pose);
  }
  return out;
}

Result<JsonObject> JsonObject::object(const char* key) const {
  TURNSCAN_ASSIGN(const Json* value, require(key));
  return from(*value, place_.member(key));
}

Result<std::vector<JsonObject>> JsonObject::objects(const char* key) const {
  TURNSCAN_ASSIGN(const Json* value, require(key));
  if (!value->is_array()) return fail(ErrorCode::kFormat, "{} is not a list", place_of(key));
  if (value->size() > kMaxJsonObjects)
    return fail(ErrorCode::kResourceLimit, "{} has more than {} entries", place_of(key),
                kMaxJsonObjects);
  std::vector<JsonObject> out;
  out.reserve(value->size());
  for (std::size_t i = 0; i < value->size(); ++i) {
    TURNSCAN_ASSIGN(JsonObject object, from((*value)[i], place_.member(key).element(i)));
    out.push_back(std::move(object));
  }
  return out;
}

Result<CameraIntrinsics> intrinsics_from_json(const JsonObject& object) {
  CameraIntrinsics camera;
  TURNSCAN_ASSIGN(camera.width, object.integer("width", 1, 65535));
  TURNSCAN_ASSIGN(camera.height, object.integer("height", 1, 65535));
  TURNSCAN_ASSIGN(camera.fx, object.number("fx"));
  TURNSCAN_ASSIGN(camera.fy, object.number("fy"));
  TURNSCAN_ASSIGN(camera.cx, object.number("cx"));
  TURNSCAN_ASSIGN(camera.cy, object.number("cy"));
  if (object.has("distortion")) {
    TURNSCAN_ASSIGN(const std::vector<double> k, object.numbers("distortion"));
    if (k.size() != kBrown && k.size() != camera.distortion.size())
      return fail(ErrorCode::kFormat,
                  "{} has {} numbers, not 5 (k1 k2 p1 p2 k3) or 8 (and k4 k5 k6)",
                  object.place_of("distortion"), k.size());
    std::copy(k.begin(), k.end(), camera.distortion.begin());
  }
  TURNSCAN_TRY(camera.check());
  return camera;
}

OrderedJson json_of(const Vec3d& v) { return OrderedJson::array({v.x(), v.y(), v.z()}); }

OrderedJson json_of(const Pose& pose) {
  OrderedJson rows = OrderedJson::array();
  for (int r = 0; r < 4; ++r) {
    const Eigen::RowVector4d row = pose.matrix().row(r);
    rows.push_back(OrderedJson::array({row[0], row[1], row[2], row[3]}));
  }
  return rows;
}

OrderedJson json_of(const CameraIntrinsics& camera) {
  OrderedJson distortion = OrderedJson::array();
  const std::size_t count = camera.rational() ? camera.distortion.size() : kBrown;
  for (std::size_t i = 0; i < count; ++i) distortion.push_back(camera.distortion[i]);
  return {{"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion", std::move(distortion)}};
}

std::string json_text(const OrderedJson& value) {
  std::string out;
  write(value, "", out);
  return out + "\n";
}

}  // namespace turnscan::text
