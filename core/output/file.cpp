#include "core/output/file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace talus::core {
namespace {

int flags(OutputFile::Mode mode) {
  switch (mode) {
    case OutputFile::Mode::create:
      return O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC;
    case OutputFile::Mode::append:
      return O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC;
    case OutputFile::Mode::update:
      return O_WRONLY | O_CLOEXEC;
  }
  return 0;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, Mode mode)
    : path_(path), descriptor_(::open(path.c_str(), flags(mode), 0644)) {
  if (descriptor_ < 0) fail("opened for writing");
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

void OutputFile::fail(const char* action) const {
  throw std::system_error(errno, std::generic_category(), "'" + path_.string() + "' cannot be " + action);
}

void OutputFile::append(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const auto written = ::write(descriptor_, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) fail("written");
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

void OutputFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno != EINTR) fail("written");
    if (written <= 0) continue;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

void replace_file(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path temporary = path.string() + ".part";
  OutputFile(temporary, OutputFile::Mode::create).append(text);
  std::filesystem::rename(temporary, path);
}

}  // namespace talus::core
