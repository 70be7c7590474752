#include "brdf/model/model_io.hpp"

#include <algorithm>
#include <cmath>

#include "brdf/model/model_binary.hpp"
#include "brdf/model/structure_fields.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/json_fields.hpp"
#include "copula/listed.hpp"

namespace sklar::brdf {

namespace {

using json::Json;

constexpr std::string_view kFormat = "sklar brdf";
constexpr int kVersionOfRanges = 4;
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
  for (const Value value : values) {
    if (to_text(value) == text) return value;
  }
  throw std::invalid_argument("field '" + std::string(name) + "' must be one of " +
                              listed(values, [](Value value) { return to_text(value); }) + ", found '" + text + "'");
}

FamilyInfo family_from(const Json& family) {
  if (!family.is_object() && !family.is_string()) {
    throw std::invalid_argument("a family must be a name or a definition");
  }
  return stored_family(family.is_object() ? family.dump() : family.get<std::string>());
}

Json family_to_json(const std::string& name, const std::string& definition) {
  return definition.empty() ? Json(name) : Json::parse(definition);
}

std::shared_ptr<const PaperBrdf> paper_from(const Json& json) {
  std::array<std::vector<PaperSlice>, 3> channels;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (const Json& slice : json::array(json, kChannels[channel])) channels[channel].push_back(slice_from(slice));
  }
  const auto measure = choice(json, "measure", {CellMeasure::per_cell, CellMeasure::per_solid_angle});
  return std::make_shared<PaperBrdf>(family_from(json::field(json, "family")), measure, std::move(channels));
}

void write_paper(const PaperBrdf& brdf, FitMethod method, Json& json) {
  json["family"] = family_to_json(brdf.family(), brdf.definition());
  json["method"] = to_text(method);
  json["measure"] = to_text(brdf.measure());
  for (std::size_t channel = 0; channel < 3; ++channel) {
    Json& slices = json[kChannels[channel]] = Json::array();
    for (const PaperSlice& slice : brdf.channels()[channel]) slices.push_back(slice_to_json(slice));
  }
}

std::array<float, 5> ranges_from(const Json& json, const char* name) {
  const std::vector<double> values = json::numbers(json, name);
  std::array<float, 5> result{};
  if (values.size() != result.size()) {
    throw std::invalid_argument("field '" + std::string(name) + "' must have " + std::to_string(result.size()) +
                                " numbers, found " + std::to_string(values.size()));
  }
  std::transform(values.begin(), values.end(), result.begin(), [](double x) { return static_cast<float>(x); });
  return result;
}

PackedCoefficients packed_from(const Json& json) {
  PackedCoefficients packed{
      .bits = json::integer(json, "bits"), .lowest = ranges_from(json, "lowest"), .step = ranges_from(json, "step")};
  for (const double level : json::numbers(json, "levels")) {
    if (!(level >= 0 && level <= 0xFFFF && level == std::floor(level))) {
      throw std::invalid_argument("field 'levels' must have whole numbers from 0 to 65535, found " +
                                  sklar::to_text(level));
    }
    packed.levels.push_back(static_cast<std::uint16_t>(level));
  }
  return packed;
}

void write_packed(const PackedCoefficients& packed, Json& json) {
  json["bits"] = packed.bits;
  json["lowest"] = packed.lowest;
  json["step"] = packed.step;
  json["levels"] = packed.levels;
}

AxisRange range_from(const Json& json, const char* name) {
  const Json& ends = json::array(json, name);
  const auto whole = [](const Json& end) { return end.is_number_integer() && end >= 0 && end <= AxisRange::kWhole; };
  if (ends.size() != 2 || !whole(ends[0]) || !whole(ends[1])) {
    throw std::invalid_argument("field '" + std::string(name) + "' must be two whole numbers in 0 to " +
                                std::to_string(AxisRange::kWhole) + ", found " + ends.dump());
  }
  return {ends[0].get<int>(), ends[1].get<int>()};
}

std::shared_ptr<const RefinedBrdf> refined_from(const Json& json) {
  RefinedStructure structure;
  const Json& sizes = json::field(json, "structure");
  for_each_count(structure, [&](const char* name, int& count) { count = json::integer(sizes, name); });
  structure.width = json::number(sizes, "width");
  for_each_range(structure, [&](const char* name, AxisRange& range) {
    if (sizes.contains(name)) range = range_from(sizes, name);
  });
  std::vector<FamilyInfo> families;
  for (const Json& family : json::array(json, "families")) families.push_back(family_from(family));
  auto packed = packed_from(json);
  return std::make_shared<RefinedBrdf>(structure, std::move(families), std::move(packed));
}

void write_refined(const RefinedBrdf& brdf, Json& json) {
  Json& sizes = json["structure"] = Json::object();
  for_each_count(brdf.structure(), [&](const char* name, int count) { sizes[name] = count; });
  sizes["width"] = brdf.structure().width;
  if (!is_whole(brdf.structure())) {
    for_each_range(brdf.structure(), [&](const char* name, const AxisRange& range) {
      sizes[name] = {range.low, range.high};
    });
    json["version"] = kVersionOfRanges;
  }
  json["families"] = Json::array();
  for (const FamilyInfo& family : brdf.families()) {
    json["families"].push_back(family_to_json(family.name, family.definition));
  }
  write_packed(brdf.coefficients(), json);
}

std::shared_ptr<const AnisotropicModel> anisotropic_from(const Json& json) {
  AnisotropicStructure structure;
  const Json& sizes = json::field(json, "structure");
  for_each_count(structure, [&](const char* name, int& count) { count = json::integer(sizes, name); });
  const Json& tilted = json::field(sizes, "tilted");
  if (!tilted.is_boolean()) throw std::invalid_argument("field 'tilted' must be true or false");
  structure.tilted = tilted.get<bool>();
  return std::make_shared<AnisotropicModel>(structure, packed_from(json));
}

void write_anisotropic(const AnisotropicModel& brdf, Json& json) {
  Json& sizes = json["structure"] = Json::object();
  for_each_count(brdf.structure(), [&](const char* name, int count) { sizes[name] = count; });
  sizes["tilted"] = brdf.structure().tilted;
  write_packed(brdf.coefficients(), json);
}

StoredBrdf model_from(const Json& json) {
  json::require_format(json, kFormat, kBrdfModelVersion);
  StoredBrdf stored{.material = json::text(json, "material"),
                    .provenance = choice(
                        json, "provenance",
                        {Provenance::measured, Provenance::reconstruction, Provenance::synthetic, Provenance::unknown}),
                    .model = {}};
  const std::string mode = json::text(json, "mode");
  if (mode == "paper") {
    stored.method =
        choice(json, "method", {FitMethod::least_squares, FitMethod::maximum_likelihood, FitMethod::tau_inversion});
    stored.model = paper_from(json);
  } else if (mode == "refined") {
    stored.model = refined_from(json);
  } else if (mode == "anisotropic") {
    stored.model = anisotropic_from(json);
  } else {
    throw std::invalid_argument("field 'mode' must be 'paper', 'refined' or 'anisotropic', found '" + mode + "'");
  }
  return stored;
}

}  // namespace

std::string to_json(const StoredBrdf& model) {
  // The oldest version that has the mode, and the mode, by ModelPtr::index().
  constexpr std::array<std::pair<int, const char*>, std::variant_size_v<ModelPtr>> kModes = {
      {{1, "paper"}, {2, "refined"}, {3, "anisotropic"}}};
  const auto& [version, mode] = kModes[model.model.index()];
  Json json = {{"format", kFormat},
               {"version", version},
               {"mode", mode},
               {"material", model.material},
               {"provenance", to_text(model.provenance)}};
  if (const auto* paper = std::get_if<std::shared_ptr<const PaperBrdf>>(&model.model)) {
    write_paper(**paper, model.method, json);
  } else if (const auto* refined = std::get_if<std::shared_ptr<const RefinedBrdf>>(&model.model)) {
    write_refined(**refined, json);
  } else {
    write_anisotropic(*std::get<std::shared_ptr<const AnisotropicModel>>(model.model), json);
  }
  return json.dump() + "\n";
}

StoredBrdf parse_brdf(std::string_view text, std::string_view source) {
  return json::parse(text, source, model_from);
}

StoredBrdf read_brdf(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  return bytes.starts_with(kBinaryMagic) ? parse_binary(bytes, path.string()) : parse_brdf(bytes, path.string());
}

bool is_binary_path(const std::filesystem::path& path) {
  return path.extension() == ".sklar";
}

bool is_model_path(const std::filesystem::path& path) {
  return path.extension() == ".json" || is_binary_path(path);
}

void write_brdf(const std::filesystem::path& path, const StoredBrdf& model) {
  write_file(path, is_binary_path(path) ? to_binary(model) : to_json(model));
}

}  // namespace sklar::brdf
