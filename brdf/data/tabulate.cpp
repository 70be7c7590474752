#include "brdf/data/tabulate.hpp"

#include <tbb/parallel_for.h>

#include <stdexcept>

#include "brdf/data/cell_directions.hpp"

namespace sklar::brdf {

MeasuredTable tabulate(const Brdf& model, std::string name, Provenance provenance) {
  if (!model.traits().reciprocal || !model.traits().isotropic) {
    throw std::invalid_argument("tabulate: the model must be reciprocal and isotropic");
  }
  MeasuredTable table{.name = std::move(name), .provenance = provenance, .report = {}, .values = {}, .valid = {}};
  table.valid.assign(Grid::cells, 0);
  for (std::vector<double>& plane : table.values) plane.assign(Grid::cells, 0.0);
  tbb::parallel_for(0, Grid::theta_h, [&](int i) {
    for (int j = 0; j < Grid::theta_d; ++j) {
      for (int k = 0; k < Grid::phi_d; ++k) {
        const DirectionPair pair = cell_directions(i, j, k);
        if (!(pair.wi.z() > 0 && pair.wo.z() > 0)) continue;
        const auto cell = static_cast<std::size_t>(Grid::index(i, j, k));
        const Rgb value = model.eval(pair.wo, pair.wi);
        for (std::size_t channel = 0; channel < 3; ++channel) {
          table.values[channel][cell] = value[static_cast<int>(channel)];
        }
        table.valid[cell] = 1;
      }
    }
  });
  table.report.mirror_asymmetry = mirror_asymmetry(table);
  return table;
}

AnisotropicTable tabulate_anisotropic(const Brdf& model, std::string name, Provenance provenance,
                                      const AnisotropicGrid& grid) {
  if (!model.traits().reciprocal) throw std::invalid_argument("tabulate_anisotropic: the model must be reciprocal");
  grid.require("tabulate_anisotropic");
  AnisotropicTable table{std::move(name), provenance, grid, {}, {}, {}};
  table.valid.assign(grid.stored_cells(), 0);
  for (std::vector<float>& plane : table.values) plane.assign(grid.stored_cells(), 0.0F);
  tbb::parallel_for(0, grid.theta_h * grid.stored_phi_h(), [&](int row) {
    const int i = row / grid.stored_phi_h();
    const int m = row % grid.stored_phi_h();
    for (int j = 0; j < grid.theta_d; ++j) {
      for (int k = 0; k < grid.phi_d; ++k) {
        const DirectionPair pair = directions4(grid.centre(i, m, j, k));
        if (!(pair.wi.z() > 0 && pair.wo.z() > 0)) continue;
        const std::size_t cell = grid.index(i, m, j, k);
        const Rgb value = model.eval(pair.wo, pair.wi);
        for (std::size_t channel = 0; channel < 3; ++channel) {
          table.values[channel][cell] = static_cast<float>(value[static_cast<int>(channel)]);
        }
        table.valid[cell] = 1;
      }
    }
  });
  return table;
}

}  // namespace sklar::brdf
