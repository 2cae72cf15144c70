#pragma once

#include <filesystem>
#include <string>

/// Files that users name.
namespace talus::core {

/// What keeps `path` from being read, as one sentence with the path; empty where nothing does. Named pipes,
/// devices and sockets are refused: reading them could wait for ever, or never end.
std::string input_file_fault(const std::filesystem::path& path);

/// The bytes of a file. @throws ConfigError with the fault of `path`
std::string text_of_file(const std::filesystem::path& path);

/// Tells two contents apart (FNV-1a, 64 bits, hexadecimal); no defence against forgery. "absent" where there is no file.
std::string digest_of_content(const std::filesystem::path& path);

/// Takes the mark of UTF-8 off the front of a text, which Windows programs put there.
void drop_byte_order_mark(std::string& text);

}  // namespace talus::core
