#include <algorithm>
#include <optional>
#include <turnscan/capture/source/source_uri.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kLongest = 4096;

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<int> hex_digit(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

Result<std::string> decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      const auto high = i + 1 < text.size() ? hex_digit(text[i + 1]) : std::nullopt;
      const auto low = i + 2 < text.size() ? hex_digit(text[i + 2]) : std::nullopt;
      if (!high || !low)
        return fail(ErrorCode::kInvalidOption,
                    "a '%' stands without two hexadecimal digits behind it; write %25 for the sign "
                    "itself");
      c = static_cast<char>(*high * 16 + *low);
      i += 2;
    }
    if (c == '\0') return fail(ErrorCode::kInvalidOption, "a byte 0 cannot be part of a name");
    out += c;
  }
  return out;
}

std::string encoded(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (c == '%' || special.find(c) != std::string_view::npos)
      out += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      out += c;
  }
  return out;
}

Result<std::string> scheme_of(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0)
    return fail(ErrorCode::kInvalidOption,
                "there is no scheme; write SCHEME:ADDRESS, e.g. virtual:doll or replay:FOLDER");
  std::string scheme(text.substr(0, colon));
  for (char& c : scheme) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (!is_lower(c) && !is_digit(c) && c != '-')
      return fail(ErrorCode::kInvalidOption,
                  "'{}' is no scheme; write SCHEME:ADDRESS, e.g. virtual:doll or replay:FOLDER",
                  text.substr(0, colon));
  }
  return scheme;
}

Result<std::pair<std::string, std::string>> parameter_of(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos)
    return fail(ErrorCode::kInvalidOption, "'{}' has no value; write NAME=VALUE, with '&' between",
                text);
  if (equals == 0)
    return fail(ErrorCode::kInvalidOption, "'{}' has no name; write NAME=VALUE", text);
  TURNSCAN_ASSIGN(std::string name, decoded(text.substr(0, equals)));
  TURNSCAN_ASSIGN(std::string value, decoded(text.substr(equals + 1)));
  return std::pair(std::move(name), std::move(value));
}

Result<> read_parameters(std::string_view query, SourceUri& uri) {
  while (!query.empty()) {
    const std::size_t end = std::min(query.find('&'), query.size());
    TURNSCAN_ASSIGN(auto parameter, parameter_of(query.substr(0, end)));
    for (const auto& [name, value] : uri.parameters)
      if (name == parameter.first)
        return fail(ErrorCode::kInvalidOption, "'{}' is given twice; give it once", name);
    uri.parameters.push_back(std::move(parameter));
    if (end + 1 == query.size())
      return fail(ErrorCode::kInvalidOption, "there is nothing behind the last '&'; remove it");
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return {};
}

Result<SourceUri> parse(std::string_view text) {
  if (text.size() > kLongest)
    return fail(ErrorCode::kInvalidOption, "it is {} bytes long; at most {} are read", text.size(),
                kLongest);
  SourceUri uri;
  TURNSCAN_ASSIGN(uri.scheme, scheme_of(text));
  text.remove_prefix(uri.scheme.size() + 1);
  const std::size_t question = std::min(text.find('?'), text.size());
  TURNSCAN_ASSIGN(uri.address, decoded(text.substr(0, question)));
  if (question < text.size()) TURNSCAN_TRY(read_parameters(text.substr(question + 1), uri));
  return uri;
}

}  // namespace

Result<SourceUri> parse_source_uri(std::string_view text) {
  auto uri = parse(text);
  if (!uri)
    return fail(uri.error().code, "device '{}': {}", text.substr(0, 200), uri.error().message);
  return uri;
}

std::string format_source_uri(const SourceUri& uri) {
  std::string text = uri.scheme + ":" + encoded(uri.address, "?");
  char separator = '?';
  for (const auto& [name, value] : uri.parameters) {
    text += separator + encoded(name, "&=") + "=" + encoded(value, "&");
    separator = '&';
  }
  return text;
}

Result<> set_from_uri(const SourceUri& uri, const OptionTable& table) {
  for (const auto& [name, value] : uri.parameters) {
    const OptionField* field = table.find(name);
    std::string text = value;
    if (field != nullptr && field->is_flag && (value == "0" || value == "1"))
      text = value == "1" ? "true" : "false";
    if (auto set = table.set(name, text); !set)
      return fail(ErrorCode::kInvalidOption, "{}: {}", uri.scheme, set.error().message);
  }
  if (auto good = table.check(); !good)
    return fail(ErrorCode::kInvalidOption, "{}: {}", uri.scheme, good.error().message);
  return {};
}

}  // namespace turnscan
