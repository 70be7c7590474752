#pragma once
/// The cheapest anisotropic model that meets a budget.

#include <functional>
#include <string>
#include <vector>

#include "brdf/model/anisotropic_fit.hpp"
#include "brdf/study/budget.hpp"

namespace sklar::brdf {

/// One model of the front.
struct AnisotropicPoint {
  AnisotropicFit fit = {};
  ModelFigures figures = {};
};

/// Structures from 0.4 to 3 KB at 12 bits a coefficient, each larger and more exact than the one before.
[[nodiscard]] const std::vector<AnisotropicStructure>& anisotropic_ladder();

/// The models fitted, and the one that serves the budget.
struct AnisotropicChoice {
  std::vector<AnisotropicPoint> front;  ///< in the order they were fitted
  std::size_t chosen;                   ///< index in front
};

/// As choose_model. The structure of `options` is not used; lobes are tilted where the table is not the same after a
/// half turn. @throws as choose_model.
[[nodiscard]] AnisotropicChoice choose_anisotropic(const AnisotropicTable& table, const Budget& budget,
                                                   AnisotropicFitOptions options = {},
                                                   const std::function<void(const std::string&)>& progress = {});

/// The front as a Markdown table, the chosen row marked.
[[nodiscard]] std::string to_markdown(const AnisotropicChoice& choice);

}  // namespace sklar::brdf
