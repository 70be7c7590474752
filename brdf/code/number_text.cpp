#include "brdf/code/number_text.hpp"

#include <array>
#include <charconv>

namespace sklar::brdf {
namespace {

template <class Number>
std::string shortest(Number value) {
  std::array<char, 32> digits{};
  const std::string text(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string line(const char* type, std::string_view name, const std::string& value) {
  return std::string("const ") + type + " sklar_" + std::string(name) + " = " + value + ";\n";
}

}  // namespace

std::string number_text(double value) {
  return shortest(value);
}

std::string number_text(float value) {
  return shortest(value);
}

std::string constant_text(std::string_view name, int value) {
  return line("int", name, std::to_string(value));
}

std::string constant_text(std::string_view name, double value) {
  return line("float", name, number_text(value));
}

}  // namespace sklar::brdf
