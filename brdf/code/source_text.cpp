#include "brdf/code/source_text.hpp"

#include <array>
#include <cctype>
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

std::string origin_text(std::string_view material) {
  std::string name(material);
  for (char& letter : name) {
    if (std::iscntrl(static_cast<unsigned char>(letter)) != 0 || letter == '\\') letter = ' ';
  }
  return "sklar: a refined reflectance model of " + name + ".\n";
}

}  // namespace sklar::brdf
