#include <turnscan/io/mesh/mesh_formats.hpp>

#include "tests/fuzz/checks.hpp"

// lib3mf 1.8 opens each part of the archive through libzip and never closes it: 160 bytes a part
// stay behind with every file. Their release is not in our hands.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libzip.so"; }

TURNSCAN_FUZZ_TARGET(threemf) {
  const auto read = turnscan::mesh_io::decode_3mf(turnscan::fuzz::text_of(data, size));
  if (read) turnscan::fuzz::check(read->meshes);
  return 0;
}
