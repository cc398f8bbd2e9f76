#include <turnscan/geometry/estimation/normal_equations.hpp>

namespace turnscan::estimation {

FirmSolution solve_firm(const NormalEquations<6>& equations, double held_share) {
  const SymmetricEigen<6> eigen = symmetric_eigen(equations.normal);
  FirmSolution out;
  for (int i = 0; i < 6; ++i) {
    if (!(eigen.values[i] > held_share * eigen.values[5])) {
      ++out.held_directions;
      continue;
    }
    const Vector6d direction = eigen.vectors.col(i);
    out.values += direction * (direction.dot(equations.right) / eigen.values[i]);
  }
  return out;
}

Eigen::MatrixXd sandwich_covariance(const Eigen::MatrixXd& inverse,
                                    const Eigen::MatrixXd& scatter) {
  return inverse * scatter * inverse;
}

}  // namespace turnscan::estimation
