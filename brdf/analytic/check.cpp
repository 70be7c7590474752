#include "brdf/analytic/check.hpp"

#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

[[noreturn]] void fail(std::string_view model, std::string_view argument, const Interval& interval, const char* where,
                       double value) {
  throw std::domain_error(std::string(model) + ": " + std::string(argument) + " must be in " + interval.to_text() +
                          where + ", got " + sklar::to_text(value));
}

}  // namespace

void require_inside(std::string_view model, std::string_view argument, const Interval& interval, double value) {
  if (!interval.contains(value)) fail(model, argument, interval, "", value);
}

void require_inside(std::string_view model, std::string_view argument, const Interval& interval, const Rgb& value) {
  for (const double channel : value) {
    if (!interval.contains(channel)) fail(model, argument, interval, " in each channel", channel);
  }
}

}  // namespace sklar::brdf
