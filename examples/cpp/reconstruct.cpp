// reconstruct RECORDING MESH: what `turnscan reconstruct RECORDING -o MESH` does.

#include <cstdio>
#include <turnscan/turnscan.hpp>

turnscan::Result<> run(const std::string& recording, const std::string& mesh) {
  TURNSCAN_ASSIGN(const auto opened, turnscan::open_frames(recording));
  for (const std::string& note : opened.notes) std::printf("Note: %s\n", note.c_str());

  turnscan::RunContext context;  // for progress, and to cancel from another thread
  context.set_listener([](const turnscan::Progress& p) {
    std::fprintf(stderr, "\r%-30s %3.0f %%", p.phase.c_str(), 100.0 * p.fraction);
  });
  TURNSCAN_ASSIGN(const auto scan, turnscan::reconstruct(*opened.frames, {}, context));
  std::fputc('\n', stderr);

  for (const turnscan::ObjectResult& object : scan.objects())
    std::printf("%s; volume %.1f cm3\n", object.check.text().c_str(), 1e6 * object.check.volume_m3);
  TURNSCAN_ASSIGN(const auto files, scan.write({.mesh = mesh, .report = mesh + ".json"}));
  for (const std::string& file : files) std::printf("Wrote %s\n", file.c_str());
  return {};
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto done = run(argv[1], argv[2]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
  return done ? 0 : 1;
}
