#pragma once
/// The accuracy of every Archimedean copula.

namespace sklar {

/// Bounds enforced on the value returned, and tested.
inline constexpr double kLogTolerance = 9.5e-14;    ///< log densities, log cdf: absolute below 1, relative above
inline constexpr double kHTolerance = 9.5e-14;      ///< relative, for h and 1 - h
inline constexpr double kInverseTolerance = 4e-13;  ///< relative, for h^-1 and 1 - h^-1

inline constexpr double kFastTolerance = 1e-5;  ///< of Accuracy::fast: logs as kLogTolerance, else relative

}  // namespace sklar
