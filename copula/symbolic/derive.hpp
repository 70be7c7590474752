#pragma once
/// The symbolic derivative of a formula given as text, as text.

#include <string>
#include <string_view>

namespace sklar::symbolic {

/// In what a derivative is written.
enum class Language { text, latex, cpp };

/// @throws std::invalid_argument listing the known ones. @param name "text", "latex" or "cpp".
[[nodiscard]] Language language_named(std::string_view name);

/// The highest order that derive takes.
constexpr int kMaxDeriveOrder = 100;

/// The signed d^order psi / dt^order, psi a formula in t and parameters. Text is in the grammar of parser.hpp, one
/// line; C++ is one function dpsi_<order>(double t, double ...), the parameters in alphabetical order.
/// @throws ParseError; std::invalid_argument for an order outside 0..kMaxDeriveOrder and as to_cpp.
[[nodiscard]] std::string derive(std::string_view psi, int order, Language language);

}  // namespace sklar::symbolic
