#include <algorithm>
#include <fstream>
#include <iterator>
#include <turnscan/simulator/toml_options.hpp>

namespace turnscan::scene {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kLargest = 1u << 20u;

}  // namespace

tl::unexpected<Error> fail_in_toml(const fs::path& path, const toml::node& where,
                                   const std::string& message) {
  return fail_at(path.string(), ErrorCode::kInvalidOption, "{}:{}: {}", path.string(),
                 where.source().begin.line, message);
}

Result<toml::table> read_toml(const fs::path& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
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
  if (!stream) return fail_at(path.string(), ErrorCode::kIo, "the file cannot be read");
  return parse_toml(text, path);
}

Result<toml::table> parse_toml(std::string_view text, const fs::path& path) {
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
