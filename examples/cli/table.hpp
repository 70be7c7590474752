#pragma once
/// The input of `sklar copula table`: rows family,theta,quantity,d,u[,expected], grouped into batches.

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "copula/family.hpp"
#include "examples/cli/pass_rule.hpp"
#include "examples/cli/quantity.hpp"

namespace sklar::cli {

enum Field { kFamily, kTheta, kQuantity, kDim, kU, kExpected };

struct Row {
  std::size_t line;  ///< in the file; the header is line 1
  std::vector<std::string> fields;
  std::vector<double> arguments{};     ///< u, or t
  std::optional<Expected> expected{};  ///< where the row gives one

  double value = 0;
  std::string digits{};   ///< the value, where more digits than those of a double were asked for
  std::string failure{};  ///< why there is no value
  Verdict verdict{};
  bool best_double = false;  ///< passes as the double nearest the inverse
};

/// Rows of equal family, parameters, dimension and quantity: one call.
struct Group {
  const FamilyInfo* family;
  Theta theta;
  int dim;
  Quantity quantity;
  std::vector<Row*> rows;
};

struct Table {
  std::vector<std::string> header;
  std::deque<Row> rows;                              ///< in the order of the file; groups point to them
  std::map<std::vector<std::string>, Group> groups;  ///< by the fields before u
};

/// @throws FileError naming the line: a field that cannot be read, a wrong number of fields, of u or of parameters, an
/// unknown family or quantity. Whether theta and u are admissible is not asked here.
[[nodiscard]] Table read_table(const std::string& path);

}  // namespace sklar::cli
