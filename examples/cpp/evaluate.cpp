// evaluate MESH REFERENCE: how far a mesh is from its reference, after a rigid alignment.

#include <cstdio>
#include <turnscan/turnscan.hpp>

turnscan::Result<> run(const std::string& mesh_file, const std::string& reference_file) {
  TURNSCAN_ASSIGN(const turnscan::TriangleMesh mesh, turnscan::read_mesh(mesh_file));
  TURNSCAN_ASSIGN(const turnscan::TriangleMesh reference, turnscan::read_mesh(reference_file));
  TURNSCAN_ASSIGN(
      const turnscan::Evaluation figures,
      turnscan::evaluate(mesh, reference, {{"align", "icp"}, {"thresholds", "0.5mm,1mm,2mm"}}));
  std::printf("accuracy      median %.3f mm, 95 %% within %.3f mm\n", 1e3 * figures.accuracy.median,
              1e3 * figures.accuracy.p95);
  std::printf("completeness  median %.3f mm, 95 %% within %.3f mm\n",
              1e3 * figures.completeness.median, 1e3 * figures.completeness.p95);
  for (const turnscan::ThresholdScore& score : figures.scores)
    std::printf("at %.1f mm: precision %.3f, recall %.3f, F %.3f\n", 1e3 * score.threshold_m,
                score.precision, score.recall, score.f);
  return {};
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto done = run(argv[1], argv[2]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
  return done ? 0 : 1;
}
