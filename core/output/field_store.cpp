#include "core/output/field_store.hpp"

#include <fmt/format.h>
#include "core/errors.hpp"
#include "core/output/hdf5_handle.hpp"
#include "core/output/memory_file.hpp"

namespace talus::core {
namespace {

using Shape = std::vector<hsize_t>;

/// Makes datasets whose bytes lie in one piece, at an address that is fixed from the start, and are not
/// touched by the library.
class Reserver {
 public:
  explicit Reserver(hid_t numbers) : numbers_(numbers) {
    H5Pset_layout(properties_, H5D_CONTIGUOUS);
    H5Pset_alloc_time(properties_, H5D_ALLOC_TIME_EARLY);
    H5Pset_fill_time(properties_, H5D_FILL_TIME_NEVER);
    H5Pset_obj_track_times(properties_, false);
  }
  /// Returns the place in the file. @pre content, where given, holds as many numbers as the shape
  std::uint64_t operator()(hid_t parent, const std::string& name, const Shape& shape,
                           const void* content = nullptr) const {
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose,
                           name);
    const Hdf5Handle made(
        H5Dcreate2(parent, name.c_str(), numbers_, space, H5P_DEFAULT, properties_, H5P_DEFAULT), H5Dclose,
        name);
    if (content && H5Dwrite(made, numbers_, H5S_ALL, H5S_ALL, H5P_DEFAULT, content) < 0)
      throw MachineError("the HDF5 library cannot write " + name);
    const haddr_t offset = H5Dget_offset(made);
    if (offset == HADDR_UNDEF) throw MachineError("the HDF5 library reserves no place for " + name);
    return offset;
  }

 private:
  hid_t numbers_;  // their type
  Hdf5Handle properties_{H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "dataset properties"};
};

void set_text_attribute(hid_t object, const char* name, const std::string& text) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a text type");
  H5Tset_size(type, std::max<std::size_t>(1, text.size()));
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "a scalar space");
  const Hdf5Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "an attribute");
  H5Awrite(attribute, type, text.empty() ? " " : text.c_str());
}

/// One dataset a frame, side by side in the group `path`.
struct Series {
  std::string path;
  std::string unit;
  Shape shape;  ///< of a frame
};

std::vector<std::uint64_t> reserve_series(hid_t file, const Series& series, std::int64_t frames) {
  const Hdf5Handle group(H5Gcreate2(file, series.path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Gclose, series.path);
  set_text_attribute(group, "unit", series.unit);
  const Reserver reserve(H5T_NATIVE_DOUBLE);
  std::vector<std::uint64_t> offsets;
  for (std::int64_t frame = 0; frame < frames; ++frame)
    offsets.push_back(reserve(group, frame_name(frame), series.shape));
  return offsets;
}

FieldStore::GroupPlaces reserve_group(hid_t file, const GroupDescription& group, std::int64_t frames) {
  const Hdf5Handle made(H5Gcreate2(file, group.name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                        group.name);
  const auto nodes = static_cast<hsize_t>(group.nodes), cells = static_cast<hsize_t>(group.cell_count());
  Reserver{H5T_NATIVE_INT64}(made, "cells", {cells, static_cast<hsize_t>(group.kind)}, group.cells.data());
  FieldStore::GroupPlaces places{reserve_series(made, {"position", "m", {nodes, 3}}, frames)};
  for (const auto& field : group.fields) {
    const hsize_t rows = field.location == FieldLocation::node ? nodes : cells;
    places.push_back(reserve_series(made, {field.name, field.unit, {rows, field.components}}, frames));
  }
  return places;
}

}  // namespace

std::string frame_name(std::int64_t frame) {
  return fmt::format("{:06}", frame);
}

FieldStore::Layout FieldStore::reserve_all(const MemoryFile& memory,
                                           const std::vector<GroupDescription>& groups, std::int64_t frames) {
  Hdf5Handle file(create_hdf5_in(memory), H5Fclose, "the structure of fields.h5");
  Layout layout;
  const std::int64_t none = 0;
  layout.count = Reserver{H5T_NATIVE_INT64}(file, "frames_written", {1}, &none);
  layout.time = Reserver{H5T_NATIVE_DOUBLE}(file, "time", {static_cast<hsize_t>(frames)});
  for (const auto& group : groups) {
    const bool drawn = group.nodes > 0 && group.cell_count() > 0;
    layout.groups.push_back(drawn ? reserve_group(file, group, frames) : GroupPlaces{});
  }
  if (!file.close())
    throw MachineError("the memory, or `ulimit -f`, does not suffice for the structure of fields.h5");
  return layout;
}

FieldStore::FieldStore(const std::filesystem::path& path, const std::vector<GroupDescription>& groups,
                       std::int64_t frame_capacity)
    : capacity_(frame_capacity), file_(path, OutputFile::Mode::create) {
  const MemoryFile structure("fields.h5");
  layout_ = reserve_all(structure, groups, frame_capacity);
  structure.copy_to(file_);
}

void FieldStore::write_numbers(std::uint64_t offset, std::span<const double> values) {
  file_.write_at(offset, std::as_bytes(values));
}

void FieldStore::write(const Slot& slot, std::span<const double> values) {
  if (frames_written_ >= capacity_)
    throw UsageError(fmt::format("fields.h5 was made for {} frames only", capacity_));
  const auto& places = layout_.groups.at(slot.group);
  if (places.empty()) return;
  const auto& frames = places.at(static_cast<std::size_t>(slot.field + 1));
  write_numbers(frames.at(static_cast<std::size_t>(frames_written_)), values);
}

void FieldStore::end_frame(double time) {
  if (frames_written_ >= capacity_)
    throw UsageError(fmt::format("fields.h5 was made for {} frames only", capacity_));
  write_numbers(layout_.time + static_cast<std::uint64_t>(frames_written_) * sizeof(double), {&time, 1});
  ++frames_written_;
  file_.write_at(layout_.count, std::as_bytes(std::span(&frames_written_, 1)));
}

}  // namespace talus::core
