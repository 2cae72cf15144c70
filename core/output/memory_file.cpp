#include "core/output/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <vector>

#include "core/errors.hpp"

namespace talus::core {
namespace {

constexpr std::size_t chunk = 1 << 20, page = 4096;  // bytes read at once, and written or left out

[[noreturn]] void fail() {
  throw MachineError(std::string("a file in memory cannot be read back: ") + std::strerror(errno));
}

bool is_zero(std::span<const std::byte> bytes) {
  return std::ranges::all_of(bytes, [](std::byte b) { return b == std::byte{0}; });
}

/// Copies the bytes [begin, end), zeros as holes: the system may hold large pages of which little is written.
void copy(int from, OutputFile& to, off_t begin, off_t end) {
  std::vector<std::byte> bytes(chunk);
  while (begin < end) {
    const auto wanted = std::min<std::uint64_t>(chunk, static_cast<std::uint64_t>(end - begin));
    const auto count = ::pread(from, bytes.data(), wanted, begin);
    if (count <= 0) fail();
    const std::span<const std::byte> read(bytes.data(), static_cast<std::size_t>(count));
    for (std::size_t done = 0; done < read.size(); done += page) {
      const auto piece = read.subspan(done, std::min(page, read.size() - done));
      if (!is_zero(piece)) to.write_at(static_cast<std::uint64_t>(begin) + done, piece);
    }
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
