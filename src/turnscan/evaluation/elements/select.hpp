#pragma once

#include <turnscan/core/run_context.hpp>
#include <turnscan/evaluation/elements/elements.hpp>
#include <turnscan/evaluation/elements/fit.hpp>

namespace turnscan::elements {

/// A mesh whose points are taken for elements. Keeps a reference to it.
class Surface {
 public:
  /// Fails as validate_mesh().
  static Result<Surface> of(const TriangleMesh& mesh);

  struct Fitted {
    Fit fit;
    std::size_t points = 0;
  };
  /// Selects and fits, as measure_elements() says and with its errors.
  Result<Fitted> fit(const ElementRequest& request, const RunContext& context) const;

 private:
  explicit Surface(const TriangleMesh& mesh) : mesh_(&mesh) {}
  Result<std::vector<Sample>> samples_of_section(const Shape& nominal) const;

  const TriangleMesh* mesh_;
  std::vector<Sample> vertices_;
};

}  // namespace turnscan::elements
