#pragma once
/// The types of every public call. Shapes: rows are observations, columns are coordinates (docs/conventions.md).

#include <Eigen/Core>
#include <vector>

namespace sklar {

using Points = Eigen::ArrayXXd;                       ///< n x d, column-major
using PointsRef = Eigen::Ref<const Eigen::ArrayXXd>;  ///< read-only view of n x d points; pass as const PointsRef&
using PointsOut = Eigen::Ref<Eigen::ArrayXXd>;        ///< caller-owned n x d output
using Column = Eigen::ArrayXd;                        ///< one number an observation
using ColumnRef = Eigen::Ref<const Eigen::ArrayXd>;   ///< read-only view of a column
using ColumnOut = Eigen::Ref<Eigen::ArrayXd>;         ///< caller-owned output
using Theta = std::vector<double>;  ///< parameters of a family, in the order of FamilyInfo::parameters
/// Of rows and columns.
using Index = Eigen::Index;

}  // namespace sklar
