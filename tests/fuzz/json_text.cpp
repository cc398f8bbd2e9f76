// The input is JSON: what is read is written and read again as the same, and a member that is set
// changes nothing else.

#include <nlohmann/json.hpp>
#include <turnscan/io/text/json_bytes.hpp>
#include <turnscan/io/text/json_fields.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(json_text) {
  using namespace turnscan;
  const std::string_view text = fuzz::text_of(data, size);
  const auto json = text::parse_json(text);
  if (!json) return 0;
  const auto again =
      text::parse_json(json->dump(-1, ' ', false, text::Json::error_handler_t::replace));
  fuzz::require(again && *again == *json, "written and read again");
  if (!json->is_object()) return 0;
  const auto set = text::parse_json(text::with_json_member(std::string(text), "complete", "true"));
  fuzz::require(set && set->is_object(), "valid with a member set");
  text::Json expected = *json;
  expected["complete"] = true;
  fuzz::require(*set == expected, "nothing else changed");
  return 0;
}
