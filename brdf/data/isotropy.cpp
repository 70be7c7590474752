#include "brdf/data/isotropy.hpp"

#include <tbb/parallel_for.h>

#include <numbers>
#include <stdexcept>

#include "brdf/data/anisotropic_brdf.hpp"
#include "brdf/data/cell_directions.hpp"
#include "brdf/data/tabulate.hpp"

namespace sklar::brdf {
namespace {

/// A table of value(coordinates), which is called above the horizon; cells where it has a coverage of 0 are masked.
template <class Value>
MeasuredTable fill(std::string name, Provenance provenance, const Value& value) {
  MeasuredTable table{.name = std::move(name), .provenance = provenance, .report = {}, .values = {}, .valid = {}};
  table.valid.assign(Grid::cells, 0);
  for (std::vector<double>& plane : table.values) plane.assign(Grid::cells, 0.0);
  tbb::parallel_for(0, Grid::theta_h, [&](int i) {
    for (int j = 0; j < Grid::theta_d; ++j) {
      for (int k = 0; k < Grid::phi_d; ++k) {
        const DirectionPair pair = cell_directions(i, j, k);
        if (!(pair.wi.z() > 0 && pair.wo.z() > 0)) continue;
        const AnisotropicTableBrdf::Reading mean =
            value(HalfDifference{Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)});
        if (mean.coverage == 0) continue;
        const auto cell = static_cast<std::size_t>(Grid::index(i, j, k));
        for (std::size_t channel = 0; channel < 3; ++channel) {
          table.values[channel][cell] = mean.value[static_cast<int>(channel)];
        }
        table.valid[cell] = 1;
      }
    }
  });
  table.report.mirror_asymmetry = mirror_asymmetry(table);
  return table;
}

}  // namespace

double isotropy_deviation(const Brdf& model, const AnisotropicGrid& grid) {
  return isotropy_deviation(tabulate_anisotropic(model, "probe", Provenance::unknown, grid));
}

MeasuredTable isotropic_mean(const Brdf& model, std::string name, Provenance provenance, int azimuths) {
  if (!model.traits().reciprocal) throw std::invalid_argument("isotropic_mean: the model must be reciprocal");
  if (azimuths < 1) {
    throw std::invalid_argument("isotropic_mean: azimuths must be at least 1, got " + std::to_string(azimuths));
  }
  return fill(std::move(name), provenance, [&](const HalfDifference& at) {
    Rgb sum = Rgb::Zero();
    for (int m = 0; m < azimuths; ++m) {
      const double phi_h = (m + 0.5) / azimuths * 2 * std::numbers::pi;
      const DirectionPair pair = directions4({at.theta_h, phi_h, at.theta_d, at.phi_d});
      sum += model.eval(pair.wo, pair.wi);
    }
    return AnisotropicTableBrdf::Reading{sum / azimuths, 1.0};
  });
}

MeasuredTable isotropic_mean(const AnisotropicTable& table) {
  const AnisotropicTableBrdf mean(std::make_shared<const AnisotropicTable>(folded(table, table.grid.phi_h, false)));
  MeasuredTable result = fill(table.name, table.provenance, [&](const HalfDifference& at) {
    return mean.at({at.theta_h, 0.0, at.theta_d, at.phi_d});
  });
  result.report.negative_share = table.report.negative_share;
  result.report.median_asymmetry = table.report.median_asymmetry;
  return result;
}

}  // namespace sklar::brdf
