#include "brdf/model/packed_coefficients.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sklar::brdf {
namespace {

std::size_t size_of(const std::vector<CoefficientRun>& runs) {
  std::size_t size = 0;
  for (const CoefficientRun& run : runs) size += run.count;
  return size;
}

}  // namespace

PackedCoefficients pack_runs(const std::vector<CoefficientRun>& runs, int bits,
                             const std::vector<double>& coefficients) {
  PackedCoefficients packed{.bits = bits};
  packed.levels.resize(coefficients.size());
  std::array<double, 5> low{}, high{};
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const CoefficientRun& run : runs) {
    for (std::size_t i = run.first; i < run.first + run.count; ++i) {
      low[run.part] = std::min(low[run.part], coefficients[i]);
      high[run.part] = std::max(high[run.part], coefficients[i]);
    }
  }
  for (const CoefficientRun& run : runs) {
    if (!(low[run.part] <= high[run.part])) continue;
    const double steps = std::exp2(run.bits) - 1;
    packed.lowest[run.part] = static_cast<float>(low[run.part]);
    packed.step[run.part] = static_cast<float>((high[run.part] - low[run.part]) / steps);
    const auto lowest = static_cast<double>(packed.lowest[run.part]), step = static_cast<double>(packed.step[run.part]);
    for (std::size_t i = run.first; i < run.first + run.count; ++i) {
      const double level = step > 0 ? std::round((coefficients[i] - lowest) / step) : 0.0;
      packed.levels[i] = static_cast<std::uint16_t>(std::clamp(level, 0.0, steps));
    }
  }
  return packed;
}

std::vector<double> unpack_runs(const std::vector<CoefficientRun>& runs, const PackedCoefficients& packed) {
  std::vector<double> coefficients(packed.levels.size());
  for (const CoefficientRun& run : runs) {
    const auto lowest = static_cast<double>(packed.lowest[run.part]), step = static_cast<double>(packed.step[run.part]);
    for (std::size_t i = run.first; i < run.first + run.count; ++i) {
      coefficients[i] = static_cast<double>(static_cast<float>(lowest + packed.levels[i] * step));
    }
  }
  return coefficients;
}

std::size_t packed_bytes(const std::vector<CoefficientRun>& runs) {
  std::size_t bits = 0;
  for (const CoefficientRun& run : runs) bits += run.count * static_cast<std::size_t>(run.bits);
  return (bits + 7) / 8;
}

void require_bits(const std::string& model, int bits) {
  constexpr int kFewest = 6, kMost = 16;
  if (bits >= kFewest && bits <= kMost) return;
  throw std::invalid_argument(model + ": bits is " + std::to_string(bits) + ", allowed are 6 to 16");
}

void require_packed(const std::string& model, const std::vector<CoefficientRun>& runs,
                    const PackedCoefficients& packed) {
  const auto refuse = [&](const std::string& what) { throw std::invalid_argument(model + ": " + what); };
  require_bits(model, packed.bits);
  if (const std::size_t size = size_of(runs); packed.levels.size() != size) {
    refuse(std::to_string(packed.levels.size()) + " coefficients, expected " + std::to_string(size));
  }
  for (const CoefficientRun& run : runs) {
    for (std::size_t i = run.first; i < run.first + run.count; ++i) {
      if (packed.levels[i] >> run.bits != 0) {
        refuse("level " + std::to_string(packed.levels[i]) + " does not fit the bits");
      }
    }
  }
  for (std::size_t part = 0; part < packed.step.size(); ++part) {
    if (!std::isfinite(packed.lowest[part]) || !std::isfinite(packed.step[part]) || packed.step[part] < 0) {
      refuse("a range that is not finite");
    }
  }
}

}  // namespace sklar::brdf
