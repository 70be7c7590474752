#pragma once
/// Families compared on one material: fitted, measured and drawn by the same code.

#include <functional>
#include <limits>
#include <variant>

#include "brdf/model/paper_fit.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/study/figures.hpp"

namespace sklar::brdf {

/// One model on one material. Figures are NaN where error says why there is no model.
struct CompareRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string material = {};
  Provenance provenance = Provenance::unknown;
  std::string model = "copula";
  std::string family = {};
  std::string mode = "paper";
  std::size_t bytes = 0;     ///< Brdf::bytes
  double fit_s = kNone;      ///< wall clock, all threads
  double eval_ns = kNone;    ///< RGB, in a batch, one thread; see evaluation_ns
  double log1p_mae = kNone;  ///< this and the next three: CellErrors, mean over channels
  double logrel_mae = kNone;
  double cuberoot_rms = kNone;
  double rel_l2 = kNone;
  double sphere_psnr_linear_db = kNone;          ///< mean over channels
  double albedo_max = kNone;                     ///< of albedo_angles() and the channels
  std::array<std::vector<Theta>, 3> theta = {};  ///< a channel, a slice; empty in black slices and where refined
  std::string error = {};
};

/// How a family is fitted: in the paper's mode, or refined with that family in every component.
using FamilyFitOptions = std::variant<PaperFitOptions, RefinedFitOptions>;

/// The families on one material.
struct Comparison {
  std::vector<CompareRow> rows;                ///< mode after mode, in the order of the families
  std::vector<std::filesystem::path> figures;  ///< as write_figures names them
  Image reference;                             ///< the sphere of the table
  std::vector<Image> spheres;                  ///< those of the rows; empty where there is no model
  std::string reference_curves;                ///< curves_json of the table
  std::vector<std::string> curves;             ///< and of the rows; empty where there is no model
};

/// Writes FOLDER/spheres_MODE_FAMILY.png for every row, a column for each material that has the model (the paper's
/// Fig. 3). @return the paths. @throws FileError for a folder that cannot be written.
std::vector<std::filesystem::path> write_sphere_sheets(std::span<const Comparison> materials,
                                                       const std::filesystem::path& folder);

/// Fits every family in every mode, measures it against the table and writes the figures FOLDER/MATERIAL_*.png.
/// @param progress called with what is being done, for a person to read.
/// @throws FileError for a folder that cannot be written; what fit_paper and fit_refined throw for a bad table.
[[nodiscard]] Comparison compare_families(std::shared_ptr<const MeasuredTable> table,
                                          std::span<const FamilyInfo* const> families,
                                          std::span<const FamilyFitOptions> modes, const std::filesystem::path& folder,
                                          const std::function<void(const std::string&)>& progress = {});

}  // namespace sklar::brdf
