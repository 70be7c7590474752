#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "brdf/study/table_text.hpp"
#include "copula/file.hpp"
#include "copula/inference/dependence.hpp"
#include "copula/inference/diagnostics.hpp"
#include "copula/inference/joint_fit.hpp"
#include "copula/inference/select.hpp"
#include "copula/plot/plot.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/copula_data.hpp"
#include "examples/cli/text.hpp"
#include "families/registry.hpp"

namespace sklar::cli {
namespace {

using plot::Axis;
using plot::Line;
using plot::LinePlot;
using plot::Marker;
using plot::Page;

constexpr Index kMostPoints = 2000;      // of a scatter plot
constexpr Index kMostCompared = 10'000;  // rows whose joint ranks are taken in more than two dimensions
constexpr Index kMostColumns = 8;        // of a pairs plot
constexpr plot::Colour kInk{0.13, 0.13, 0.13};
constexpr plot::Colour kGrey{0.55, 0.55, 0.55};
constexpr plot::Colour kPoints{0.000, 0.447, 0.698};

struct Options {
  DataOptions data;
  std::string families = "all";
  std::string margins = "empirical";
  std::string format = "png";
  std::filesystem::path folder = "out";
};

/// A family that could be fitted.
struct Fitted {
  const FamilyInfo* family;
  FitResult result;
  CopulaPtr copula;

  /// Name and parameters.
  [[nodiscard]] std::string label() const {
    std::string text = family->name;
    for (const double theta : result.theta) text += " " + brdf::printed("%.4g", theta);
    return text;
  }
};

struct FittedSample {
  Sample data;
  std::vector<MarginFit> margins;  ///< none where the columns are in (0,1) already
  Points u;
  std::vector<Fitted> fits;  ///< the best first

  [[nodiscard]] const std::string& name(Index column) const { return data.names[static_cast<std::size_t>(column)]; }
};

/// At most `most` of the rows 0 to n-1, evenly spread.
std::vector<Index> spread(Index n, Index most) {
  std::vector<Index> rows(static_cast<std::size_t>(std::min(n, most)));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = static_cast<Index>(i) * n / static_cast<Index>(rows.size());
  }
  return rows;
}

/// Which of n order statistics are shown: the largest hundred, below them every one whose rank from above is 1 %
/// higher.
std::vector<Index> shown_of_ordered(Index n) {
  std::vector<Index> shown;
  for (Index above = 0; above < n; above = std::max(above + 1, above * 101 / 100)) shown.push_back(n - 1 - above);
  return shown;
}

std::string count_text(Index used, Index n, const char* what) {
  return used == n ? "" : ", " + std::to_string(used) + " of them " + what;
}

/// The normal scores of a pair of columns.
LinePlot scatter(const FittedSample& sample, const Points& scores, Index across, Index up, const Axis& x,
                 const Axis& y) {
  Line points{.colour = kPoints, .width = 0, .marker = Marker::dot};
  for (Index row = 0; row < scores.rows(); ++row) {
    points.x.push_back(scores(row, across));
    points.y.push_back(scores(row, up));
  }
  return {.title = sample.name(up) + " against " + sample.name(across), .x = x, .y = y, .lines = {points}};
}

/// Whether a logarithmic axis shows positive values better.
bool is_skewed(const Column& sorted) {
  return sorted[0] > 0 && sorted.mean() > 2 * sorted[sorted.size() / 2];
}

/// About 2 n^(1/3) bins (Rice); of logarithms for positive values whose mean is more than twice their median.
LinePlot histogram(const std::string& name, const ColumnRef& values) {
  constexpr double kMostBins = 60;
  Column sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const double lowest = sorted[0];
  const double highest = sorted[sorted.size() - 1];
  const bool logarithmic = is_skewed(sorted);
  const double low = logarithmic ? std::log(lowest) : lowest;
  const double range = (logarithmic ? std::log(highest) : highest) - low;
  const auto bins =
      static_cast<std::size_t>(std::min(kMostBins, std::ceil(2 * std::cbrt(static_cast<double>(values.size())))));
  std::vector<double> counts(bins, 0.0);
  for (const double value : values) {
    const double share = range > 0 ? ((logarithmic ? std::log(value) : value) - low) / range : 0;
    ++counts[std::min(static_cast<std::size_t>(share * static_cast<double>(bins)), bins - 1)];
  }
  Line outline{.colour = kPoints, .width = 1, .filled = true};
  for (std::size_t bin = 0; bin < bins; ++bin) {
    for (const std::size_t edge : {bin, bin + 1}) {
      const double at = low + range * static_cast<double>(edge) / static_cast<double>(bins);
      outline.x.push_back(logarithmic ? std::exp(at) : at);
      outline.y.push_back(counts[bin]);
    }
  }
  const Axis x{.label = name, .scale = logarithmic ? plot::Scale::logarithmic : plot::Scale::linear};
  const double top = *std::max_element(counts.begin(), counts.end());
  return {.title = name, .x = x, .y = plot::fitted({.label = "rows a bin"}, {0, top}), .lines = {outline}};
}

/// Contours of the density of two coordinates with normal margins, each holding a share of the distribution.
std::vector<Line> contours(const Copula& copula, double limit) {
  constexpr Index kSide = 121;
  std::vector<double> z(kSide);
  for (Index i = 0; i < kSide; ++i) {
    z[static_cast<std::size_t>(i)] = limit * (2 * static_cast<double>(i) / (kSide - 1) - 1);
  }
  const Eigen::Map<const Eigen::ArrayXd> axis(z.data(), kSide);
  const Eigen::ArrayXd u = axis.unaryExpr([](double value) { return 0.5 * std::erfc(-value / std::sqrt(2.0)); });
  Points grid(kSide * kSide, 2);
  for (Index column = 0; column < kSide; ++column) {
    grid.col(0).segment(column * kSide, kSide) = u[column];
    grid.col(1).segment(column * kSide, kSide) = u;
  }
  // The first coordinate is uniform: the density of a pair is that of the second given the first.
  const Column log_density = copula.log_conditional_pdf(grid);
  Points density = Eigen::Map<const Points>(log_density.data(), kSide, kSide).exp();
  const Eigen::ArrayXd normal = (-0.5 * axis.square()).exp();
  density = density.colwise() * normal;
  density = density.rowwise() * normal.transpose();

  std::vector<double> falling(density.data(), density.data() + density.size());
  std::erase_if(falling, [](double value) { return !std::isfinite(value); });
  std::sort(falling.rbegin(), falling.rend());
  std::vector<double> mass(falling.size());
  std::partial_sum(falling.begin(), falling.end(), mass.begin());
  std::vector<Line> lines;
  for (const int percent : {95, 75, 50, 25}) {
    const auto reached = std::lower_bound(mass.begin(), mass.end(), percent / 100.0 * mass.back()) - mass.begin();
    Line line = plot::contour(z, z, density, falling[static_cast<std::size_t>(reached)]);
    line.label = std::to_string(percent) + " %";
    line.colour = plot::viridis(0.9 - 0.9 * percent / 100.0);
    lines.push_back(std::move(line));
  }
  return lines;
}

LinePlot density(const FittedSample& sample, Index across, Index up, double limit, const Axis& x, const Axis& y) {
  const Fitted& best = sample.fits.front();
  LinePlot plot{.x = x, .y = y};
  plot.title = "\u03c4 = " + brdf::printed("%.3f", kendall_tau(sample.u.col(across), sample.u.col(up)));
  if (!std::isnan(best.result.tau))
    plot.title += ", " + best.family->name + " " + brdf::printed("%.3f", best.result.tau);
  const bool pairs_differ = sample.u.cols() > 2 && std::isnan(best.result.tau);
  if (!pairs_differ) plot.lines = contours(*best.copula, limit);
  return plot;
}

/// Below the diagonal the data, on it their histograms, above it the best family.
Page pairs_page(const FittedSample& sample, const std::string& title) {
  const Index columns = std::min(sample.u.cols(), kMostColumns);
  const std::vector<Index> rows = spread(sample.u.rows(), kMostPoints);
  const Points scores = normal_scores(sample.u(rows, Eigen::all));
  const double limit = std::max(2.0, std::ceil(2 * scores.abs().maxCoeff()) / 2);
  Page page{.title = title + count_text(scores.rows(), sample.u.rows(), "shown"), .columns = static_cast<int>(columns)};
  page.title += "; contours: " + sample.fits.front().label();
  if (columns < sample.u.cols()) page.title += "; the first " + std::to_string(columns) + " columns";
  page.panel_width = std::max(220.0, 340.0 - 30 * static_cast<double>(columns - 2));
  page.panel_height = page.panel_width - 20;
  const auto axis = [&](Index column) {
    return Axis{.label = sample.name(column) + ", normal score", .low = -limit, .high = limit};
  };
  for (Index i = 0; i < columns; ++i) {
    for (Index j = 0; j < columns; ++j) {
      if (i == j) {
        page.panels.emplace_back(histogram(sample.name(i), sample.data.x.col(i)));
      } else if (i > j) {
        page.panels.emplace_back(scatter(sample, scores, j, i, axis(j), axis(i)));
      } else {
        page.panels.emplace_back(density(sample, j, i, limit, axis(j), axis(i)));
      }
    }
  }
  return page;
}

Line curve(std::string label, const ColumnRef& x, const ColumnRef& y, const plot::Colour& colour) {
  return {.label = std::move(label), .x = {x.begin(), x.end()}, .y = {y.begin(), y.end()}, .colour = colour};
}

LinePlot kendall_plot(const Column& ordered, int dim) {
  LinePlot plot{.title = "Kendall plot",
                .x = {.label = "expected when independent, W_{i:n}", .low = 0, .high = 1},
                .y = {.label = "joint rank H_{(i)}", .low = 0, .high = 1}};
  const Column t = Column::LinSpaced(201, 0, 1);
  Line diagonal = curve("independent", t, t, kGrey);
  diagonal.dashed = true;
  plot.lines.push_back(std::move(diagonal));
  const CopulaPtr independence = families::find("independence").make(dim, {});
  plot.lines.push_back(curve("comonotone", t, kendall_distribution(*independence, t), kGrey));
  Line points{.label = "data", .colour = kInk, .width = 0, .marker = Marker::dot};
  for (const Index i : shown_of_ordered(ordered.size())) {
    points.x.push_back(expected_joint_rank(i + 1, ordered.size(), dim));
    points.y.push_back(ordered[i]);
  }
  plot.lines.push_back(std::move(points));
  return plot;
}

/// t - K_n(t) with its jumps.
Line empirical_lambda(const Column& ordered) {
  const auto n = static_cast<double>(ordered.size());
  Line line{.label = "data", .x = {0}, .y = {0}, .colour = kInk, .width = 2.2};
  for (const Index i : spread(ordered.size(), kMostPoints)) {
    const double t = ordered[i];
    const auto [first, last] = std::equal_range(ordered.begin(), ordered.end(), t);
    for (const auto end : {first, last}) {
      line.x.push_back(t);
      line.y.push_back(t - static_cast<double>(end - ordered.begin()) / n);
    }
  }
  line.x.push_back(1);
  line.y.push_back(0);
  return line;
}

LinePlot lambda_plot(const Column& ordered, const FittedSample& sample) {
  LinePlot plot{.title = "Lambda function", .x = {.label = "t", .low = 0, .high = 1}, .y = {.label = "t \u2212 K(t)"}};
  plot.lines.push_back(empirical_lambda(ordered));
  const Column t = Column::LinSpaced(401, 0, 1);
  for (std::size_t k = 0; k < sample.fits.size(); ++k) {
    const Column lambda = t - kendall_distribution(*sample.fits[k].copula, t);
    plot.lines.push_back(curve(sample.fits[k].label(), t, lambda, plot::series_colour(k)));
    plot.lines.back().dashed = k % 14 >= 7;  // colours repeat after seven
  }
  return plot;
}

Page kendall_page(const FittedSample& sample, const std::string& title) {
  const bool many = sample.u.cols() > 2 && sample.u.rows() > kMostCompared;
  Column ordered = joint_ranks(many ? Points(sample.u(spread(sample.u.rows(), kMostCompared), Eigen::all)) : sample.u);
  std::sort(ordered.begin(), ordered.end());
  return {.title = title + count_text(ordered.size(), sample.u.rows(), "compared"),
          .columns = 2,
          .panels = {kendall_plot(ordered, static_cast<int>(sample.u.cols())), lambda_plot(ordered, sample)},
          .panel_width = 440,
          .panel_height = 400};
}

LinePlot quantile_plot(const FittedSample& sample, const Fitted& fitted, std::size_t index) {
  const int dim = fitted.copula->dim();
  Column ordered = squared_normal_scores(*fitted.copula, sample.u);
  std::sort(ordered.begin(), ordered.end());
  const auto n = static_cast<double>(ordered.size());
  Line points{.colour = plot::series_colour(index), .width = 0, .marker = Marker::dot};
  for (const Index i : shown_of_ordered(ordered.size())) {
    points.x.push_back(chi_square_quantile((static_cast<double>(i) + 0.5) / n, dim));
    points.y.push_back(ordered[i]);
  }
  const Axis both = plot::fitted({}, {0, points.x.front(), points.y.front()});
  LinePlot plot{.title = fitted.label(), .x = both, .y = both};
  plot.x.label = "chi-square quantile, " + std::to_string(dim) + " degrees of freedom";
  plot.y.label = "squared normal scores";
  plot.lines.push_back({.x = {0, both.high}, .y = {0, both.high}, .colour = kGrey, .dashed = true});
  plot.lines.push_back(std::move(points));
  return plot;
}

/// Values of a column against the quantiles of its margin.
LinePlot margin_plot(const std::string& name, const Column& values, const MarginFit& margin) {
  Column ordered = values;
  std::sort(ordered.begin(), ordered.end());
  Line points{.colour = kPoints, .width = 0, .marker = Marker::dot};
  const auto distribution = share(margin.margin);
  for (const Index i : shown_of_ordered(ordered.size())) {
    points.x.push_back(distribution->quantile((static_cast<double>(i) + 0.5) / static_cast<double>(ordered.size())));
    points.y.push_back(ordered[i]);
  }
  const double low = std::min(points.x.back(), points.y.back()), high = std::max(points.x.front(), points.y.front());
  const auto scale = low > 0 && is_skewed(ordered) ? plot::Scale::logarithmic : plot::Scale::linear;
  const Axis both = plot::fitted({.scale = scale}, {low, high});
  LinePlot plot{.title = name, .x = both, .y = both};
  plot.x.label = "quantile of the fitted " + std::string(to_text(margin.spec.kind)) + " margin";
  plot.y.label = name;
  plot.lines.push_back({.x = {both.low, both.high}, .y = {both.low, both.high}, .colour = kGrey, .dashed = true});
  plot.lines.push_back(std::move(points));
  return plot;
}

/// Margins that have a density, then the families.
Page quantile_page(const FittedSample& sample, const std::string& title) {
  Page page{.title = title + ": Rosenblatt transforms of the fits", .panel_height = 330};
  for (std::size_t k = 0; k < sample.margins.size(); ++k) {
    if (sample.margins[k].spec.kind == MarginKind::empirical) continue;
    page.title = title + ": margins, and Rosenblatt transforms of the fits";
    const auto column = static_cast<Index>(k);
    page.panels.emplace_back(margin_plot(sample.name(column), sample.data.x.col(column), sample.margins[k]));
  }
  for (std::size_t k = 0; k < sample.fits.size(); ++k) {
    page.panels.emplace_back(quantile_plot(sample, sample.fits[k], k));
  }
  return page;
}

FittedSample fit_sample(const Options& options) {
  FittedSample sample{.data = read_sample(options.data), .margins = {}, .u = {}, .fits = {}};
  const std::vector<const FamilyInfo*> chosen = parse_families(options.families);
  const std::vector<MarginSpec> specs = margins_for(options.margins, sample.data);
  if (!specs.empty()) sample.margins = fit_margins(specs, sample.data.x);
  sample.u = specs.empty() ? sample.data.x : uniforms_of(sample.margins, sample.data.x);
  for (FitResult& result : fit_all(chosen, FitMethod::maximum_likelihood, sample.u)) {
    if (result.status == FitStatus::failed) {
      std::cerr << "sklar: " << result.family << " is left out: " << result.message << '\n';
      continue;
    }
    const auto family =
        std::find_if(chosen.begin(), chosen.end(), [&](const auto* f) { return f->name == result.family; });
    CopulaPtr copula = (*family)->make(static_cast<int>(sample.u.cols()), result.theta);
    sample.fits.push_back({*family, std::move(result), std::move(copula)});
  }
  if (sample.fits.empty()) throw std::runtime_error(options.data.path + ": no family could be fitted");
  return sample;
}

void run(const Options& options, bool json) {
  const FittedSample sample = fit_sample(options);
  const std::string title =
      std::filesystem::path(options.data.path).filename().string() + ", " + std::to_string(sample.u.rows()) + " rows";
  make_folder(options.folder);
  nlohmann::ordered_json document{{"best", sample.fits.front().family->name}};
  const auto write = [&](const char* name, const Page& page) {
    const std::filesystem::path path = options.folder / (name + ("." + options.format));
    plot::write_page(path, page);
    document["files"].push_back(path.string());
    if (!json) std::cout << path.string() << '\n';
  };
  write("pairs", pairs_page(sample, title));
  write("kendall", kendall_page(sample, title));
  write("quantiles", quantile_page(sample, title));
  if (json) print_json(document);
}

}  // namespace

void add_copula_plot(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand(
      "plot",
      "draw data with families fitted to them: pairs with contours, Kendall plot and lambda function, quantiles");
  const auto options = std::make_shared<Options>();
  add_data_options(*command, options->data);
  command->add_option("--families", options->families, kFamiliesHelp)->capture_default_str();
  command->add_option("--margins", options->margins, kMarginsHelp)
      ->check(CLI::Validator([](const std::string& text) { return check_margins(text); }, ""))
      ->capture_default_str();
  command->add_option("--out", options->folder, "the folder, made where it is missing")->capture_default_str();
  command->add_option("--format", options->format, "of the files pairs, kendall and quantiles")
      ->check(CLI::IsMember({"png", "svg"}))
      ->capture_default_str();
  finish_command(*command, common, [options, &common] { run(*options, common.json); });
}

}  // namespace sklar::cli
