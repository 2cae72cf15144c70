#include "core/output/file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "core/errors.hpp"

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

/// 0, or the error. What cannot be synchronised (a pipe, some network file systems) is as good as it gets.
int synchronised(int descriptor) noexcept {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP) return 0;
  return errno;
}

/// A new name lasts once the folder that holds it is on the disk.
void synchronise_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // a folder that may be written but not listed
  const int error = synchronised(descriptor);
  ::close(descriptor);
  if (error != 0) throw FileError(folder, "written to its disk", error);
}

/// A left-over of another owner, or without permission to write, would stand in the way of a new file.
std::filesystem::path without_left_over(std::filesystem::path temporary) {
  ::unlink(temporary.c_str());
  return temporary;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, Mode mode)
    : path_(path), descriptor_(::open(path.c_str(), flags(mode), 0644)) {
  if (descriptor_ < 0) fail("opened for writing", errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

void OutputFile::fail(const char* action, int error) const {
  throw FileError(path_, action, error);
}

void OutputFile::append(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const auto written = ::write(descriptor_, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) fail("written", errno);
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

void OutputFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno != EINTR) fail("written", errno);
    if (written <= 0) continue;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

void OutputFile::resize(std::uint64_t bytes) {
  if (::ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) fail("written", errno);
}

void OutputFile::reserve(std::uint64_t bytes) {
  if (const int error = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes)); error != 0)
    fail("written", error);
}

void OutputFile::synchronise() {
  if (const int error = synchronised(descriptor_); error != 0) fail("written to its disk", error);
}

void OutputFile::close() {
  // Whatever close() says, the descriptor is gone.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail("written", errno);
}

Replacement::Replacement(std::filesystem::path path)
    : path_(std::move(path)), file_(without_left_over(temporary_of(path_)), OutputFile::Mode::create) {}

Replacement::~Replacement() {
  if (!committed_) ::unlink(temporary_of(path_).c_str());
}

void Replacement::commit(Durability durability) {
  if (durability == Durability::power_loss) file_.synchronise();
  file_.close();
  rename_file(temporary_of(path_), path_, durability);
  committed_ = true;
}

void replace_file(const std::filesystem::path& path, const std::string& text, Durability durability) {
  Replacement replacement(path);
  replacement.file().append(text);
  replacement.commit(durability);
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to, Durability durability) {
  if (::rename(from.c_str(), to.c_str()) != 0) throw FileError(to, "replaced", errno);
  if (durability == Durability::power_loss) synchronise_folder_of(to);
}

}  // namespace talus::core
