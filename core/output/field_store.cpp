#include "core/output/field_store.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include "core/errors.hpp"

namespace talus::core {
namespace {

/// An identifier of the HDF5 library, closed by the function that fits its kind.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("the HDF5 library cannot make " + what);
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

using Shape = std::vector<hsize_t>;

/// A dataset whose bytes lie in one piece, at an address that is fixed from the start, and are not touched by
/// the library.
void set_reserved(hid_t properties) {
  H5Pset_layout(properties, H5D_CONTIGUOUS);
  H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER);
  H5Pset_obj_track_times(properties, false);
}

void set_text_attribute(hid_t object, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a text type");
  H5Tset_size(type, std::max<std::size_t>(1, text.size()));
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, "a scalar space");
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         "an attribute");
  H5Awrite(attribute, type, text.empty() ? " " : text.c_str());
}

struct Dataset {
  std::string path;
  hid_t type;
  Shape shape;
  std::string unit;
};

/// Makes a dataset and returns its place in the file.
std::uint64_t reserve(hid_t file, const Dataset& dataset, const void* content = nullptr) {
  const Handle space(H5Screate_simple(static_cast<int>(dataset.shape.size()), dataset.shape.data(), nullptr),
                     H5Sclose, dataset.path);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "dataset properties");
  set_reserved(properties);
  const Handle made(
      H5Dcreate2(file, dataset.path.c_str(), dataset.type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Dclose, dataset.path);
  set_text_attribute(made, "unit", dataset.unit);
  if (content && H5Dwrite(made, dataset.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, content) < 0)
    throw std::runtime_error("the HDF5 library cannot write " + dataset.path);
  const haddr_t offset = H5Dget_offset(made);
  if (offset == HADDR_UNDEF)
    throw std::runtime_error("the HDF5 library reserves no place for " + dataset.path);
  return offset;
}

std::vector<std::uint64_t> reserve_group(hid_t file, const GroupDescription& group, hsize_t capacity) {
  const Handle made(H5Gcreate2(file, group.name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                    "group " + group.name);
  const auto nodes = static_cast<hsize_t>(group.nodes), cells = static_cast<hsize_t>(group.cell_count());
  reserve(file, {group.name + "/cells", H5T_NATIVE_INT64, {cells, static_cast<hsize_t>(group.kind)}, ""},
          group.cells.data());
  std::vector<std::uint64_t> offsets{
      reserve(file, {group.name + "/position", H5T_NATIVE_DOUBLE, {capacity, nodes, 3}, "m"})};
  for (const auto& field : group.fields) {
    const hsize_t rows = field.location == FieldLocation::node ? nodes : cells;
    offsets.push_back(reserve(
        file,
        {group.name + "/" + field.name, H5T_NATIVE_DOUBLE, {capacity, rows, field.components}, field.unit}));
  }
  return offsets;
}

}  // namespace

FieldStore::Layout FieldStore::reserve_all(const std::filesystem::path& path,
                                           const std::vector<GroupDescription>& groups, std::int64_t frames) {
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                    path.string());
  const auto capacity = static_cast<hsize_t>(frames);
  Layout layout;
  const std::int64_t none = 0;
  layout.count = reserve(file, {"frames_written", H5T_NATIVE_INT64, {1}, ""}, &none);
  layout.time = reserve(file, {"time", H5T_NATIVE_DOUBLE, {capacity}, "s"});
  for (const auto& group : groups)
    layout.groups.push_back(group.nodes > 0 && group.cell_count() > 0 ? reserve_group(file, group, capacity)
                                                                      : std::vector<std::uint64_t>{});
  return layout;
}

FieldStore::FieldStore(const std::filesystem::path& path, const std::vector<GroupDescription>& groups,
                       std::int64_t frame_capacity)
    : capacity_(frame_capacity),
      layout_(reserve_all(path, groups, frame_capacity)),
      file_(path, OutputFile::Mode::update) {}

void FieldStore::write_numbers(std::uint64_t offset, std::span<const double> values) {
  file_.write_at(offset, std::as_bytes(values));
}

void FieldStore::write(const Slot& slot, std::span<const double> values) {
  if (frames_written_ >= capacity_)
    throw UsageError(fmt::format("fields.h5 was made for {} frames only", capacity_));
  const auto& places = layout_.groups.at(slot.group);
  if (places.empty()) return;
  const auto frame = static_cast<std::uint64_t>(frames_written_);
  write_numbers(places.at(static_cast<std::size_t>(slot.field + 1)) + frame * values.size_bytes(), values);
}

void FieldStore::end_frame(double time) {
  if (frames_written_ >= capacity_)
    throw UsageError(fmt::format("fields.h5 was made for {} frames only", capacity_));
  write_numbers(layout_.time + static_cast<std::uint64_t>(frames_written_) * sizeof(double), {&time, 1});
  ++frames_written_;
  file_.write_at(layout_.count, std::as_bytes(std::span(&frames_written_, 1)));
}

}  // namespace talus::core
