#pragma once
/// Copulas by the generic routes alone, to test the closed forms of the families against.

#include <string_view>
#include <utility>

#include "copula/archimedean.hpp"

namespace sklar::test {

/// The generator without its optional capabilities.
template <Generator G>
class Bare {
 public:
  explicit Bare(G generator) : generator_(std::move(generator)) {}

  template <class T>
  T log_psi(const T& t) const {
    return generator_.log_psi(t);
  }

  template <class T>
  T psi_inv(const T& u) const {
    return generator_.psi_inv(u);
  }

  template <class T>
  T log_abs_dpsi(int k, const T& t) const {
    return generator_.log_abs_dpsi(k, t);
  }

 private:
  G generator_;
};

template <Generator G>
CopulaPtr bare_copula(int dim, const G& generator) {
  return std::make_shared<Archimedean<Bare<G>>>(dim, Bare<G>(generator));
}

/// The registered family of that name by the generic routes; generated from the list of families.
CopulaPtr generic_copula(std::string_view family, int dim, const Theta& theta);

}  // namespace sklar::test
