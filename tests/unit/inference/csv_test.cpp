#include "copula/inference/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar {
namespace {

std::string failure(std::string_view text, const CsvOptions& options = {}) {
  try {
    (void)parse_csv(text, "data.csv", options);
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Csv, ReadsNamesAndNumbers) {
  const Table table = parse_csv("\xEF\xBB\xBFx , y\r\n 1,-2.5e-3 \r\ninf,nan\r\n\r\n", "data.csv");
  EXPECT_EQ(table.names, (std::vector<std::string>{"x", "y"}));
  ASSERT_EQ(table.values.rows(), 2);
  EXPECT_EQ(table.values(0, 0), 1);
  EXPECT_EQ(table.values(0, 1), -2.5e-3);
  EXPECT_EQ(table.values(1, 0), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(table.values(1, 1)));
}

TEST(Csv, HeaderAloneHasNoRows) {
  const Table table = parse_csv("x,y\n", "data.csv");
  EXPECT_EQ(table.values.rows(), 0);
  EXPECT_EQ(table.values.cols(), 2);
}

TEST(Csv, NamesTheLineAtFault) {
  EXPECT_EQ(failure(""), "data.csv: is empty; expected a header line and rows of numbers");
  EXPECT_EQ(failure(" \n\n"), "data.csv: is empty; expected a header line and rows of numbers");
  EXPECT_EQ(failure("a,pr\xE4mie\n1,2\n"), "data.csv: line 1: column 2: its name is not UTF-8");
  EXPECT_EQ(failure("1,2\n3,4\n"), "data.csv: line 1: expected a header with the names of the columns, found numbers");
  EXPECT_EQ(failure("x,\n3,4\n"), "data.csv: line 1: column 2 has no name");
  EXPECT_EQ(failure("x,y\n1,2\n3\n"), "data.csv: line 3: expected 2 fields, found 1");
  EXPECT_EQ(failure("x,y\n1,2,\n"), "data.csv: line 2: expected 2 fields, found 3");
  EXPECT_EQ(failure("x,y\n\n1,2\n"), "data.csv: line 2: is blank");
  EXPECT_EQ(failure("x,y\n1,2\n1,1.5x\n"), "data.csv: line 3: column y: '1.5x' is not a number");
  EXPECT_EQ(failure("x,y\n1,\n"), "data.csv: line 2: column y: '' is not a number");
  EXPECT_EQ(failure("x\n1e999\n"), "data.csv: line 2: column x: '1e999' is not a number");
}

TEST(Csv, ReadsFieldsInQuotes) {
  const Table table = parse_csv("\"loss, total\" , \"a \"\"b\"\"\",\"two\nlines\"\n\"1\",2 ,\" 3\"\n4,5,6\n",
                                "data.csv", {.columns = {"two\nlines", "a \"b\"", "loss, total"}});
  EXPECT_EQ(table.names, (std::vector<std::string>{"two\nlines", "a \"b\"", "loss, total"}));
  EXPECT_EQ(table.lines, (std::vector<Index>{3, 4}));
  EXPECT_TRUE((table.values.row(1) == Points{{6, 5, 4}}).all());
  EXPECT_EQ(parse_csv(to_csv(table.names, table.values), "data.csv").names, table.names);
  EXPECT_EQ(failure("x,\"y\n1,2\n"), "data.csv: line 1: a quote is not closed");
  EXPECT_EQ(failure("x,y\n1,\"2\"3\n"), "data.csv: line 2: text behind a closing quote");
  EXPECT_EQ(failure("x,\"a\nb\"\n1,z\n"), "data.csv: line 3: column a\nb: 'z' is not a number");
}

TEST(Csv, ChoosesColumnsByName) {
  const Table table = parse_csv(",x,place,y\n1,2,Rome,3\n2,4,NA,5\n", "data.csv", {.columns = {"y", "x"}});
  EXPECT_EQ(table.names, (std::vector<std::string>{"y", "x"}));
  EXPECT_TRUE((table.values == Points{{3, 2}, {5, 4}}).all());
  EXPECT_EQ(failure("x,y\n1,2\n", {.columns = {"z"}}), "data.csv: line 1: no column 'z'; columns: x, y");
  EXPECT_EQ(failure("x,x\n1,2\n", {.columns = {"x"}}), "data.csv: line 1: two columns are named 'x'");
}

TEST(Csv, MissingValuesAreCountedOrTheirRowsDropped) {
  const std::string text = "x,y,z\n1,2,3\n4,,5\n.,NA,\n6,7,8\nNaN,nan,1\n9,10,NA\n";
  EXPECT_EQ(failure(text, {.missing = Missing::refuse}),
            "data.csv: 7 values are missing in 4 of 6 rows, the first in line 3, column y; drop such rows (missing: "
            "drop) or choose other columns");
  EXPECT_EQ(failure("x\n1\nNA\n", {.missing = Missing::refuse}),
            "data.csv: 1 value is missing in 1 of 2 rows, the first in line 3, column x; drop such rows (missing: "
            "drop) or choose other columns");
  const Table table = parse_csv(text, "data.csv", {.missing = Missing::drop});
  EXPECT_TRUE((table.values == Points{{1, 2, 3}, {6, 7, 8}}).all());
  EXPECT_EQ(table.lines, (std::vector<Index>{2, 5}));
  EXPECT_EQ(table.dropped, 4);
  // A value that misses in a column that is not read does not count.
  EXPECT_EQ(parse_csv(text, "data.csv", {.columns = {"x"}, .missing = Missing::drop}).dropped, 2);
}

TEST(Csv, WhatIsNoNumberIsNotMissing) {
  for (const Missing missing : {Missing::refuse, Missing::drop}) {
    EXPECT_EQ(failure("x,y\n1,n/a\n", {.missing = missing}), "data.csv: line 2: column y: 'n/a' is not a number");
  }
  EXPECT_EQ(failure("x,y\n1,NA\n"), "data.csv: line 2: column y: 'NA' is not a number");
}

class CsvFile : public test::TemporaryFolder {};

TEST_F(CsvFile, GivesBackTheSameDoubles) {
  Points values(4, 2);
  values << 0.1, 1.0 / 3, 5e-324, -std::numeric_limits<double>::max(), 1 - 0x1p-53, 1e22,
      -std::numeric_limits<double>::infinity(), -0.0;
  const std::vector<std::string> names = {"a", "b"};
  write_file(folder_ / "x.csv", to_csv(names, values));
  const Table table = read_csv(folder_ / "x.csv");
  EXPECT_EQ(table.names, names);
  EXPECT_TRUE((table.values == values).all());
  EXPECT_TRUE(std::signbit(table.values(3, 1)));
}

TEST_F(CsvFile, MissingFileAndDirectoryAreErrors) {
  EXPECT_THROW((void)read_csv(folder_ / "missing.csv"), FileError);
  EXPECT_THROW((void)read_csv(folder_), FileError);
}

TEST(Csv, WritesSeventeenDigits) {
  const std::vector<std::string> names = {"x"};
  EXPECT_EQ(to_csv(names, Points::Constant(1, 1, 0.1)), "x\n0.10000000000000001\n");
  EXPECT_THROW((void)to_csv(names, Points::Zero(1, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace sklar
