#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "core/errors.hpp"

/// What a C program hands over, checked before it is used. Each throws UsageError that names the member.
namespace talus::c_api {

template <class Pointer>
Pointer& given(Pointer* pointer) {
  if (pointer == nullptr) throw core::UsageError("an argument is NULL");
  return *pointer;
}

inline std::string optional_text(const char* text) {
  return text == nullptr ? "" : text;
}

inline std::string text(const char* text, const char* member) {
  if (text == nullptr) throw core::UsageError(std::string(member) + " is NULL; a text is expected");
  return text;
}

/// `count` groups of `width` values.
template <class Value>
std::span<const Value> values(const Value* first, std::int64_t count, std::size_t width, const char* member) {
  if (count < 0)
    throw core::UsageError(std::string(member) + ": " + std::to_string(count) + " of them cannot be");
  if (count > 0 && first == nullptr) throw core::UsageError(std::string(member) + " is NULL");
  return {first, width * static_cast<std::size_t>(count)};
}

/// A size above this is no struct of ours but a member that was never set.
inline constexpr std::size_t largest_struct = 4096;

template <class Struct>
std::size_t said_size(const Struct& said, const char* name) {
  if (said.size <= sizeof said.size || said.size > largest_struct)
    throw core::UsageError(std::string("the size of ") + name + " is " + std::to_string(said.size) +
                           "; set it to sizeof(" + name + "), which is " + std::to_string(sizeof(Struct)));
  return said.size;
}

/// A struct of a program that was compiled with this header, an older one (what it lacks is zero) or a newer one.
template <class Struct>
Struct taken(const Struct* pointer, const char* name) {
  const std::size_t size = said_size(given(pointer), name);
  const auto* bytes = reinterpret_cast<const unsigned char*>(pointer);
  if (std::any_of(bytes + std::min(size, sizeof(Struct)), bytes + size, [](auto byte) { return byte != 0; }))
    throw core::UsageError(std::string(name) +
                           " sets a member that this version of libtalus_c does not know");
  Struct copy{};
  std::memcpy(&copy, pointer, std::min(size, sizeof(Struct)));
  return copy;
}

/// Fills as much of a struct as the program knows; what it knows beyond ours becomes zero.
template <class Struct>
void fill(Struct* pointer, const char* name, Struct values) {
  values.size = said_size(given(pointer), name);
  std::memset(static_cast<void*>(pointer), 0, values.size);
  std::memcpy(static_cast<void*>(pointer), &values, std::min(values.size, sizeof(Struct)));
}

}  // namespace talus::c_api
