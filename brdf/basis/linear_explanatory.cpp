#include "brdf/basis/linear_explanatory.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <stdexcept>

#include "brdf/basis/fit_cells.hpp"

namespace sklar::brdf {
namespace {

constexpr std::size_t kMostTerms = 495;  ///< terms(kMostDegree)

}  // namespace

ExplanatoryComponents::Values ExplanatoryComponents::variables(const Vec3& wo, const Vec3& wi) {
  const Vec3 sum = wi + wo;
  const double length = sum.norm();
  const double radius = std::sqrt(sum.x() * sum.x() + sum.y() * sum.y());
  return {wi.z() * wo.z(), 0.5 * length, sum.z() / length, std::sqrt(radius / length)};
}

ExplanatoryComponents::Values ExplanatoryComponents::at(const Vec3& wo, const Vec3& wi) const {
  return (turn.cast<double>() * variables(wo, wi).matrix()).array() + shift.cast<double>();
}

LinearExplanatory::LinearExplanatory(const ExplanatoryComponents& components, int degree,
                                     std::array<HalfArray, 3> coefficients)
    : components_(components), degree_(degree), coefficients_(std::move(coefficients)) {
  bool sound = degree >= 0 && degree <= kMostDegree;
  for (const HalfArray& channel : coefficients_) sound = sound && channel.size() == terms(degree);
  if (!sound) throw std::invalid_argument("LinearExplanatory: the coefficients are not those of a degree of 0 to 8");
}

std::size_t LinearExplanatory::terms(int degree) {
  const auto n = static_cast<std::size_t>(degree);
  return (n + 1) * (n + 2) * (n + 3) * (n + 4) / 24;
}

std::size_t LinearExplanatory::bytes(int degree) {
  return 1 + sizeof(ExplanatoryComponents) + 3 * HalfArray::bytes(terms(degree));
}

void LinearExplanatory::products(const ExplanatoryComponents::Values& z, int degree, double* out) {
  std::array<std::array<double, kMostDegree + 1>, ExplanatoryComponents::kCount> power{};
  for (std::size_t v = 0; v < power.size(); ++v) {
    const double x = z[static_cast<int>(v)];
    power[v][0] = 1;
    power[v][1] = x;
    for (std::size_t n = 2; n < power[v].size(); ++n) power[v][n] = 2 * x * power[v][n - 1] - power[v][n - 2];
  }
  const auto most = static_cast<std::size_t>(degree);
  for (std::size_t a = 0; a <= most; ++a) {
    for (std::size_t b = 0; a + b <= most; ++b) {
      const double two = power[0][a] * power[1][b];
      for (std::size_t c = 0; a + b + c <= most; ++c) {
        const double three = two * power[2][c];
        for (std::size_t d = 0; a + b + c + d <= most; ++d) *out++ = three * power[3][d];
      }
    }
  }
}

Rgb LinearExplanatory::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  std::array<double, kMostTerms> product;
  products(components_.at(wo, wi), degree_, product.data());
  Rgb sum = Rgb::Zero();
  for (std::size_t n = 0; n < coefficients_[0].size(); ++n) {
    for (std::size_t c = 0; c < 3; ++c) sum[static_cast<int>(c)] += coefficients_[c][n] * product[n];
  }
  return sum;
}

namespace basis::linear_explanatory {
namespace {

constexpr std::size_t kCells = 20000;
constexpr double kRidge = 1e-9;  ///< relative: the four variables are functions of three coordinates

ExplanatoryComponents components_of(const std::vector<FitCell>& cells) {
  constexpr int kCount = ExplanatoryComponents::kCount;
  Eigen::Matrix<double, kCount, Eigen::Dynamic> variables(kCount, static_cast<Eigen::Index>(cells.size()));
  for (std::size_t n = 0; n < cells.size(); ++n) {
    variables.col(static_cast<Eigen::Index>(n)) = ExplanatoryComponents::variables(cells[n].wo, cells[n].wi).matrix();
  }
  const Eigen::Vector4d mean = variables.rowwise().mean();
  const Eigen::Matrix<double, kCount, Eigen::Dynamic> centred = variables.colwise() - mean;
  const Eigen::Array4d deviation = (centred.rowwise().squaredNorm() / static_cast<double>(cells.size())).array().sqrt();
  const Eigen::Array4d unit = (deviation > 1e-12).select(deviation.inverse(), 0);
  const Eigen::Matrix<double, kCount, Eigen::Dynamic> scaled = unit.matrix().asDiagonal() * centred;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(scaled * scaled.transpose());
  const Eigen::Matrix4d turn = solver.eigenvectors().transpose() * unit.matrix().asDiagonal();
  const Eigen::Matrix<double, kCount, Eigen::Dynamic> turned = turn * variables;
  const Eigen::Array4d low = turned.rowwise().minCoeff(), high = turned.rowwise().maxCoeff();
  const Eigen::Array4d scale = (high - low > 1e-12).select(2 / (high - low), 0);
  return {.turn = (scale.matrix().asDiagonal() * turn).cast<float>(),
          .shift = (-0.5 * (low + high) * scale).cast<float>()};
}

BrdfPtr fit(const BasisData& data, double max_bytes) {
  require_budget("linear_explanatory", static_cast<double>(LinearExplanatory::bytes(0)), max_bytes);
  int degree = 0;
  while (degree < LinearExplanatory::kMostDegree &&
         static_cast<double>(LinearExplanatory::bytes(degree + 1)) <= max_bytes) {
    ++degree;
  }
  const std::vector<FitCell> cells = spread_cells(data.table, kCells);
  const ExplanatoryComponents components = components_of(cells);
  const auto terms = static_cast<Eigen::Index>(LinearExplanatory::terms(degree));
  Eigen::MatrixXd rows(terms, static_cast<Eigen::Index>(cells.size()));  // a column a cell, times sqrt(weight)
  Eigen::MatrixX3d values(static_cast<Eigen::Index>(cells.size()), 3);
  for (Eigen::Index n = 0; n < rows.cols(); ++n) {
    const FitCell& cell = cells[static_cast<std::size_t>(n)];
    const double root = std::sqrt(log_weight(cell.value, cell.wi.z() * cell.wo.z()).mean());
    LinearExplanatory::products(components.at(cell.wo, cell.wi), degree, rows.col(n).data());
    rows.col(n) *= root;
    values.row(n) = (root * cell.value).matrix().transpose();
  }
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(terms, terms);
  normal.selfadjointView<Eigen::Lower>().rankUpdate(rows);
  normal.diagonal().array() += kRidge * normal.trace() / static_cast<double>(terms);
  const Eigen::MatrixX3d solution = normal.selfadjointView<Eigen::Lower>().ldlt().solve(rows * values);
  std::array<HalfArray, 3> coefficients;
  for (std::size_t c = 0; c < 3; ++c) {
    const double* column = solution.col(static_cast<Eigen::Index>(c)).data();
    coefficients[c] = HalfArray(std::span(column, static_cast<std::size_t>(terms)));
  }
  return std::make_shared<const LinearExplanatory>(components, degree, std::move(coefficients));
}

}  // namespace

BasisInfo info() {
  return {.name = "linear_explanatory",
          .title = "Linear regression",
          .source =
              "Ozturk, Kurt, Bilgili and Gungor 2008, Linear approximation of Bidirectional Reflectance "
              "Distribution Functions",
          .fit_unchecked = fit};
}

}  // namespace basis::linear_explanatory
}  // namespace sklar::brdf
