#include "brdf/model/model_io.hpp"

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/json_fields.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {

namespace {

using json::Json;

constexpr std::string_view kFormat = "sklar brdf";
constexpr std::array<const char*, 3> kChannels = {"red", "green", "blue"};
constexpr std::array<const char*, 3> kAxes = {"theta_h", "theta_d", "phi_d"};

Json slice_to_json(const PaperSlice& slice) {
  Json json = {{"theta", slice.theta}, {"scale", slice.scale}};
  for (std::size_t axis = 0; axis < 3; ++axis) json[kAxes[axis]] = slice.masses[axis];
  return json;
}

PaperSlice slice_from(const Json& json) {
  PaperSlice slice;
  slice.theta = json::numbers(json, "theta");
  slice.scale = static_cast<float>(json::number(json, "scale"));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto masses = json::numbers(json, kAxes[axis]);
    slice.masses[axis].assign(masses.begin(), masses.end());
  }
  return slice;
}

// The one of the admissible values whose text is the field's.
template <class Value>
Value choice(const Json& json, const char* name, std::initializer_list<Value> values) {
  const std::string text = json::text(json, name);
  std::string known;
  for (const Value value : values) {
    if (to_text(value) == text) return value;
    known += (known.empty() ? "" : ", ") + std::string(to_text(value));
  }
  throw std::invalid_argument("field '" + std::string(name) + "' must be one of " + known + ", found '" + text + "'");
}

FamilyInfo family_from(const Json& json) {
  const Json& family = json::field(json, "family");
  if (family.is_object()) return families::from_definition(family.dump(), "family");
  return families::find(json::text(json, "family"));
}

StoredBrdf model_from(const Json& json) {
  json::require_format(json, kFormat, kBrdfModelVersion);
  if (json::text(json, "mode") != "paper") {
    throw std::invalid_argument("field 'mode' must be 'paper', found '" + json::text(json, "mode") + "'");
  }
  std::array<std::vector<PaperSlice>, 3> channels;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (const Json& slice : json::array(json, kChannels[channel])) channels[channel].push_back(slice_from(slice));
  }
  const auto measure = choice(json, "measure", {CellMeasure::per_cell, CellMeasure::per_solid_angle});
  return {.material = json::text(json, "material"),
          .provenance =
              choice(json, "provenance",
                     {Provenance::measured, Provenance::reconstruction, Provenance::synthetic, Provenance::unknown}),
          .method = choice(json, "method",
                           {FitMethod::least_squares, FitMethod::maximum_likelihood, FitMethod::tau_inversion}),
          .brdf = std::make_shared<PaperBrdf>(family_from(json), measure, std::move(channels))};
}

}  // namespace

std::string to_json(const StoredBrdf& model) {
  const PaperBrdf& brdf = *model.brdf;
  Json json = {{"format", kFormat},
               {"version", kBrdfModelVersion},
               {"mode", "paper"},
               {"material", model.material},
               {"provenance", to_text(model.provenance)},
               {"family", brdf.definition().empty() ? Json(brdf.family()) : Json::parse(brdf.definition())},
               {"method", to_text(model.method)},
               {"measure", to_text(brdf.measure())}};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    Json& slices = json[kChannels[channel]] = Json::array();
    for (const PaperSlice& slice : brdf.channels()[channel]) slices.push_back(slice_to_json(slice));
  }
  return json.dump() + "\n";
}

StoredBrdf parse_brdf(std::string_view text, std::string_view source) {
  return json::parse(text, source, model_from);
}

StoredBrdf read_brdf(const std::filesystem::path& path) {
  return parse_brdf(read_file(path), path.string());
}

}  // namespace sklar::brdf
