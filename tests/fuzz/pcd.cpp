#include <turnscan/io/cloud/cloud_io.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(pcd) {
  const auto read = turnscan::decode_cloud(turnscan::fuzz::text_of(data, size));
  if (read) turnscan::fuzz::check(*read);
  return 0;
}
