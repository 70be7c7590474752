#pragma once
/// Argument checks of the public calls. Each failure names function, argument, index, value and what is allowed.

#include <stdexcept>
#include <string>
#include <string_view>

#include "copula/types.hpp"

namespace sklar {

/// A file that cannot be read, understood or written; the message opens with the path.
class FileError : public std::runtime_error {
 public:
  FileError(std::string_view path, std::string_view what);
};

/// The shortest decimal text that reads back as the same double; -inf, inf and nan spelt so.
[[nodiscard]] std::string to_text(double value);

/// @throws std::invalid_argument unless columns is in [lowest, highest].
void require_columns(std::string_view function, std::string_view argument, Index columns, Index lowest, Index highest);

/// @throws std::invalid_argument unless the two row counts agree.
void require_rows(std::string_view function, std::string_view argument, Index rows, Index expected);

/// NaN passes: a NaN row gives a NaN answer.
/// @throws std::domain_error naming the first entry outside [0,1].
void require_unit_cube(std::string_view function, std::string_view argument, const PointsRef& u);

}  // namespace sklar
