#include <array>
#include <turnscan/reconstruction/verdict.hpp>

namespace turnscan {

std::string_view name_of(Level level) {
  constexpr std::array<std::string_view, 3> names{"good", "fair", "bad"};
  return names[std::size_t(level)];
}

std::string_view Verdict::colour() const {
  constexpr std::array<std::string_view, 3> names{"green", "amber", "red"};
  return names[std::size_t(level())];
}

}  // namespace turnscan
