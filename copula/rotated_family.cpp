#include "copula/rotated_family.hpp"

#include <cmath>
#include <memory>

#include "copula/find_named.hpp"
#include "copula/json_fields.hpp"
#include "copula/rotated.hpp"

namespace sklar {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Dimensions common(const FamilyInfo& base, const Rotation& rotation) {
  const Dimensions a = base.dimensions, b = rotation.dimensions();
  const Dimensions both{std::max(a.lowest, b.lowest), std::min(a.highest, b.highest)};
  if (both.lowest <= both.highest) return both;
  throw std::invalid_argument("@" + rotation.name() + " is for dimension " + b.to_text() + ", " + base.name +
                              " has dimension " + a.to_text());
}

std::string title_of(const FamilyInfo& base, const Rotation& rotation) {
  if (rotation.of_all()) return "Survival " + base.title;
  if (rotation.of_one_in_a_pair()) return base.title + " rotated by " + rotation.name() + " degrees";
  return base.title + " reflected in " + rotation.name();
}

/// What does not follow from the base alike for every rotation: tau, its inverse and the tails.
void set_dependence(FamilyInfo& family, const FamilyInfo& base) {
  if (family.rotation.of_all()) {
    family.tails = [tails = base.tails](const Theta& theta) {
      const TailDependence of_base = tails(theta);
      return TailDependence{of_base.upper, of_base.lower};
    };
  } else if (family.rotation.of_one_in_a_pair()) {
    family.tau = [tau = base.tau](const Theta& theta) { return 0 - tau(theta); };
    if (base.theta_from_tau) {
      family.theta_from_tau = [inverse = base.theta_from_tau](double tau) { return inverse(-tau); };
    }
    family.tails = [tau = base.tau](const Theta& theta) {
      const double in_the_limit = tau(theta) == -1 ? 1 : 0;
      return TailDependence{in_the_limit, in_the_limit};
    };
  } else {
    family.tau = [](const Theta&) { return kNone; };
    family.theta_from_tau = {};
    family.tails = [](const Theta&) { return TailDependence{kNone, kNone}; };
  }
}

}  // namespace

FamilyInfo rotated_family(const FamilyInfo& base, const Rotation& rotation) {
  if (!base.rotation.none()) {
    throw std::invalid_argument("'" + base.name + "@" + rotation.name() + "': " + base.name + " is rotated already");
  }
  FamilyInfo family = base;
  family.name = base.name + "@" + rotation.name();
  family.title = title_of(base, rotation);
  family.dimensions = common(base, rotation);
  family.rotation = rotation;
  family.make_unchecked = [make = base.make_unchecked, rotation](int dim, const Theta& theta) -> CopulaPtr {
    return std::make_shared<Rotated>(make(dim, theta), rotation.in(dim));
  };
  set_dependence(family, base);
  if (!base.definition.empty()) {
    family.definition =
        json::Json{{"rotation", rotation.name()}, {"family", json::Json::parse(base.definition)}}.dump();
  }
  return family;
}

const FamilyInfo& find_family(std::string_view name, std::span<const FamilyInfo> families) {
  return find_named(name, families, "family", "families");
}

RotatedName split_rotation(std::string_view name) {
  const std::size_t at = name.rfind('@');
  if (at == std::string_view::npos) return {name, std::nullopt};
  return {name.substr(0, at), name.substr(at + 1)};
}

}  // namespace sklar
