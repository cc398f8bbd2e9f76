#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <turnscan/io/text/toml_options.hpp>

namespace turnscan::scene {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kLargest = 1u << 20u;
constexpr std::size_t kLongestLine = 4096;
constexpr int kMaxDots = 32;
constexpr int kDeepest = 32;

/// Rejects what the library parses recursively, or in a time quadratic in a key's length.
std::string excess_of(std::string_view line, int& depth) {
  if (line.size() > kLongestLine) return fmt::format("has more than {} bytes", kLongestLine);
  int dots = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote == '"' && c == '\\') {
      ++i;  // an escaped character does not end a text
      continue;
    }
    if (quote == '\0' && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == quote) {
      quote = '\0';
    }
    if (quote != '\0') continue;
    if (c == ',' || c == '=') dots = 0;
    if (c == '.' && ++dots > kMaxDots)
      return fmt::format("has a key of more than {} parts", kMaxDots);
    if (c == ']' || c == '}') depth = std::max(depth - 1, 0);
    if ((c == '[' || c == '{') && ++depth > kDeepest)
      return fmt::format("nests lists and tables more than {} deep", kDeepest);
  }
  return {};
}

Result<> check_shape(std::string_view text, const fs::path& path) {
  int depth = 0;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (const std::string excess = excess_of(text.substr(0, end), depth); !excess.empty())
      return fail_at(path.string(), ErrorCode::kInvalidOption,
                     "{}:{}: this line {}, which no such file has; check the path", path.string(),
                     number, excess);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

}  // namespace

tl::unexpected<Error> fail_in_toml(const fs::path& path, const toml::node& where,
                                   const std::string& message) {
  return fail_at(path.string(), ErrorCode::kInvalidOption, "{}:{}: {}", path.string(),
                 where.source().begin.line, message);
}

Result<toml::table> read_toml(const fs::path& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (status.type() == fs::file_type::none)
    return fail_at(path.string(), ErrorCode::kIo, "it cannot be looked at ({}); check permissions",
                   error.message());
  if (!fs::exists(status))
    return fail_at(path.string(), ErrorCode::kNotFound, "there is no such file; check the path");
  if (!fs::is_regular_file(status))
    return fail_at(path.string(), ErrorCode::kInvalidOption,
                   "this is not a file; give the path of a TOML file");
  if (fs::file_size(path, error) > kLargest)
    return fail_at(path.string(), ErrorCode::kInvalidOption,
                   "the file is longer than 1 MB, which no such file is; check the path");
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream)
    return fail_at(path.string(), ErrorCode::kIo, "the file cannot be read ({}); check permissions",
                   std::generic_category().message(errno));
  return parse_toml(text, path);
}

Result<toml::table> parse_toml(std::string_view text, const fs::path& path) {
  TURNSCAN_TRY(check_shape(text, path));
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& failure) {
    return fail_at(path.string(), ErrorCode::kInvalidOption,
                   "{}:{}: not TOML: {}; check the syntax of this line", path.string(),
                   failure.source().begin.line, std::string(failure.description()));
  }
}

Result<std::string> toml_text(const fs::path& path, std::string_view key, const toml::node& value) {
  if (const auto* text = value.as_string()) return text->get();
  if (const auto* number = value.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = value.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* flag = value.as_boolean()) return std::string(flag->get() ? "true" : "false");
  return fail_in_toml(path, value,
                      fmt::format("{}: the value is neither text, number, true nor false; write it "
                                  "as on the command line",
                                  key));
}

Result<> set_from_toml(const fs::path& path, const toml::table& table, const OptionTable& options,
                       std::initializer_list<std::string_view> known) {
  for (const auto& [key, node] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    TURNSCAN_ASSIGN(const std::string value, toml_text(path, key.str(), node));
    if (auto set = options.set(key.str(), value); !set)
      return fail_in_toml(path, node, set.error().message);
  }
  return {};
}

}  // namespace turnscan::scene
