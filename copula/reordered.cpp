#include "copula/reordered.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "copula/archimedean_copula.hpp"
#include "copula/mixture.hpp"
#include "copula/rotated.hpp"

namespace sklar {
namespace {

void require_order(int dim, std::span<const int> order) {
  std::vector<int> sorted(order.begin(), order.end()), all(static_cast<std::size_t>(dim));
  std::ranges::sort(sorted);
  std::iota(all.begin(), all.end(), 0);
  if (sorted == all) return;
  throw std::invalid_argument("reordered: order must hold each of 0 to " + std::to_string(dim - 1) + " once");
}

}  // namespace

CopulaPtr reordered(const CopulaPtr& copula, std::span<const int> order) {
  require_order(copula->dim(), order);
  if (std::ranges::is_sorted(order) || dynamic_cast<const ArchimedeanCopula*>(copula.get()) != nullptr) return copula;
  if (const auto* rotated = dynamic_cast<const Rotated*>(copula.get())) {
    std::vector<bool> reflected;
    for (const int coordinate : order) reflected.push_back(rotated->reflects(coordinate));
    return std::make_shared<Rotated>(reordered(rotated->base(), order), std::move(reflected));
  }
  if (const auto* mixture = dynamic_cast<const Mixture*>(copula.get())) {
    std::vector<CopulaPtr> components;
    for (const CopulaPtr& component : mixture->components()) components.push_back(reordered(component, order));
    return std::make_shared<Mixture>(std::move(components), mixture->weights());
  }
  throw std::invalid_argument("reordered: this copula is not known to be exchangeable");
}

}  // namespace sklar
