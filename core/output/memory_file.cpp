#include "core/output/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "core/errors.hpp"

namespace talus::core {
namespace {

constexpr off_t chunk = 1 << 20;  // bytes copied at once

[[noreturn]] void fail() {
  throw MachineError(std::string("a file in memory cannot be read back: ") + std::strerror(errno));
}

/// Copies the bytes [begin, end).
void copy(int from, OutputFile& to, off_t begin, off_t end) {
  std::vector<std::byte> bytes;
  while (begin < end) {
    bytes.resize(static_cast<std::size_t>(std::min(chunk, end - begin)));
    const auto count = ::pread(from, bytes.data(), bytes.size(), begin);
    if (count <= 0) fail();
    to.write_at(static_cast<std::uint64_t>(begin), std::span(bytes).first(static_cast<std::size_t>(count)));
    begin += count;
  }
}

}  // namespace

MemoryFile::MemoryFile(const std::string& name) : descriptor_(::memfd_create(name.c_str(), MFD_CLOEXEC)) {
  if (descriptor_ < 0) throw MachineError("'" + name + "' cannot be made in memory: " + std::strerror(errno));
}

MemoryFile::~MemoryFile() {
  ::close(descriptor_);
}

std::filesystem::path MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(descriptor_);
}

void MemoryFile::copy_to(OutputFile& file) const {
  const off_t size = ::lseek(descriptor_, 0, SEEK_END);
  if (size < 0) fail();
  for (off_t begin = 0; (begin = ::lseek(descriptor_, begin, SEEK_DATA)) >= 0 && begin < size;) {
    const off_t end = ::lseek(descriptor_, begin, SEEK_HOLE);
    if (end < 0) fail();
    copy(descriptor_, file, begin, end);
    begin = end;
  }
  file.resize(static_cast<std::uint64_t>(size));
}

}  // namespace talus::core
