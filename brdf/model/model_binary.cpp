#include "brdf/model/model_binary.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include "brdf/model/coupling.hpp"
#include "brdf/model/structure_fields.hpp"
#include "copula/error.hpp"
#include "copula/json_fields.hpp"

namespace sklar::brdf {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they stand in memory");

constexpr std::uint8_t kRefined = 2, kAnisotropic = 3, kRefinedOnPart = 4;

class Writer {
 public:
  template <class Number>
  void number(Number value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes_.append(raw, sizeof value);
  }
  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
  }
  void raw(std::string_view bytes) { bytes_ += bytes; }

  void levels(const std::vector<CoefficientRun>& runs, const std::vector<std::uint16_t>& levels) {
    std::uint32_t pending = 0;
    int count = 0;
    for (const CoefficientRun& run : runs) {
      for (std::size_t i = run.first; i < run.first + run.count; ++i) {
        pending |= static_cast<std::uint32_t>(levels[i]) << count;
        for (count += run.bits; count >= 8; count -= 8, pending >>= 8) number(static_cast<std::uint8_t>(pending));
      }
    }
    if (count > 0) number(static_cast<std::uint8_t>(pending));
  }

  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] std::string_view raw(std::size_t count) {
    if (count > bytes_.size() - at_) {
      throw std::invalid_argument("ends at byte " + std::to_string(bytes_.size()) + ", expected " +
                                  std::to_string(count) + " more at byte " + std::to_string(at_));
    }
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  template <class Number>
  [[nodiscard]] Number number() {
    Number value;
    std::memcpy(&value, raw(sizeof value).data(), sizeof value);
    return value;
  }
  [[nodiscard]] std::string text() {
    std::string result(raw(number<std::uint32_t>()));
    json::require_utf8("a text", result);
    return result;
  }

  [[nodiscard]] std::vector<std::uint16_t> levels(const std::vector<CoefficientRun>& runs) {
    std::vector<std::uint16_t> result;
    std::uint32_t pending = 0;
    int count = 0;
    for (const CoefficientRun& run : runs) {
      for (std::size_t i = 0; i < run.count; ++i, count -= run.bits, pending >>= run.bits) {
        for (; count < run.bits; count += 8) pending |= static_cast<std::uint32_t>(number<std::uint8_t>()) << count;
        result.push_back(static_cast<std::uint16_t>(pending & ((1U << run.bits) - 1)));
      }
    }
    return result;
  }

  void require_end() const {
    if (at_ == bytes_.size()) return;
    throw std::invalid_argument("has " + std::to_string(bytes_.size()) + " bytes, expected " + std::to_string(at_));
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// The number in double whose decimal text is the shortest of the float.
double decimal(float value) {
  char text[32];
  const char* end = std::to_chars(text, text + sizeof text, value).ptr;
  double result = 0;
  std::from_chars(text, end, result);
  return result;
}

template <class Structure>
void write_counts(const Structure& structure, Writer& writer) {
  for_each_count(structure, [&](const char*, int count) { writer.number(static_cast<std::uint8_t>(count)); });
}

template <class Structure>
Structure read_counts(Reader& reader) {
  Structure structure;
  for_each_count(structure, [&](const char*, int& count) { count = reader.number<std::uint8_t>(); });
  return structure;
}

void write_ranges(const PackedCoefficients& packed, Writer& writer) {
  writer.number(static_cast<std::uint8_t>(packed.bits));
  for (const float value : packed.lowest) writer.number(value);
  for (const float value : packed.step) writer.number(value);
}

PackedCoefficients read_ranges(const std::string& model, Reader& reader) {
  PackedCoefficients packed{.bits = reader.number<std::uint8_t>()};
  require_bits(model, packed.bits);
  for (float& value : packed.lowest) value = reader.number<float>();
  for (float& value : packed.step) value = reader.number<float>();
  return packed;
}

void write_refined(const RefinedBrdf& brdf, Writer& writer) {
  std::vector<std::string> names;
  std::string indices;
  for (const FamilyInfo& family : brdf.families()) {
    const std::string& name = family.definition.empty() ? family.name : family.definition;
    const auto found = std::find(names.begin(), names.end(), name);
    indices += static_cast<char>(found - names.begin());
    if (found == names.end()) names.push_back(name);
  }
  writer.number(static_cast<std::uint8_t>(names.size()));
  for (const std::string& name : names) writer.text(name);
  write_counts(brdf.structure(), writer);
  if (!is_whole(brdf.structure())) {
    for_each_range(brdf.structure(), [&](const char*, const AxisRange& range) {
      for (const int end : {range.low, range.high}) writer.number(static_cast<std::uint8_t>(end));
    });
  }
  writer.number(static_cast<float>(brdf.structure().width));
  write_ranges(brdf.coefficients(), writer);
  writer.raw(indices);
  writer.levels(brdf.layout().runs(brdf.coefficients().bits), brdf.coefficients().levels);
}

std::shared_ptr<const RefinedBrdf> read_refined(Reader& reader, bool on_part) {
  std::vector<FamilyInfo> named;
  for (int left = reader.number<std::uint8_t>(); left > 0; --left) named.push_back(stored_family(reader.text()));
  auto structure = read_counts<RefinedStructure>(reader);
  if (on_part) {
    for_each_range(structure, [&](const char*, AxisRange& range) {
      for (int* end : {&range.low, &range.high}) *end = reader.number<std::uint8_t>();
    });
  }
  structure.width = decimal(reader.number<float>());
  require_structure(structure);
  PackedCoefficients packed = read_ranges("refined model", reader);
  std::vector<FamilyInfo> families;
  for (int k = 0; k < structure.components; ++k) {
    const std::size_t index = reader.number<std::uint8_t>();
    if (index >= named.size()) {
      throw std::invalid_argument("component " + std::to_string(k) + " has family " + std::to_string(index) + " of " +
                                  std::to_string(named.size()));
    }
    families.push_back(named[index]);
  }
  packed.levels = reader.levels(RefinedLayout(structure, coupled(families)).runs(packed.bits));
  return std::make_shared<RefinedBrdf>(structure, std::move(families), std::move(packed));
}

void write_anisotropic(const AnisotropicModel& brdf, Writer& writer) {
  write_counts(brdf.structure(), writer);
  writer.number(static_cast<std::uint8_t>(brdf.structure().tilted ? 1 : 0));
  write_ranges(brdf.coefficients(), writer);
  writer.levels(AnisotropicLayout(brdf.structure()).runs(brdf.coefficients().bits), brdf.coefficients().levels);
}

std::shared_ptr<const AnisotropicModel> read_anisotropic(Reader& reader) {
  auto structure = read_counts<AnisotropicStructure>(reader);
  structure.tilted = reader.number<std::uint8_t>() != 0;
  require_structure(structure);
  PackedCoefficients packed = read_ranges("anisotropic model", reader);
  packed.levels = reader.levels(AnisotropicLayout(structure).runs(packed.bits));
  return std::make_shared<AnisotropicModel>(structure, std::move(packed));
}

StoredBrdf read(Reader& reader) {
  (void)reader.raw(kBinaryMagic.size());
  if (const int version = reader.number<std::uint8_t>(); version != kBinaryVersion) {
    throw std::invalid_argument("has version " + std::to_string(version) + ", this program reads " +
                                std::to_string(kBinaryVersion));
  }
  const auto mode = reader.number<std::uint8_t>();
  const auto provenance = reader.number<std::uint8_t>();
  if (provenance > static_cast<std::uint8_t>(Provenance::unknown)) {
    throw std::invalid_argument("has provenance " + std::to_string(provenance) + ", allowed are 0 to 3");
  }
  StoredBrdf stored{.material = reader.text(), .provenance = static_cast<Provenance>(provenance), .model = {}};
  if (mode == kRefined || mode == kRefinedOnPart) {
    stored.model = read_refined(reader, mode == kRefinedOnPart);
  } else if (mode == kAnisotropic) {
    stored.model = read_anisotropic(reader);
  } else {
    throw std::invalid_argument("has mode " + std::to_string(mode) + ", allowed are 2 to 4");
  }
  reader.require_end();
  return stored;
}

}  // namespace

std::string to_binary(const StoredBrdf& model) {
  const auto* refined = std::get_if<std::shared_ptr<const RefinedBrdf>>(&model.model);
  const auto* anisotropic = std::get_if<std::shared_ptr<const AnisotropicModel>>(&model.model);
  if (refined == nullptr && anisotropic == nullptr) {
    throw std::invalid_argument("a model of mode 'paper' has no binary form, only JSON");
  }
  Writer writer;
  writer.raw(kBinaryMagic);
  writer.number(static_cast<std::uint8_t>(kBinaryVersion));
  writer.number(refined == nullptr ? kAnisotropic : is_whole((*refined)->structure()) ? kRefined : kRefinedOnPart);
  writer.number(static_cast<std::uint8_t>(model.provenance));
  writer.text(model.material);
  if (refined != nullptr) {
    write_refined(**refined, writer);
  } else {
    write_anisotropic(**anisotropic, writer);
  }
  return writer.take();
}

StoredBrdf parse_binary(std::string_view bytes, std::string_view source) {
  try {
    Reader reader(bytes);
    return read(reader);
  } catch (const std::logic_error& error) {
    throw FileError(source, error.what());
  }
}

}  // namespace sklar::brdf
