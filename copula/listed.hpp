#pragma once
/// Names in messages.

#include <functional>
#include <string>

namespace sklar {

/// text_of(entry) of each entry, with ", " between them.
template <class Entries, class Text = std::identity>
[[nodiscard]] std::string listed(const Entries& entries, const Text& text_of = {}) {
  std::string list;
  const char* separator = "";
  for (const auto& entry : entries) {
    list += separator;
    list += std::invoke(text_of, entry);
    separator = ", ";
  }
  return list;
}

}  // namespace sklar
