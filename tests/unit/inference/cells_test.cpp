#include "copula/inference/cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "copula/random.hpp"

namespace sklar {
namespace {

constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

TEST(CellTable, HasTheMarginsOfItsMasses) {
  const std::vector<Index> shape = {2, 3};
  const CellTable cells = cell_table(Column{{1, 0, 3, 2, 0, 4}}, shape);
  EXPECT_NEAR(cells.mass[2], 0.3, kRounding);
  const Column rows{{0.4, 0.4, 0.4, 0.6, 0.6, 0.6}};
  const Column columns{{0.3, 0.0, 0.7, 0.3, 0.0, 0.7}};
  EXPECT_LE((cells.margin - rows * columns).abs().maxCoeff(), kRounding);
  const Points centres{{0.2, 0.15}, {0.2, 0.3}, {0.2, 0.65}, {0.7, 0.15}, {0.7, 0.3}, {0.7, 0.65}};
  EXPECT_LE((cells.u - centres).abs().maxCoeff(), kRounding);
}

TEST(CellTable, CountsPointsInCells) {
  const Points u{{0, 0}, {0.49, 0.1}, {0.5, 0.1}, {1, 1}};
  const CellTable cells = count_cells(u, Column(), 2);
  EXPECT_TRUE((cells.mass == Column{{0.5, 0, 0.25, 0.25}}).all()) << cells.mass;
  const CellTable weighted = count_cells(u, Column{{1, 0, 0, 1}}, 2);
  EXPECT_TRUE((weighted.mass == Column{{0.5, 0, 0, 0.5}}).all());
}

TEST(CellTable, RefusesWhatIsNotATable) {
  const std::vector<Index> shape = {2, 2};
  EXPECT_THROW((void)cell_table(Column::Ones(3), shape), std::invalid_argument);
  EXPECT_THROW((void)cell_table(Column::Zero(4), shape), std::invalid_argument);
  EXPECT_THROW((void)cell_table(Column{{1, 1, -1, 1}}, shape), std::domain_error);
  EXPECT_THROW((void)cell_table(Column{{1, 1, std::nan(""), 1}}, shape), std::domain_error);
  EXPECT_THROW((void)cell_table(Column::Ones(2), std::vector<Index>{2}), std::invalid_argument);
  EXPECT_THROW((void)cell_table(Column::Ones(4), std::vector<Index>{-2, -2}), std::invalid_argument);
  EXPECT_THROW((void)count_cells(Points::Constant(2, 2, 0.5), Column(), 0), std::invalid_argument);
  EXPECT_THROW((void)count_cells(Points::Constant(2, 20, 0.5), Column(), 16), std::invalid_argument);
  EXPECT_THROW((void)count_cells(Points::Constant(2, 2, 1.5), Column(), 4), std::domain_error);
}

TEST(CellTable, SampleEstimatesSums) {
  constexpr double kSampling = 0.05;  // 2000 of 40000 cells, evenly spread
  const std::vector<Index> shape = {200, 200};
  Column masses(40000);
  for (Index cell = 0; cell < masses.size(); ++cell) {
    const Index row = cell / 200;
    const double x = static_cast<double>(row) / 200;
    const double y = static_cast<double>(cell % 200) / 200;
    masses[cell] = 0.1 + 500 * std::exp(-2000 * (std::pow(x - 0.3, 2) + std::pow(y - 0.6, 2)));  // a peak of 100 cells
  }
  CellTable cells = cell_table(masses, shape);
  cells.weight = Column::LinSpaced(40000, 0, 2);
  const CellTable some = sample_cells(cells, 2000);
  EXPECT_LE(some.mass.size(), 2000);
  const auto relative = [](double estimate, double exact) { return std::abs(estimate / exact - 1); };
  EXPECT_LE(relative(some.weight.sum(), cells.weight.sum()), kSampling);
  EXPECT_LE(relative((some.weight * some.mass).sum(), (cells.weight * cells.mass).sum()), kSampling);
  EXPECT_LE(relative((some.weight * some.mass.square()).sum(), (cells.weight * cells.mass.square()).sum()), kSampling);
  EXPECT_EQ(sample_cells(cells, 40000).mass.size(), 40000);
}

}  // namespace
}  // namespace sklar
