#pragma once
/// The families that `copula fit` has fitted: their order, their printed forms, the stored model.

#include <optional>
#include <string>
#include <vector>

#include "copula/inference/held_out.hpp"
#include "copula/inference/intervals.hpp"
#include "copula/inference/joint_fit.hpp"
#include "copula/inference/model_io.hpp"
#include "examples/cli/copula_data.hpp"

namespace sklar::cli {

enum class Criterion { aic, bic, held_out };

struct FamilyFit {
  const FamilyInfo* family;
  JointFit fit;
  std::optional<HeldOut> held_out{};
  std::optional<ConfidenceIntervals> intervals{};
};

struct Fits {
  std::vector<FamilyFit> families{};
  bool together = false;   ///< every family has margins of its own
  bool densities = false;  ///< every margin has a density, so that the numbers of the whole exist
};

/// Best first by the criterion, of margins and copula where the margins have densities; those without a value after
/// them, failed ones last.
void sort_by(Criterion criterion, Fits& fits);

[[nodiscard]] std::string json_of(const Fits& fits, const Sample& sample);
[[nodiscard]] std::string csv_of(const Fits& fits);

/// The copula with its margins, if any, of named columns.
[[nodiscard]] CopulaModel model_of(const FamilyFit& fit, const std::vector<std::string>& columns);

}  // namespace sklar::cli
