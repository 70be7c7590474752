#include "copula/plot/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "brdf/render/image.hpp"
#include "copula/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::plot {
namespace {

using brdf::read_png;

std::vector<std::string> texts(const Axis& axis) {
  std::vector<std::string> all;
  for (const Tick& tick : axis_ticks(axis)) all.push_back(tick.text);
  return all;
}

using Texts = std::vector<std::string>;

TEST(PlotAxis, TicksAreRoundNumbers) {
  EXPECT_EQ(texts({.low = 0, .high = 0.3}), (Texts{"0", "0.05", "0.1", "0.15", "0.2", "0.25", "0.3"}));
  EXPECT_EQ(texts({.low = -3, .high = 7}), (Texts{"−2", "0", "2", "4", "6"}));
  EXPECT_EQ(texts({.low = 0, .high = 90, .ticks = {0, 45, 90, 100}}), (Texts{"0", "45", "90"}));
  EXPECT_EQ(texts({.scale = Scale::logarithmic, .low = 0.02, .high = 10}), (Texts{"10^{−1}", "10^{0}", "10^{1}"}));
  EXPECT_EQ(texts({.scale = Scale::digits, .low = 1e-16, .high = 1e-4}),
            (Texts{"10^{−5}", "10^{−7}", "10^{−10}", "10^{−15}"}));
}

TEST(PlotAxis, TicksWithAnExponentHaveOneUnit) {
  const Axis losses{.label = "loss", .low = -5e5, .high = 2.5e6};
  EXPECT_EQ(texts(losses), (Texts{"−0.5", "0", "0.5", "1", "1.5", "2", "2.5"}));
  EXPECT_EQ(axis_label(losses), "loss (in 10^{6})");
  EXPECT_DOUBLE_EQ(axis_ticks(losses)[2].position, 1 / 3.0);
  const Axis small{.low = -4e-5, .high = 6e-5};
  EXPECT_EQ(texts(small), (Texts{"−40", "−20", "0", "20", "40", "60"}));
  EXPECT_EQ(axis_label(small), "in 10^{−6}");
  EXPECT_EQ(texts({.low = 0, .high = 0.002}), (Texts{"0", "0.5", "1", "1.5", "2"}));
  const Axis plain{.label = "d", .low = 2001494, .high = 2001506};
  EXPECT_EQ(texts(plain).front(), "2001494");
  EXPECT_EQ(axis_label(plain), "d");
  EXPECT_EQ(axis_label({.label = "t", .scale = Scale::logarithmic, .low = 1e-9, .high = 1e9}), "t");
}

TEST(PlotAxis, FewerPartsAreRoundNumbersToo) {
  const auto parts = [](const Axis& axis, int most) {
    Texts all;
    for (const Tick& tick : axis_ticks(axis, most)) all.push_back(tick.text);
    return all;
  };
  EXPECT_EQ(parts({.low = 2001494, .high = 2001506}, 3), (Texts{"2001495", "2001500", "2001505"}));
  EXPECT_EQ(parts({.low = -5e5, .high = 2.5e6}, 2), (Texts{"0", "2"})) << "in the unit of the label";
  EXPECT_EQ(parts({.scale = Scale::logarithmic, .low = 1, .high = 1e6}, 2), (Texts{"10^{0}", "10^{3}", "10^{6}"}));
}

TEST(PlotAxis, PositionsFollowTheScale) {
  EXPECT_DOUBLE_EQ(axis_position({.low = 2, .high = 4}, 3), 0.5);
  EXPECT_DOUBLE_EQ(axis_position({.scale = Scale::logarithmic, .low = 0.01, .high = 100}, 1), 0.5);
  EXPECT_DOUBLE_EQ(axis_position({.scale = Scale::square_root, .low = 0, .high = 4}, 1), 0.5);
  EXPECT_DOUBLE_EQ(axis_position({.scale = Scale::digits, .low = 1e-16, .high = 1e-1}, 1e-4), 0.5);
  EXPECT_TRUE(std::isnan(axis_position({.scale = Scale::digits, .low = 1e-16, .high = 1e-1}, 1)));
  EXPECT_TRUE(std::isnan(axis_position({.scale = Scale::logarithmic, .low = 0.01, .high = 100}, 0)));
}

TEST(PlotAxis, RangeComesFromWhatCanBeShown) {
  const double inf = std::numeric_limits<double>::infinity();
  const Axis logarithmic = fitted({.scale = Scale::logarithmic}, {0, 0.5, -1, 20, inf, std::nan("")});
  EXPECT_EQ(logarithmic.low, 0.5);
  EXPECT_EQ(logarithmic.high, 20);
  const Axis linear = fitted({}, {0.13, 0.87});
  EXPECT_NEAR(linear.low, 0, 1e-12);
  EXPECT_NEAR(linear.high, 1, 1e-12);
  for (const Scale scale : {Scale::linear, Scale::logarithmic, Scale::square_root}) {
    for (const std::vector<double>& values : {std::vector<double>{}, std::vector<double>{3, 3}}) {
      const Axis axis = fitted({.scale = scale}, values);
      EXPECT_LT(axis.low, axis.high);
      EXPECT_TRUE(std::isfinite(axis_position(axis, 3)));
    }
  }
}

TEST(Palette, ViridisEndsAreItsPublishedColours) {
  EXPECT_DOUBLE_EQ(viridis(0).red, 68 / 255.0);
  EXPECT_DOUBLE_EQ(viridis(1).green, 231 / 255.0);
  EXPECT_DOUBLE_EQ(viridis(2).green, 231 / 255.0);
  EXPECT_DOUBLE_EQ(viridis(std::nan("")).red, 68 / 255.0);
}

using PlotFile = test::TemporaryFolder;

Page diagonal_page() {
  LinePlot plot{.title = "plot", .x = {.low = 0, .high = 1}, .y = {.low = 0, .high = 1}};
  plot.lines.push_back({.label = "a_name", .x = {0, 1}, .y = {0, 1}, .colour = {1, 0, 0}});
  HeatMap map{.title = "map", .x_edges = {0, 1, 2}, .y_edges = {0, 1, 2}};
  map.values.resize(2, 2);
  map.values << 0, 1, std::nan(""), 3;
  return {.title = "page", .panels = {plot, map}};
}

struct Count {
  int white = 0, red = 0, other = 0;
};

Count count(const Bytes& bytes) {
  Count all;
  for (std::size_t n = 0; n < bytes.rgb.size(); n += 3) {
    const int red = bytes.rgb[n];
    const int green = bytes.rgb[n + 1];
    const int blue = bytes.rgb[n + 2];
    if (red == 255 && green == 255 && blue == 255) {
      ++all.white;
    } else if (red > 240 && green < 20 && blue < 20) {
      ++all.red;
    } else {
      ++all.other;
    }
  }
  return all;
}

TEST_F(PlotFile, PageIsAPictureWithItsLine) {
  write_page(folder_ / "page.png", diagonal_page());
  const Bytes bytes = read_png(folder_ / "page.png");
  EXPECT_GT(bytes.width, 1300);
  const Count colours = count(bytes);
  EXPECT_GT(colours.white, bytes.width * bytes.height / 3) << "background";
  EXPECT_GT(colours.red, 500) << "the line crosses the panel";
  EXPECT_GT(colours.other, bytes.width * bytes.height / 20) << "the map, axes and text";
}

TEST_F(PlotFile, MarkersStandAtThePointsAndInTheLegend) {
  const auto reds = [&](Marker marker, double y) {
    Page page = diagonal_page();
    auto& plot = std::get<LinePlot>(page.panels[0]);
    plot.lines = {{.label = "a", .x = {0.5}, .y = {y}, .colour = {1, 0, 0}, .width = 0, .marker = marker}};
    write_page(folder_ / "page.png", page);
    return count(read_png(folder_ / "page.png")).red;
  };
  EXPECT_EQ(reds(Marker::none, 0.5), 0);
  EXPECT_NEAR(reds(Marker::dot, 0.5), 2 * reds(Marker::dot, 2), 4);
  for (const Marker marker : {Marker::circle, Marker::square, Marker::triangle, Marker::diamond}) {
    const int of_the_legend = reds(marker, 2);  // the point is outside the axis
    EXPECT_GT(of_the_legend, 100);
    EXPECT_NEAR(reds(marker, 0.5), 2 * of_the_legend, 20);
  }
}

/// The widths in pixels of the dark pieces of a row of pixels `below` the lower side of a panel's frame, joined across
/// gaps of less than half a letter.
std::vector<int> pieces_below_the_frame(const Bytes& bytes, int below, int above) {
  constexpr int kGap = 7;
  const auto dark = [&](int x, int y) { return bytes.rgb[static_cast<std::size_t>(3 * (y * bytes.width + x))] < 128; };
  int frame = bytes.height - 1;
  const auto is_frame = [&](int y) {
    int all = 0;
    for (int x = 0; x < bytes.width; ++x) all += dark(x, y);
    return all > bytes.width / 2;
  };
  while (frame > 0 && !is_frame(frame)) --frame;
  std::vector<int> pieces;
  int last = -kGap - 1, first = 0;
  for (int x = 0; x < bytes.width; ++x) {
    bool any = false;
    for (int y = frame + below; y < frame + above; ++y) any = any || dark(x, y);
    if (!any) continue;
    if (x - last > kGap) {
      pieces.push_back(0);
      first = x;
    }
    last = x;
    pieces.back() = x - first + 1;
  }
  return pieces;
}

TEST_F(PlotFile, TickLabelsStandApart) {
  LinePlot plot{.x = {.low = 2001494, .high = 2001506}, .y = {.low = 0, .high = 1}};
  plot.lines.push_back({.x = {2001494, 2001506}, .y = {0, 1}});
  write_page(folder_ / "page.png", {.panels = {plot}});
  const std::vector<int> labels = pieces_below_the_frame(read_png(folder_ / "page.png"), 16, 34);
  ASSERT_EQ(labels.size(), 3u) << "2001495, 2001500, 2001505";
  constexpr int kSevenDigits = 2 * 7 * 8;
  for (const int width : labels) EXPECT_LT(width, kSevenDigits);
}

TEST_F(PlotFile, LongLabelsStayInTheirPanel) {
  Page page = diagonal_page();
  page.panels.pop_back();
  auto& plot = std::get<LinePlot>(page.panels[0]);
  plot.x.label = plot.y.label = plot.title = std::string(90, 'm');
  write_page(folder_ / "page.png", page);
  const Bytes bytes = read_png(folder_ / "page.png");
  const auto white = [&](int x, int y) {
    return bytes.rgb[static_cast<std::size_t>(3 * (y * bytes.width + x))] == 255;
  };
  for (int y = 0; y < bytes.height; ++y) EXPECT_TRUE(white(0, y) && white(bytes.width - 1, y)) << "row " << y;
  for (int x = 0; x < bytes.width; ++x) EXPECT_TRUE(white(x, 0) && white(x, bytes.height - 1)) << "column " << x;
}

TEST_F(PlotFile, FilledLinesReachTheAxis) {
  Page page = diagonal_page();
  auto& line = std::get<LinePlot>(page.panels[0]).lines[0];
  line.width = 0;
  line.filled = true;
  line.colour = {0, 0, 0};
  write_page(folder_ / "page.png", page);
  const Bytes bytes = read_png(folder_ / "page.png");
  int pale = 0;  // 40 % black
  for (std::size_t n = 0; n < bytes.rgb.size(); n += 3) pale += bytes.rgb[n] == 153 && bytes.rgb[n + 1] == 153;
  EXPECT_GT(pale, 2 * 340 * 2 * 270 / 4) << "the triangle below the diagonal is about half of the panel";
}

TEST_F(PlotFile, LegendsBreakIntoLines) {
  Page page = diagonal_page();
  auto& plot = std::get<LinePlot>(page.panels[0]);
  write_page(folder_ / "short.png", page);
  for (const char* name : {"b", "c", "d", "e", "f"}) {
    plot.lines.push_back({.label = std::string(30, name[0]), .x = {0, 1}, .y = {0, 1}});
  }
  write_page(folder_ / "long.png", page);
  EXPECT_EQ(read_png(folder_ / "short.png").width, read_png(folder_ / "long.png").width);
  EXPECT_GT(read_png(folder_ / "long.png").height, read_png(folder_ / "short.png").height + 20);
}

/// The ends of the pieces of a contour.
std::vector<std::pair<double, double>> ends(const Line& line) {
  std::vector<std::pair<double, double>> all;
  for (std::size_t n = 0; n < line.x.size(); ++n) {
    EXPECT_EQ(std::isnan(line.x[n]), n % 3 == 2);
    if (n % 3 != 2) all.emplace_back(line.x[n], line.y[n]);
  }
  return all;
}

TEST(Contour, OfAPlaneIsStraight) {
  const std::vector<double> x{0, 1, 3}, y{0, 2};
  Eigen::ArrayXXd plane(2, 3);
  plane << 0, 1, 3, 2, 3, 5;  // x + y
  const auto points = ends(contour(x, y, plane, 2.5));
  ASSERT_EQ(points.size(), 4u);
  for (const auto& [across, up] : points) EXPECT_DOUBLE_EQ(across + up, 2.5);
  EXPECT_TRUE(contour(x, y, plane, 7).x.empty());
}

TEST(Contour, OfACircleHasItsRadius) {
  std::vector<double> z;
  for (int n = -20; n <= 20; ++n) z.push_back(n / 10.0);
  const Eigen::Map<const Eigen::ArrayXd> axis(z.data(), 41);
  const Eigen::ArrayXXd squares = axis.square().replicate(1, 41) + axis.square().transpose().replicate(41, 1);
  const auto points = ends(contour(z, z, squares, 2));
  EXPECT_GT(points.size(), 80u);
  constexpr double kChord = 0.01;  // a cell of side h: h^2 / 8
  for (const auto& [across, up] : points) EXPECT_NEAR(across * across + up * up, 2, kChord);
}

TEST(Contour, OfASaddleGoesAroundTheFarCorners) {
  Eigen::ArrayXXd saddle(2, 2);
  saddle << 1, 0, 0, 0.9;
  for (const double level : {0.4, 0.6}) {  // 0.475 in the middle
    const auto points = ends(contour({0, 1}, {0, 1}, saddle, level));
    ASSERT_EQ(points.size(), 4u);
    for (std::size_t n = 0; n < 4; n += 2) {
      const bool right = points[n].first + points[n + 1].first > 1;
      const bool above = points[n].second + points[n + 1].second > 1;
      EXPECT_EQ(right == above, level == 0.6) << "around a high corner";
    }
  }
}

TEST(Contour, LeavesOutCellsWithoutAValue) {
  Eigen::ArrayXXd values(2, 3);
  values << 0, 1, std::nan(""), 1, 0, 0;
  EXPECT_EQ(ends(contour({0, 1, 2}, {0, 1}, values, 0.5)).size(), 4u) << "the first cell alone";
  EXPECT_THROW((void)contour({0, 1}, {0, 1}, values, 0.5), std::invalid_argument);
}

TEST_F(PlotFile, PageAsSvg) {
  write_page(folder_ / "page.svg", diagonal_page());
  std::ifstream in(folder_ / "page.svg");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find("<svg"), std::string::npos);
  EXPECT_NE(text.find("</svg>"), std::string::npos);
}

TEST_F(PlotFile, SameInputSameBytes) {
  write_page(folder_ / "a.png", diagonal_page());
  write_page(folder_ / "b.png", diagonal_page());
  EXPECT_EQ(read_png(folder_ / "a.png").rgb, read_png(folder_ / "b.png").rgb);
}

TEST_F(PlotFile, GridKeepsEveryPixel) {
  Bytes red{20, 10, {}};
  for (int n = 0; n < 200; ++n) red.rgb.insert(red.rgb.end(), {255, 0, 0});
  ImageGrid grid;
  grid.title = "t";
  grid.column_labels = {"a", "b"};
  grid.row_labels = {"r", "s"};
  grid.rows = {{{red, ""}, {red, ""}}, {{red, "caption"}, {red, ""}}};
  grid.colour_bar = Axis{.label = "bar", .low = 0, .high = 1};
  write_grid(folder_ / "grid.png", grid);
  EXPECT_EQ(count(read_png(folder_ / "grid.png")).red, 4 * 200);
}

TEST_F(PlotFile, BadArgumentsAreRefused) {
  Page page = diagonal_page();
  EXPECT_THROW(write_page(folder_ / "page.jpg", page), std::invalid_argument);
  EXPECT_THROW(write_page(folder_ / "nowhere" / "page.png", page), FileError);
  std::get<LinePlot>(page.panels[0]).lines[0].y.pop_back();
  EXPECT_THROW(write_page(folder_ / "page.png", page), std::invalid_argument);
  page.panels.erase(page.panels.begin());
  std::get<HeatMap>(page.panels[0]).x_edges.pop_back();
  EXPECT_THROW(write_page(folder_ / "page.png", page), std::invalid_argument);
  EXPECT_THROW(write_page(folder_ / "page.png", Page{}), std::invalid_argument);
  EXPECT_THROW(write_grid(folder_ / "grid.png", ImageGrid{}), std::invalid_argument);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace sklar::plot
