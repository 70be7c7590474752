#pragma once
/// Every model that a material can be compared by, whatever its kind: fitted behind one call.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/data/measured_table.hpp"
#include "brdf/model/model_io.hpp"

namespace sklar::brdf {

/// What a model is fitted to.
struct ContenderData {
  std::shared_ptr<const MeasuredTable> table;
  std::span<const std::shared_ptr<const MeasuredTable>> others;  ///< for models that learn from a set of materials
  std::string inputs = {};            ///< tells the table from another of its name, whatever the text; empty: not known
  std::string inputs_of_others = {};  ///< the same of the others
};

/// A model that was fitted.
struct ContenderFit {
  BrdfPtr brdf;                        ///< with the sampler that the model has
  std::size_t bytes;                   ///< of the model, without a sampler made for it
  std::string note;                    ///< what the fit has to say, empty for nothing
  std::optional<ModelPtr> model = {};  ///< of models that can be stored
};

struct Contender {
  std::string model;     ///< "refined", "paper", or the name in the list of analytic or basis models
  std::string kind;      ///< "copula", "analytic" or "basis"
  std::string title;     ///< as printed
  std::string source;    ///< reference
  double max_bytes = 0;  ///< the budget, 0 for a model of one size
  bool learns = false;   ///< from other materials
  std::function<ContenderFit(const ContenderData&)> fit = {};  ///< throws std::runtime_error, std::logic_error
  std::string isotropic_form = {};                             ///< AnalyticInfo::isotropic_form

  /// Of files and rows: the model, with the budget where it has one ("nmf-4096").
  [[nodiscard]] std::string name() const;
};

/// The refined model (Frank's copula, the largest structure of the ladder within each budget) with a sampler made for
/// it, the paper's model (Frank), every analytic model but those whose isotropic form is another, since tables are
/// isotropic, every basis model within each budget.
/// @param budgets bytes. @throws std::invalid_argument unless there is one, and all are finite and above 0.
[[nodiscard]] std::vector<Contender> all_contenders(std::span<const double> budgets);

/// Those whose models are named, those that all_contenders leaves out included. @throws std::invalid_argument naming
/// the unknown model and listing the known ones.
[[nodiscard]] std::vector<Contender> find_contenders(std::span<const std::string> models,
                                                     std::span<const double> budgets);

}  // namespace sklar::brdf
