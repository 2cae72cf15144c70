#include "core/output/checkpoint.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/output/file.hpp"
#include "core/output/hdf5_handle.hpp"

namespace talus::core {
namespace {

constexpr const char* owner_attribute = "talus_checkpoint_of";

/// An HDF5 handle with its closing function.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void write_owner(hid_t file, const std::string& owner) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
  H5Tset_size(type, owner.size() + 1);
  const Handle attribute(H5Acreate2(file, owner_attribute, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  H5Awrite(attribute, type, owner.c_str());
}

std::string read_owner(hid_t file) {
  if (H5Aexists(file, owner_attribute) <= 0) return {};
  const Handle attribute(H5Aopen(file, owner_attribute, H5P_DEFAULT), H5Aclose),
      type(H5Aget_type(attribute), H5Tclose);
  std::string owner(H5Tget_size(type), '\0');
  H5Aread(attribute, type, owner.data());
  return owner.c_str();
}

/// Gives the file at `path`, where there is one, the name `before` too, so that at no moment there is none.
/// Where the file system knows no second names it is moved.
void keep_as(const std::filesystem::path& before, const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return;
  const auto second = Replacement::temporary_of(before);
  ::unlink(second.c_str());
  const bool linked = ::link(path.c_str(), second.c_str()) == 0;
  rename_file(linked ? second : path, before, Durability::kill);
  ::unlink(second.c_str());  // it stays where both names were one file's already
}

}  // namespace

CheckpointWriter::CheckpointWriter(std::filesystem::path path, const std::string& owner)
    : path_(std::move(path)), file_(create_hdf5_in(memory_)) {
  if (file_ < 0)
    throw MachineError(fmt::format("the checkpoint {} cannot be made in memory", path_.string()));
  write_owner(file_, owner);
}

CheckpointWriter::~CheckpointWriter() {
  if (file_ >= 0) H5Fclose(file_);
}

void CheckpointWriter::write(const std::string& name, std::int64_t type, const void* data, std::size_t size) {
  const hsize_t extent = size;
  const Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  const Handle set(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  if (set < 0 || (size > 0 && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0))
    throw MachineError(fmt::format(
        "the memory, or `ulimit -f`, does not suffice for '{}' of the checkpoint {}", name, path_.string()));
}

void CheckpointWriter::values(const std::string& name, std::vector<double>& values) {
  write(name, H5T_NATIVE_DOUBLE, values.data(), values.size());
}

void CheckpointWriter::count(const std::string& name, std::int64_t& count) {
  write(name, H5T_NATIVE_INT64, &count, 1);
}

void CheckpointWriter::bytes(const std::string& name, std::span<const std::byte> bytes) {
  write(name, H5T_NATIVE_UCHAR, bytes.data(), bytes.size());
}

void CheckpointWriter::text(const std::string& name, const std::string& text) {
  bytes(name, std::as_bytes(std::span(text)));
}

void CheckpointWriter::commit(const Place& place) {
  const herr_t closed = H5Fclose(file_);
  file_ = -1;
  if (closed < 0)
    throw MachineError(
        fmt::format("the memory, or `ulimit -f`, does not suffice for the checkpoint {}", path_.string()));
  Replacement replacement(path_);
  memory_.copy_to(replacement.file());
  if (!place.before.empty()) keep_as(place.before, path_);
  replacement.commit(place.durability);
}

CheckpointReader::CheckpointReader(const std::filesystem::path& path, const std::vector<std::string>& owners)
    : path_(path) {
  silence_hdf5();
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) throw ConfigError(fmt::format("{} cannot be read as a checkpoint", path.string()));
  const std::string found = read_owner(file_);
  if (std::ranges::find(owners, found) != owners.end()) return;
  H5Fclose(file_);
  throw ConfigError(fmt::format("{} is a checkpoint of '{}', not of '{}'", path.string(), found,
                                fmt::join(owners, "' or '")));
}

CheckpointReader::~CheckpointReader() {
  H5Fclose(file_);
}

void CheckpointReader::read(const std::string& name, std::int64_t type, void* data, std::size_t size) {
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0) throw ConfigError(fmt::format("the checkpoint {} has no '{}'", path_.string(), name));
  const Handle space(H5Dget_space(set), H5Sclose);
  const auto found = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  if (found != size)
    throw ConfigError(
        fmt::format("the checkpoint {} has {} numbers for '{}', this scene {}: it belongs to another scene",
                    path_.string(), found, name, size));
  if (size > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    throw ConfigError(fmt::format("'{}' of the checkpoint {} cannot be read", name, path_.string()));
}

void CheckpointReader::values(const std::string& name, std::vector<double>& values) {
  read(name, H5T_NATIVE_DOUBLE, values.data(), values.size());
}

void CheckpointReader::count(const std::string& name, std::int64_t& count) {
  read(name, H5T_NATIVE_INT64, &count, 1);
}

std::optional<std::string> CheckpointReader::text(const std::string& name) {
  if (H5Lexists(file_, name.c_str(), H5P_DEFAULT) <= 0) return std::nullopt;
  const std::vector<std::byte> read = bytes(name);
  return std::string(reinterpret_cast<const char*>(read.data()), read.size());
}

std::vector<std::byte> CheckpointReader::bytes(const std::string& name) {
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (set < 0) throw ConfigError(fmt::format("the checkpoint {} has no '{}'", path_.string(), name));
  const Handle space(H5Dget_space(set), H5Sclose);
  std::vector<std::byte> bytes(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  read(name, H5T_NATIVE_UCHAR, bytes.data(), bytes.size());
  return bytes;
}

}  // namespace talus::core
