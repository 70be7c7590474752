#include "brdf/basis/info.hpp"

#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

void require_others(const BasisInfo& model, const BasisData& data) {
  if (data.others.size() < model.learns_from) {
    throw std::invalid_argument(model.name + ": learns from at least " + std::to_string(model.learns_from) +
                                " other materials, got " + std::to_string(data.others.size()));
  }
  if (model.learns_from == 0) return;
  for (const auto& other : data.others) {
    if (!other) throw std::invalid_argument(model.name + ": one of the other tables is missing");
    if (other.get() == &data.table || (!other->name.empty() && other->name == data.table.name)) {
      throw std::invalid_argument(model.name + ": the others hold the table '" + data.table.name +
                                  "' itself; leave it out");
    }
    require_table(model.name, *other);
  }
}

}  // namespace

BrdfPtr BasisInfo::fit(const BasisData& data, double max_bytes) const {
  if (!(max_bytes > 0))
    throw std::invalid_argument(name + ": max_bytes must be above 0, got " + sklar::to_text(max_bytes));
  require_table(name, data.table);
  require_others(*this, data);
  BrdfPtr model = fit_unchecked(data, max_bytes);
  if (const auto bytes = static_cast<double>(model->bytes()); bytes > max_bytes && data.on_message) {
    data.on_message(name + ": has " + sklar::to_text(bytes) + " bytes whatever the budget, which is " +
                    sklar::to_text(max_bytes));
  }
  return model;
}

void require_budget(std::string_view model, double needed, double max_bytes) {
  if (needed <= max_bytes) return;
  throw std::invalid_argument(std::string(model) + ": needs at least " + sklar::to_text(needed) +
                              " bytes, the budget is " + sklar::to_text(max_bytes));
}

}  // namespace sklar::brdf
