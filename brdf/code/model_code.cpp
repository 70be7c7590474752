#include "brdf/code/model_code.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <type_traits>

#include "brdf/code/shader_files.hpp"
#include "brdf/code/source_text.hpp"
#include "brdf/model/coupling.hpp"
#include "brdf/model/lattice.hpp"
#include "brdf/model/spline.hpp"

namespace sklar::brdf {
namespace {

/// Coefficients of the colours along half in the text, where a constant is a spline of equal ones.
int colour_rows(const RefinedStructure& structure) {
  return std::max(structure.colour_half, kSplineOrder);
}

/// The numbers of a model in the order in which the text reads them: of each kind component by component, those with a
/// copula first.
class Values {
 public:
  explicit Values(const RefinedBrdf& model)
      : model_(model), order_(static_cast<std::size_t>(model.structure().components)) {
    const std::vector<bool> copulas = coupled(model.families());
    std::iota(order_.begin(), order_.end(), 0);
    const auto end = std::stable_partition(order_.begin(), order_.end(),
                                           [&](int k) { return copulas[static_cast<std::size_t>(k)]; });
    coupled_ = static_cast<int>(end - order_.begin());
  }

  [[nodiscard]] int coupled_components() const { return coupled_; }
  [[nodiscard]] int size() const { return static_cast<int>(values_.size()); }
  [[nodiscard]] std::vector<float> take() { return std::move(values_); }

  void add_shape() {
    const int count = model_.structure().half * model_.structure().difference;
    for (const int k : order_) {
      for (int i = 0; i < count; ++i) add(model_.tables().shape, i, k);
    }
  }

  /// The coefficients along half of the logs of both colours at the nodes of difference.
  void add_colours() {
    const RefinedStructure& s = model_.structure();
    const std::vector<double> all = unpack(model_.layout(), model_.coefficients());
    const Eigen::MatrixXd along =
        spline_basis(Eigen::ArrayXd::LinSpaced(Lattice::difference, 0, 1), s.colour_difference).transpose();
    const auto at_nodes = [&](int k, RefinedPart part) -> Eigen::MatrixXd {
      const double* first = all.data() + model_.layout().first(k, part);
      const Eigen::MatrixXd nodes =
          Eigen::Map<const Eigen::MatrixXd>(first, s.colour_half, s.colour_difference) * along;
      return nodes.replicate(colour_rows(s) / s.colour_half, 1);
    };
    for (const int k : order_) {
      const Eigen::MatrixXd red = at_nodes(k, RefinedPart::red), blue = at_nodes(k, RefinedPart::blue);
      for (int node = 0; node < Lattice::difference; ++node) {
        for (const double log : red.col(node)) values_.push_back(static_cast<float>(log));
        for (const double log : blue.col(node)) values_.push_back(static_cast<float>(log));
      }
    }
  }

  void add_powers() {
    const int degree = model_.structure().azimuth, stored = 2 * model_.tables().powers_pairs;
    for (const int k : order_) {
      for (int node = 0; node < Lattice::difference; ++node) {
        for (int m = 0; m < degree; ++m) add(model_.tables().powers, node * stored + m, k);
      }
    }
  }

  void add_copulas() {
    for (int i = 0; i < coupled_; ++i) {
      for (int node = 0; node < Lattice::plane * Lattice::difference; ++node) {
        add(model_.tables().coupling, node, order_[static_cast<std::size_t>(i)]);
      }
    }
  }

 private:
  void add(const AlignedFloats& table, int index, int component) {
    values_.push_back(table[static_cast<std::size_t>(index * kMostComponents + component)]);
  }

  const RefinedBrdf& model_;
  std::vector<int> order_;
  int coupled_ = 0;
  std::vector<float> values_{};
};

std::string structure_text(const RefinedStructure& s) {
  constexpr double kWhole = AxisRange::kWhole;
  return constant_text("components", s.components) + constant_text("half", s.half) +
         constant_text("difference", s.difference) + constant_text("colour_half", colour_rows(s)) +
         constant_text("degree", s.azimuth) + constant_text("half_nodes", Lattice::half) +
         constant_text("azimuth_nodes", Lattice::azimuth) + constant_text("difference_nodes", Lattice::difference) +
         constant_text("width", s.width) + constant_text("pole", kPole) +
         constant_text("half_low", s.half_range.low / kWhole) + constant_text("half_high", s.half_range.high / kWhole) +
         constant_text("difference_low", s.difference_range.low / kWhole) +
         constant_text("difference_high", s.difference_range.high / kWhole);
}

// A node of a sampler as numbers.
constexpr std::size_t kNodeSize = sizeof(SamplerNode) / sizeof(float);
static_assert(std::is_trivially_copyable_v<SamplerNode> && sizeof(SamplerNode) % sizeof(float) == 0);

std::string offset_text(std::string_view name, std::size_t bytes) {
  return constant_text(name, static_cast<int>(bytes / sizeof(float)));
}

template <std::size_t Components, std::size_t Cells>
std::string margin_text(const std::string& name, std::size_t bytes, const MarginTable<Components, Cells>&) {
  using Table = MarginTable<Components, Cells>;
  return offset_text(name, bytes + offsetof(Table, density)) +
         offset_text(name + "_cdf", bytes + offsetof(Table, cdf)) +
         constant_text(name + "_cells", static_cast<int>(Cells));
}

std::string node_text(const SamplerNode& node) {
  return constant_text("of_half", static_cast<int>(kOfHalf.components)) +
         constant_text("of_wi", static_cast<int>(kOfWi.components)) +
         margin_text("half_polar", offsetof(SamplerNode, half_polar), node.half_polar) +
         margin_text("half_azimuth", offsetof(SamplerNode, half_azimuth), node.half_azimuth) +
         margin_text("wi_polar", offsetof(SamplerNode, wi_polar), node.wi_polar) +
         margin_text("wi_azimuth", offsetof(SamplerNode, wi_azimuth), node.wi_azimuth) +
         offset_text("shares", offsetof(SamplerNode, shares)) + offset_text("spread", offsetof(SamplerNode, spread)) +
         constant_text("node_size", static_cast<int>(kNodeSize)) + constant_text("outgoing_nodes", kOutgoingNodes) +
         constant_text("cosine_share", kSamplerCosineShare);
}

}  // namespace

ModelCode evaluation_code(const RefinedBrdf& model) {
  Values values(model);
  std::string text = structure_text(model.structure()) + constant_text("coupled", values.coupled_components());
  const auto table = [&](const char* name, void (Values::*add)()) {
    text += constant_text(name, values.size());
    (values.*add)();
  };
  table("shape", &Values::add_shape);
  table("colours", &Values::add_colours);
  table("powers", &Values::add_powers);
  table("copulas", &Values::add_copulas);
  return {text.append("\n").append(code::common()).append("\n").append(code::refined()), values.take()};
}

ModelCode with_sampler(ModelCode code, const ConditionalSampler& sampler) {
  const std::vector<SamplerNode>& nodes = sampler.tables().nodes;
  const auto size = [&] { return static_cast<int>(code.values.size()); };
  code.text += "\n" + node_text(nodes.front()) + constant_text("cosines", size());
  code.values.insert(code.values.end(), kOutgoingCosines.begin(), kOutgoingCosines.end());
  code.text.append(constant_text("tables", size())).append("\n").append(code::sampling());
  for (const SamplerNode& node : nodes) {
    const auto numbers = std::bit_cast<std::array<float, kNodeSize>>(node);
    code.values.insert(code.values.end(), numbers.begin(), numbers.end());
  }
  return code;
}

}  // namespace sklar::brdf
