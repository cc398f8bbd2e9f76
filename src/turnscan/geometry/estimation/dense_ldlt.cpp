#include <turnscan/geometry/estimation/linear_solvers.hpp>

#include <Eigen/Cholesky>

namespace turnscan::estimation {

struct DenseLdlt::Factors : Eigen::LDLT<Eigen::MatrixXd> {};

DenseLdlt::DenseLdlt() : factors_(std::make_unique<Factors>()) {}
DenseLdlt::DenseLdlt(const Eigen::MatrixXd& a) : DenseLdlt() { compute(a); }
DenseLdlt::DenseLdlt(DenseLdlt&&) noexcept = default;
DenseLdlt& DenseLdlt::operator=(DenseLdlt&&) noexcept = default;
DenseLdlt::~DenseLdlt() = default;

void DenseLdlt::compute(const Eigen::MatrixXd& a) { factors_->compute(a); }
bool DenseLdlt::succeeded() const { return factors_->info() == Eigen::Success; }
Eigen::VectorXd DenseLdlt::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }
Eigen::MatrixXd DenseLdlt::solve(const Eigen::MatrixXd& b) const { return factors_->solve(b); }
Eigen::MatrixXd DenseLdlt::inverse() const {
  return factors_->solve(Eigen::MatrixXd::Identity(factors_->rows(), factors_->rows()));
}
Eigen::VectorXd DenseLdlt::diagonal() const { return factors_->vectorD(); }

template <>
Eigen::VectorXd solve_ldlt(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return DenseLdlt(a).solve(b);
}

}  // namespace turnscan::estimation
