#include "brdf/study/figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "copula/plot/axis.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {

TEST(CellShares, MarginsByHand) {
  std::vector<double> plane(Grid::cells, 0.0);
  plane[static_cast<std::size_t>(Grid::index(3, 7, 11))] = 6;
  plane[static_cast<std::size_t>(Grid::index(3, 8, 11))] = 1;
  plane[static_cast<std::size_t>(Grid::index(5, 7, 170))] = 1;
  const CellShares shares = cell_shares(plane);
  EXPECT_EQ(shares.joint(3, 7), 0.75);
  EXPECT_EQ(shares.joint(5, 7), 0.125);
  EXPECT_EQ(shares.theta_h(3), 0.875);
  EXPECT_EQ(shares.theta_d(7), 0.875);
  EXPECT_EQ(shares.phi_d(170), 0.125);
  EXPECT_EQ(shares.phi_d.sum(), 1);
  EXPECT_EQ(cell_shares(std::vector<double>(Grid::cells, 0.0)).theta_h.maxCoeff(), 0);
  EXPECT_THROW((void)cell_shares({1, 2}), std::invalid_argument);
}

TEST(DisplayExposure, PutsTheBrightPixelsAt80Percent) {
  Image image(10, 10);  // a black background and forty pixels, the 95 % place at the 38th
  for (int n = 0; n < 40; ++n) image.at(5 + n / 10, n % 10, 1) = static_cast<float>(n < 38 ? 0.25 : 100);
  EXPECT_DOUBLE_EQ(display_exposure(image), 0.8 / 0.25);
  EXPECT_EQ(display_exposure(Image(4, 4)), 1);
}

TEST(FalseColour, MeanDifferenceOfDisplayedValues) {
  Image reference(2, 1);
  Image model(2, 1);
  model.rgb = {0, 0, 0, 0.3F, 0, 0};
  const Bytes bytes = false_colour_difference(reference, model, 2.0, 0.5);
  const plot::Colour none = plot::viridis(0);
  const plot::Colour some = plot::viridis(0.5 * srgb_encode(2 * 0.3F) / 3);
  EXPECT_EQ(bytes.rgb[0], std::lround(255 * none.red));
  EXPECT_EQ(bytes.rgb[3], std::lround(255 * some.red));
  EXPECT_EQ(bytes.rgb[4], std::lround(255 * some.green));
  EXPECT_THROW((void)false_colour_difference(reference, Image(1, 1), 1, 1), std::invalid_argument);
}

using FigureFile = test::TemporaryFolder;

TEST_F(FigureFile, FourPicturesOfAMaterial) {
  const auto reference = std::make_shared<MeasuredTable>();
  const auto material = Lambert({0.2, 0.4, 0.6});
  reference->name = "flat";
  reference->provenance = Provenance::synthetic;
  reference->valid.assign(Grid::cells, 1);
  for (auto& plane : reference->values) plane.assign(Grid::cells, 0.0);
  reference->values = predict(material, *reference);
  SphereOptions options;
  options.size = 64;
  const View truth = view(reference, options);
  EXPECT_EQ(truth.name, "synthetic");
  const std::vector<View> models{view("same", material, *reference, options),
                                 view("glossy", Ggx(Rgb::Ones(), 0.2), *reference, options)};
  EXPECT_EQ(models[0].cells, truth.cells);
  const auto paths = write_figures(folder_, "flat", "flat (synthetic)", truth, models);
  ASSERT_EQ(paths.size(), 4u);
  for (const auto& path : paths) {
    const Bytes bytes = read_png(path);
    EXPECT_GT(bytes.width, 150) << path;
    EXPECT_GT(std::count(bytes.rgb.begin(), bytes.rgb.end(), 255), 3000) << path << ": background";
    EXPECT_GT(std::count_if(bytes.rgb.begin(), bytes.rgb.end(), [](int value) { return value < 100; }), 3000) << path;
  }
}

}  // namespace
}  // namespace sklar::brdf
