#include <turnscan/io/mesh/mesh_formats.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(obj) {
  const auto read = turnscan::mesh_io::decode_obj(turnscan::fuzz::text_of(data, size));
  if (read) turnscan::fuzz::check(*read);
  return 0;
}
