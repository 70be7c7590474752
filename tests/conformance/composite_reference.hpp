#pragma once
/// What the judge says of rotated copulas and of mixtures.

#include <utility>

#include "tests/support/family_cases.hpp"
#include "tests/support/psi_reference.hpp"

namespace sklar::test {

inline constexpr int kCompositeDigits = 400;  ///< of the working precision: 1 - 1e-300 takes 320

/// The textbook psi at 1 - u.
class RotatedReference {
 public:
  RotatedReference(const FamilyInfo& family, Theta theta, std::vector<bool> reflected)
      : base_(family, std::move(theta)), reflected_(std::move(reflected)) {}

  [[nodiscard]] Digits log_density(std::span<const double> u) const { return base_.log_density(of_base(u)); }

  /// Below 1e-310 unknown.
  [[nodiscard]] Digits cdf(std::span<const double> u) const {
    std::vector<Digits> lower(u.size(), Digits(0)), upper = of_base(u);
    for (std::size_t k = 0; k < u.size(); ++k) {
      if (reflected_[k]) lower[k] = std::exchange(upper[k], Digits(1));
    }
    return base_.volume(lower, upper);
  }

  [[nodiscard]] PsiReference::Conditional conditional(std::span<const double> given, const Digits& v) const {
    if (!reflected_[given.size()]) return base_.conditional(of_base(given), v);
    const PsiReference::Conditional base = base_.conditional(of_base(given), Digits(1 - v));
    return {base.complement, base.value, base.slope};
  }

 private:
  [[nodiscard]] std::vector<Digits> of_base(std::span<const double> u) const {
    std::vector<Digits> values;
    for (std::size_t k = 0; k < u.size(); ++k)
      values.push_back(reflected_[k] ? Digits(1 - Digits(u[k])) : Digits(u[k]));
    return values;
  }

  PsiReference base_;
  std::vector<bool> reflected_;
};

/// Sums of what the judge says of the components.
class MixtureReference {
 public:
  MixtureReference(std::vector<RotatedReference> components, std::vector<double> weights)
      : components_(std::move(components)), weights_(std::move(weights)) {}

  [[nodiscard]] Digits log_density(std::span<const double> u) const {
    Digits sum = 0;
    for (const Digits& share : shares(u)) sum += share;
    return log(sum);
  }

  [[nodiscard]] Digits cdf(std::span<const double> u) const {
    Digits sum = 0;
    for (std::size_t i = 0; i < components_.size(); ++i) sum += weights_[i] * components_[i].cdf(u);
    return sum / total();
  }

  [[nodiscard]] PsiReference::Conditional conditional(std::span<const double> given, const Digits& v) const {
    const std::vector<Digits> share = shares(given);
    Digits sum = 0;
    PsiReference::Conditional mean{0, 0, 0};
    for (std::size_t i = 0; i < components_.size(); ++i) {
      if (share[i] == 0) continue;
      const auto part = components_[i].conditional(given, v);
      mean.value += share[i] * part.value;
      mean.complement += share[i] * part.complement;
      mean.slope += share[i] * part.slope;
      sum += share[i];
    }
    return {mean.value / sum, mean.complement / sum, mean.slope / sum};
  }

 private:
  /// w_i c_i(u).
  [[nodiscard]] std::vector<Digits> shares(std::span<const double> u) const {
    std::vector<Digits> share;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const Digits density = u.size() == 1 ? Digits(1) : exp(components_[i].log_density(u));
      share.push_back(weights_[i] * density / total());
    }
    return share;
  }

  [[nodiscard]] Digits total() const {
    Digits sum = 0;
    for (const double weight : weights_) sum += weight;
    return sum;
  }

  std::vector<RotatedReference> components_;
  std::vector<double> weights_;
};

/// Coordinates from the smallest to the last doubles below 1.
inline Points extreme_points(Index n, int dim, double smallest, Rng& rng) {
  const std::array<double, 6> values = {smallest, 1e-20, 1e-3, 0.5, 0.9, 1 - 1e-14};
  Points u(n, dim);
  for (Index i = 0; i < u.size(); ++i) u(i) = values[rng() % values.size()];
  return u;
}

}  // namespace sklar::test
