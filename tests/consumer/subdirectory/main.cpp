#include <cstdio>
#include <turnscan/core/units.hpp>
#include <turnscan/core/version.hpp>

int main() {
  const auto size = turnscan::parse_quantity("1.5mm", turnscan::Quantity::kLength);
  std::printf("turnscan %s, 1.5mm is %g m\n", turnscan::version(), size.value_or(0.0));
  return size && *size == 0.0015 ? 0 : 1;
}
