#include "core/output/reserve.hpp"

#include <exception>

#include "core/output/file.hpp"

namespace talus::core {
namespace {

constexpr std::uint64_t reserved_bytes = 65536;  // a summary of some hundred probes takes half of it

}  // namespace

Reserve::Reserve(const std::filesystem::path& folder) noexcept {
  try {
    path_ = Replacement::temporary_of(folder / "reserve");
    OutputFile(path_, OutputFile::Mode::create).reserve(reserved_bytes);
  } catch (const std::exception&) {
    release();
  }
}

void Reserve::release() noexcept {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove(path_, ignored);
  path_.clear();
}

}  // namespace talus::core
