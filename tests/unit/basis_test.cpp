/// What sets each basis model apart: published identities and figures, and tables that it holds exactly.

#include <gtest/gtest.h>

#include "brdf/analytic/synthetic.hpp"
#include "brdf/basis/registry.hpp"
#include "brdf/geometry/coordinates.hpp"

namespace sklar::brdf {
namespace {

/// Calls visit(n, pair) for some thousand valid cells.
template <class Visit>
void for_some_cells(const MeasuredTable& table, const Visit& visit) {
  for (int cell = 0; cell < Grid::cells; cell += 277) {
    const int k = cell % Grid::phi_d, j = cell / Grid::phi_d % Grid::theta_d, i = cell / (Grid::phi_d * Grid::theta_d);
    const auto n = static_cast<std::size_t>(cell);
    if (table.valid[n] == 0) continue;
    visit(n, directions({Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)}));
  }
}

TEST(BasisTable, HoldsItsCells) {
  const MeasuredTable table = builtin_material();
  const BrdfPtr model = basis::find("table").fit({.table = table}, std::numeric_limits<double>::infinity());
  EXPECT_EQ(model->bytes(), 3U * 90 * 90 * 180 * 8);
  for_some_cells(table, [&](std::size_t n, const DirectionPair& pair) {
    EXPECT_NEAR(model->eval(pair.wo, pair.wi)[1], table.values[1][n], 1e-9 * table.values[1][n]);
  });
}

}  // namespace
}  // namespace sklar::brdf
