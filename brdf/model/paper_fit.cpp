#include "brdf/model/paper_fit.hpp"

#include <tbb/parallel_for.h>

#include <cmath>

#include "copula/inference/cells.hpp"

namespace sklar::brdf {

namespace {

struct SliceTask {
  const MeasuredTable& table;
  const FamilyInfo& family;
  const PaperFitOptions& options;
  std::size_t channel;
  int slice;

  [[nodiscard]] int width() const { return Grid::theta_d / options.slices; }

  [[nodiscard]] std::string where() const {
    constexpr std::array<const char*, 3> kNames = {"red", "green", "blue"};
    return table.name + ", " + kNames[channel] + ", slice " + std::to_string(slice + 1) + " of " +
           std::to_string(options.slices);
  }

  // The cells of the slice, phi_d fastest.
  [[nodiscard]] Column masses() const {
    Column masses(Grid::theta_h * width() * Grid::phi_d);
    Index next = 0;
    for (int i = 0; i < Grid::theta_h; ++i) {
      for (int j = slice * width(); j < (slice + 1) * width(); ++j) {
        const double measure = options.measure == CellMeasure::per_cell ? 1 : cell_measure(i, j);
        for (int k = 0; k < Grid::phi_d; ++k, ++next) {
          const auto cell = static_cast<std::size_t>(Grid::index(i, j, k));
          masses(next) = table.valid[cell] ? table.values[channel][cell] * measure : 0.0;
        }
      }
    }
    return masses;
  }

  [[nodiscard]] FitResult fit_theta(const CellTable& cells) const {
    // 1e-5 of tau is far below what the slice's parameter can tell of the material.
    const FitOptions inner = {.tolerance = 1e-5, .standard_errors = false};
    if (options.method == FitMethod::least_squares) return fit_least_squares(family, cells, inner);
    const CellTable observed = select(cells, cells.mass > 0);
    return fit(family, options.method, observed.u, observed.mass, inner);
  }

  // The chosen cells. F is kept below 1: it rounds to 1 where the mass beyond a centre is below rounding.
  static CellTable select(const CellTable& cells, const Eigen::Array<bool, Eigen::Dynamic, 1>& chosen) {
    const Index count = chosen.count();
    CellTable result{.u = Points(count, cells.u.cols()), .mass = Column(count), .margin = Column(count), .weight = {}};
    Index next = 0;
    for (Index cell = 0; cell < chosen.size(); ++cell) {
      if (!chosen(cell)) continue;
      result.u.row(next) = cells.u.row(cell).min(std::nextafter(1.0, 0.0));
      result.mass(next) = cells.mass(cell);
      result.margin(next++) = cells.margin(cell);
    }
    return result;
  }

  void run(PaperSlice& result, FitResult& found) const {
    const Column values = masses();
    const double total = values.sum();
    if (total == 0) {
      found = {.family = family.name, .method = options.method, .status = FitStatus::converged, .message = "black"};
      return;
    }
    const std::array<Index, 3> shape = {Grid::theta_h, width(), Grid::phi_d};
    const CellTable all = cell_table(values, shape);
    // Where a margin is 0, table and model are, whatever the copula.
    const CellTable cells = select(all, all.margin > 0);
    found = fit_theta(cells);
    if (found.status == FitStatus::failed) throw std::runtime_error(where() + ": " + found.message);
    for (std::size_t axis = 0; axis < 3; ++axis) result.masses[axis] = margin(all.mass, shape, axis);
    result.theta = found.theta;
    const CopulaPtr copula = family.make(kPaperDimension, found.theta);
    result.scale = static_cast<float>(total / (copula->pdf(cells.u) * cells.margin).sum());
  }

  // Masses of one axis (Eq. 11).
  static std::vector<float> margin(const Column& mass, const std::array<Index, 3>& shape, std::size_t axis) {
    std::vector<double> sums(static_cast<std::size_t>(shape[axis]));
    for (Index cell = 0; cell < mass.size(); ++cell) {
      const std::array<Index, 3> at = {cell / (shape[1] * shape[2]), cell / shape[2] % shape[1], cell % shape[2]};
      sums[static_cast<std::size_t>(at[axis])] += mass(cell);
    }
    return {sums.begin(), sums.end()};
  }
};

}  // namespace

PaperFit fit_paper(const MeasuredTable& table, const FamilyInfo& family, const PaperFitOptions& options,
                   const Progress& progress) {
  require_table("fit_paper", table);
  if (options.slices < 1 || Grid::theta_d % options.slices != 0) {
    throw std::invalid_argument("the number of slices must divide " + std::to_string(Grid::theta_d) + ", got " +
                                std::to_string(options.slices));
  }
  const auto slices = static_cast<std::size_t>(options.slices);
  std::array<std::vector<PaperSlice>, 3> channels;
  PaperFit result;
  for (auto& channel : channels) channel.resize(slices);
  for (auto& channel : result.fits) channel.resize(slices);
  ProgressCounter counter(progress, 3 * options.slices);
  tbb::parallel_for(std::size_t{0}, 3 * slices, [&](std::size_t task) {
    const std::size_t channel = task / slices, slice = task % slices;
    const SliceTask job{table, family, options, channel, static_cast<int>(slice)};
    job.run(channels[channel][slice], result.fits[channel][slice]);
    counter.step();
  });
  result.brdf = std::make_shared<PaperBrdf>(family, options.measure, std::move(channels));
  return result;
}

}  // namespace sklar::brdf
