#include "brdf/analytic/check.hpp"

#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::brdf {

void require_unit_rgb(std::string_view model, std::string_view argument, const Rgb& value) {
  for (const double channel : value) {
    if (channel >= 0 && channel <= 1) continue;
    throw std::domain_error(std::string(model) + ": " + std::string(argument) +
                            " must be in [0,1] in each channel, got " + to_text(channel));
  }
}

}  // namespace sklar::brdf
