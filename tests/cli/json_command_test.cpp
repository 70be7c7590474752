/// Every --json output has the fields that docs/json.md says, and no others.

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "brdf/study/model_row.hpp"
#include "brdf/study/results.hpp"
#include "copula/file.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

using Json = nlohmann::json;

struct Field {
  std::string type;
  bool optional;
};
using Fields = std::map<std::string, Field>;  ///< by path

/// The table below a heading, by each of the commands that it names.
std::map<std::string, Fields> read_page() {
  std::map<std::string, Fields> page;
  std::istringstream lines(read_file(SKLAR_DOCS "/json.md"));
  std::vector<std::string> commands;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) {
      commands.clear();
      std::istringstream names(line.substr(3));
      for (std::string name; std::getline(names >> std::ws, name, ',');) commands.push_back(name);
    }
    if (!line.starts_with("| `")) continue;
    const std::size_t end = line.find("` | "), type_end = line.find(" |", end + 4);
    std::string path = line.substr(3, end - 3);
    const bool optional = path.ends_with('?');
    if (optional) path.pop_back();
    for (const std::string& command : commands) {
      page[command][path] = {line.substr(end + 4, type_end - end - 4), optional};
    }
  }
  return page;
}

bool has_type(const Json& value, const std::string& type) {
  const bool real = value.is_number() || value == "inf" || value == "-inf" || value == "nan";
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "number or null") return value.is_number() || value.is_null();
  if (type == "real") return real;
  if (type == "text") return value.is_string();
  if (type == "real or text") return real || value.is_string();
  return type == "true or false" && value.is_boolean();
}

/// The fields of an object at a path, and whether each may be missing.
std::map<std::string, bool> fields_of(const Fields& fields, const std::string& path) {
  std::map<std::string, bool> result;
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& [name, field] : fields) {
    if (!name.starts_with(prefix)) continue;
    const std::string rest = name.substr(prefix.size());
    const auto [entry, added] = result.emplace(rest.substr(0, rest.find_first_of(".[")), field.optional);
    entry->second = entry->second && field.optional;
  }
  return result;
}

void expect_fields(const Fields& fields, const Json& value, const std::string& path) {
  if (value.is_object()) {
    const auto known = fields_of(fields, path);
    for (const auto& [name, optional] : known) {
      EXPECT_TRUE(optional || value.contains(name)) << path << " has no field " << name;
    }
    const std::string prefix = path.empty() ? "" : path + ".";
    for (const auto& [name, entry] : value.items()) {
      const bool any = known.contains("*");
      ASSERT_TRUE(any || known.contains(name)) << path << " has a field " << name << ", which docs/json.md has not";
      expect_fields(fields, entry, prefix + (any ? "*" : name));
    }
  } else if (value.is_array()) {
    for (const Json& entry : value) expect_fields(fields, entry, path + "[]");
  } else {
    ASSERT_TRUE(fields.contains(path)) << path << " is " << value << ", docs/json.md has no such field";
    EXPECT_TRUE(has_type(value, fields.at(path).type)) << path << ": " << value << " is no " << fields.at(path).type;
  }
}

class JsonCommand : public CommandTest {
 protected:
  void expect_documented(const std::string& section, const std::string& json) const {
    SCOPED_TRACE(section);
    ASSERT_TRUE(page_.contains(section)) << "docs/json.md has no section '" << section << "'";
    const Json document = Json::parse(json, nullptr, false);
    ASSERT_FALSE(document.is_discarded()) << json;
    expect_fields(page_.at(section), document, "");
  }

  void expect_output(const std::string& section, const std::string& arguments) const {
    const Result result = run(arguments + " --json");
    ASSERT_EQ(result.status, 0) << arguments << ": " << result.err;
    expect_documented(section, result.out);
  }

  const std::map<std::string, Fields> page_ = read_page();
};

TEST_F(JsonCommand, PageHasEveryCommand) {
  std::set<std::string> documented;
  for (const auto& [section, fields] : page_) documented.insert(section.substr(0, section.find(" --")));
  std::istringstream lines(run("--manual").out);
  std::size_t commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(".SS ")) continue;
    ++commands;
    EXPECT_TRUE(documented.contains(line.substr(4))) << line;
  }
  EXPECT_EQ(documented.size(), commands);
}

TEST_F(JsonCommand, CopulaCommandsPrintWhatThePageSays) {
  write("in.csv",
        "family,theta,quantity,d,u,expected\nfrank,2,log_pdf,2,0.5 0.25,0.1\nfrank,2,log_pdf,2,0.5 7,0.1\n"
        "independence,,cdf,2,0 0.5,0\n");
  write("data.csv", "x,y\n1,2\n2,1.5\n3,4\n4,3\n5,6\n6,5\n");
  expect_output("sklar families", "families --dim 3");
  expect_output("sklar copula table", "copula table in.csv");
  expect_output("sklar copula table", "copula table in.csv --accuracy exact --digits 30");
  expect_output("sklar copula sample", "copula sample --family clayton --theta 2 --dim 3 -n 4");
  expect_output("sklar copula fit", "copula fit data.csv");
  expect_output("sklar copula fit", "copula fit data.csv --method tau --families frank,joe");
  const std::string normal = "copula fit data.csv --families frank,gumbel --margins normal,normal ";
  expect_output("sklar copula fit", normal + "--select holdout");
  expect_output("sklar copula fit", normal + "--fit joint");
  expect_output("sklar copula fit", "copula fit data.csv --families frank --confidence 0.9");
  expect_output("sklar copula fit", normal + "--confidence 0.9");
  expect_output("sklar copula test", "copula test data.csv --family frank --replicates 20");
  write("given.csv", "x1\n0.25\n0.5\n");
  write("model.json", R"({"format":"sklar copula","version":1,"family":"frank","dim":2,"theta":[2],"margins":[]})");
  expect_output("sklar copula predict", "copula predict model.json given.csv");
  expect_output("sklar copula predict", "copula predict model.json given.csv -n 2");
  expect_output("sklar copula plot", "copula plot data.csv --families frank");
  expect_output("sklar copula derive", "copula derive 'exp(-theta*t)' --order 2");
  expect_output("sklar tradeoff", "tradeoff --families independence --rows 10");
}

TEST_F(JsonCommand, CommandsOnAMaterialPrintWhatThePageSays) {
  write("in.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0,0,1,0,0,1\n");
  ASSERT_EQ(run("brdf convert '" SKLAR_GOLDEN_FILES "/brdf_2_refined.json' model.json").status, 0);
  expect_output("sklar brdf albedo", "brdf albedo model.json --furnace 2");
  expect_output("sklar brdf eval", "brdf eval model.json --directions in.csv");
  expect_output("sklar brdf sample", "brdf sample model.json --wo 30,0 -n 2");
  expect_output("sklar brdf convert", "brdf convert model.json model.sklar");
  expect_output("sklar brdf convert", "brdf convert model.json model.glsl --max-albedo 0.5");
  expect_output("sklar brdf render", "brdf render model.json --scene room --size 8x6 --spp 1 -o a.png");
  expect_output("sklar brdf converge", "brdf converge --scene room --size 8x6 --spp-max 2 --spp-reference 2");
}

TEST_F(JsonCommand, FitsPrintWhatThePageSays) {
  expect_output("sklar brdf fit", "brdf fit --evaluations 2 --max-albedo 0.5 -o model.json");
  expect_output("sklar brdf fit", "brdf fit synthetic-anisotropic --evaluations 2 -o model.json");
  expect_output("sklar brdf fit --mode paper", "brdf fit --mode paper --slices 1 --family independence -o model.json");
  expect_output("sklar brdf fit --scene",
                "brdf fit --scene sphere --max-error 10dB --size 12 --spp 1 --evaluations 2 -o model.json");
  expect_output("sklar tradeoff --brdf", "tradeoff --brdf --families independence --slices 1 --max-bytes 400");
}

// What `brdf compare` and `brdf batch` print, without the minutes that it takes.
TEST_F(JsonCommand, ComparisonsPrintWhatThePageSays) {
  const brdf::CompareRow row{.material = "a", .fit_s = 1, .theta = {{{{0.5}, {}}, {}, {{1, 2}}}}},
      failed{.error = "no"};
  expect_documented("sklar brdf compare", to_json(std::vector{row, failed}));
  const brdf::ModelRow model{.material = "a", .kind = "analytic", .model = "ggx", .bytes = 8, .log1p_mae = HUGE_VAL};
  for (const std::string section : {"sklar brdf compare --models", "sklar brdf batch"}) {
    expect_documented(section, to_json(std::vector{model, model}));
  }
}

}  // namespace
}  // namespace sklar::cli
