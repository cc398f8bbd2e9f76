// batch FOLDER RECORDING...: reconstructs each recording with two voxel sizes, several at a time.
// A second run continues where the first was interrupted.

#include <cstdio>
#include <turnscan/turnscan.hpp>

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  turnscan::Batch batch;
  batch.inputs.assign(argv + 2, argv + argc);
  batch.options = {{"method", "volumetric"}};
  batch.sweep = {{"voxel-size", {"4mm", "6mm"}}};
  batch.engine = {{"jobs", "2"}};
  batch.on_status = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  const auto result = turnscan::run_batch(batch, argv[1]);
  if (!result) return std::fprintf(stderr, "%s\n", result.error().text().c_str()), 1;
  std::printf("%zu of %zu tasks done, %zu failed\n", result->done, result->tasks, result->failed);
  for (const std::string& file : result->files) std::printf("Wrote %s\n", file.c_str());
  return result->failed == 0 ? 0 : 1;
}
