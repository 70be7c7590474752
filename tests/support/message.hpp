#pragma once
/// What a failing call says.

#include <exception>
#include <string>

namespace sklar::test {

/// The message of the Error that the call throws; empty, which no test expects, if it throws none.
template <class Error, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace sklar::test
