// What `turnscan reconstruct RECORDING -o MESH` does.

#include <cstdio>
#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/text/reconstruction_text.hpp>

namespace {

turnscan::Result<> reconstruct(const char* recording, const char* mesh) {
  turnscan::ReconstructFiles files;
  files.mesh = mesh;
  TURNSCAN_TRY(turnscan::check_outputs(files));
  TURNSCAN_ASSIGN(const turnscan::Input input, turnscan::open_input(recording));
  const turnscan::ReconstructRequest request{};
  TURNSCAN_ASSIGN(const turnscan::ReconstructRun run,
                  turnscan::run_reconstruction(*input.frames, request, turnscan::RunContext()));
  TURNSCAN_ASSIGN(const auto written, turnscan::write_outputs(files, run, request.options));
  std::fputs(turnscan::reconstruction_text(run.reconstruction).c_str(), stdout);
  for (const std::string& note : input.notes) std::printf("Note: %s\n", note.c_str());
  for (const std::string& file : written) std::printf("Wrote %s\n", file.c_str());
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto done = reconstruct(argv[1], argv[2]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
  return done ? 0 : 1;
}
