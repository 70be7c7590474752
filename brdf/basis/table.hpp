#pragma once
/// The measured table itself, read by trilinear interpolation (TableBrdf): 90 x 90 x 180 cells of three doubles. It has
/// one size, 35 MB, and takes no notice of the budget.
///
/// Matusik, Pfister, Brand and McMillan 2003, "A Data-Driven Reflectance Model": the grid.

#include "brdf/basis/info.hpp"
#include "brdf/data/table_brdf.hpp"

namespace sklar::brdf::basis::table {

inline BasisInfo info() {
  return {.name = "table",
          .title = "Measured table",
          .source = "Matusik, Pfister, Brand and McMillan 2003, A Data-Driven Reflectance Model",
          .fit_unchecked = [](const BasisData& data, double /*max_bytes*/) -> BrdfPtr {
            return std::make_shared<const TableBrdf>(std::make_shared<const MeasuredTable>(data.table));
          }};
}

}  // namespace sklar::brdf::basis::table
