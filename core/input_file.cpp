#include "core/input_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/errors.hpp"

namespace talus::core {
namespace {

const char* kind_of(std::filesystem::file_type type) {
  using std::filesystem::file_type;
  switch (type) {
    case file_type::directory:
      return "a folder";
    case file_type::fifo:
      return "a named pipe";
    case file_type::character:
    case file_type::block:
      return "a device";
    case file_type::socket:
      return "a socket";
    default:
      return "something else";
  }
}

}  // namespace

std::string input_file_fault(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  const std::string name = path.string();
  if (status.type() == std::filesystem::file_type::not_found) return fmt::format("no such file: '{}'", name);
  if (error) return fmt::format("cannot be read: '{}' ({})", name, error.message());
  if (status.type() != std::filesystem::file_type::regular)
    return fmt::format("'{}' is {}, not a file", name, kind_of(status.type()));
  if (access(path.c_str(), R_OK) != 0) return fmt::format("cannot be read: '{}' (permission denied)", name);
  return {};
}

std::string text_of_file(const std::filesystem::path& path) {
  if (const std::string fault = input_file_fault(path); !fault.empty()) throw ConfigError(fault);
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
  if (stream.bad() || (!stream && !stream.eof()))
    throw ConfigError(fmt::format("cannot be read: '{}'", path.string()));
  return text.str();
}

std::string digest_of_content(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return "absent";
  std::uint64_t digest = 0xcbf29ce484222325u;
  std::vector<char> block(1 << 16);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0)
    for (std::streamsize i = 0; i < stream.gcount(); ++i)
      digest = (digest ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * 0x100000001b3u;
  return fmt::format("{:016x}", digest);
}

void drop_byte_order_mark(std::string& text) {
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
}

}  // namespace talus::core
