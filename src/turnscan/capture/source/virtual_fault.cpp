#include <algorithm>
#include <array>
#include <turnscan/capture/source/virtual_fault.hpp>
#include <turnscan/core/units.hpp>

namespace turnscan::source {

namespace {

using Kind = VirtualFault::Kind;

struct Name {
  std::string_view text;
  Kind kind;
  bool at_opening;
};

constexpr std::array<Name, 8> kNames{{{"missing", Kind::kMissing, true},
                                      {"busy", Kind::kBusy, true},
                                      {"denied", Kind::kDenied, true},
                                      {"lost", Kind::kLost, false},
                                      {"stall", Kind::kStall, false},
                                      {"size", Kind::kSize, false},
                                      {"backwards", Kind::kBackwards, false},
                                      {"gap", Kind::kGap, false}}};

tl::unexpected<Error> not_a_fault(std::string_view text) {
  return fail(ErrorCode::kInvalidOption,
              "virtual: fault = {}: write missing, busy or denied, or KIND@TIME or KIND@TIME+TIME "
              "with lost, stall, size, backwards or gap, e.g. stall@2s+5s",
              text);
}

Result<VirtualFault> parse_fault(std::string_view text) {
  const std::size_t at = text.find('@');
  const std::string_view word = text.substr(0, at);
  const auto name =
      std::find_if(kNames.begin(), kNames.end(), [&](const Name& n) { return n.text == word; });
  if (name == kNames.end() || name->at_opening != (at == std::string_view::npos))
    return not_a_fault(text);
  VirtualFault fault;
  fault.kind = name->kind;
  if (name->at_opening) return fault;
  const std::string_view times = text.substr(at + 1);
  const std::size_t plus = times.find('+');
  const auto begin = parse_quantity(times.substr(0, plus), Quantity::kTime);
  if (!begin || *begin < 0.0) return not_a_fault(text);
  fault.begin_s = *begin;
  if (plus == std::string_view::npos) return fault;
  const auto length = parse_quantity(times.substr(plus + 1), Quantity::kTime);
  if (!length || *length < 0.0) return not_a_fault(text);
  fault.length_s = *length;
  return fault;
}

}  // namespace

Result<std::vector<VirtualFault>> parse_virtual_faults(std::string_view text) {
  std::vector<VirtualFault> faults;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    TURNSCAN_ASSIGN(const VirtualFault fault, parse_fault(text.substr(0, comma)));
    faults.push_back(fault);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return faults;
}

}  // namespace turnscan::source
