#include <turnscan/io/mesh/mesh_formats.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(threemf) {
  const auto read = turnscan::mesh_io::decode_3mf(turnscan::fuzz::text_of(data, size));
  if (read) turnscan::fuzz::check(read->meshes);
  return 0;
}
